"""Papers P (Figs. 7, 8) and L (Fig. 10): the cantilever over the penalty factor.

h = 1/4 m. At h = 1/8 m kind d has cells cut in a tiny corner, whose constraints
are superfluous (L, section 3.2.2): there the projected penalty locks, too.
"""

from math import log10

from cantilever_runs import KINDS, SCENE, clamp, size, tip
from driver import expect


def difference(name, settings, limit):
    return abs(tip(SCENE + name, settings) / limit - 1)


def main():
    for kind, name in KINDS.items():
        grid = size(kind, 1)
        limit = tip(SCENE + name, grid + clamp("projected penalty", 1e24, "Pa/m"))
        gaps = [difference(name, grid + clamp("projected penalty", beta, "Pa/m"),
                           limit) for beta in (1e12, 1e14, 1e16, 1e18)]
        slopes = [log10(fine / coarse) / 2 for coarse, fine in zip(gaps, gaps[1:])]
        plateau = [difference(name, grid + clamp("penalty", beta, "Pa/m"), limit)
                   for beta in (1e16, 1e20)]
        print(f"kind {kind}: slopes", *(f"{slope:.3f}" for slope in slopes),
              "plateau of the penalty", *(f"{gap:.3e}" for gap in plateau),
              flush=True)
        expect(all(abs(slope + 1) < 0.03 for slope in slopes),
               f"kind {kind}: slopes {slopes}")
        expect(abs(plateau[1] / plateau[0] - 1) < 0.01,
               f"kind {kind}: no plateau {plateau}")
        # Halfway cut quadrilaterals have no more particles than free motions.
        expect((plateau[1] > 1e-2) == (kind != "a"), f"kind {kind}: {plateau}")

    for ratio in (1e2, 1e4):
        gaps = []
        for young in (9e7, 9e8, 9e9, 9e10):
            grid = size("a", 1) + [f"Bodies/beam/Material/Young's modulus = {young}"]
            limit = tip(SCENE, grid + clamp("projected penalty", 1e15))
            gaps.append(difference("", grid + clamp("projected penalty",
                                                    ratio * young, "Pa/m"), limit))
        print(f"beta/E = {ratio:g}:", *(f"{gap:.4e}" for gap in gaps), flush=True)
        expect(max(gaps) < 1.02 * min(gaps), f"beta/E = {ratio}: {gaps}")


main()
