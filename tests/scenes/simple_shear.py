"""Paper I, section 5.3: an implicit boundary anywhere in its cell.

Arguments: the number of even places (101). The others are 1e-3, 1e-6 and 1e-9 of
the cell from either of its faces.
"""

import sys

from driver import expect, run_scene

SCENE = "implicit-boundary/5.3-simple-shear.prm"
CELL = 100.
PAPER = 2e-8  # of Fig. 16
NEAR_FACES = [1e-3, 1e-6, 1e-9]


def error_at(cut):
    summary = run_scene(SCENE, "run", [f"Grid/Shift = {-CELL * cut!r}, 0",
                                       "Output/Pictures every = 0"])
    return summary["results"]["r_sigma"]["value"]


def main():
    n = int(sys.argv[1]) if len(sys.argv) > 1 else 101
    cuts = [i / (n - 1) for i in range(n)]
    cuts += NEAR_FACES + [1. - cut for cut in NEAR_FACES]
    errors = {cut: error_at(cut) for cut in cuts}
    worst = max(errors, key=errors.get)
    print(f"{len(cuts)} places: stress error {min(errors.values()):.3e} to "
          f"{errors[worst]:.3e}, at {worst!r}")
    expect(errors[worst] < PAPER, f"stress error at {worst!r}")


main()
