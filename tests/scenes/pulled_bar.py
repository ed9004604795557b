"""Paper L, Fig. 10: the pulled bar over the penalty factor, coarse (h = 0.2 m)."""

from math import log10

from driver import expect, run_scene

SCENE = "multiplier/4.1-pulled-bar"
KINDS = {"a": "", "b": "-rotated", "c": "-triangles", "d": "-distorted"}
TRIANGLES = ["Grid/Cells = triangles", "Bodies/bar/Points per simplex = 12",
             "Bodies/bar/Mesh/Cells = triangles"]
# Grids that begin at the clamp; one that is turned has no side there.
CONFORMING = {"a": [], "c": TRIANGLES, "d": [*TRIANGLES, "Grid/Distortion = 0.25"]}
BODY_MESH = "Bodies/bar/Mesh/Arguments = 80, 10 : 0, 0 : 8, 1"
EXACT = 3.484964e-3
LOAD = 78480.


def tip(kind, method, beta):
    grid = ["Grid/Arguments = 40, 27 : 0, 0 : 8, 5.4"] if kind == "b" else [
        "Grid/Arguments = 42, 7 : 0, 0 : 8.4, 1.4", "Grid/Shift = -0.1, -0.2"]
    summary = run_scene(SCENE + KINDS[kind] + ".prm", "run", [
        *grid, "Output/Pictures every = 0",
        BODY_MESH,
        "Boundaries/clamp/Segment length = 0.1",
        f"Boundaries/clamp/Enforcement = {method}",
        "Boundaries/clamp/Penalty unit = Pa/m",
        f"Boundaries/clamp/Penalty factor = {beta}"])
    expect(summary["counts"]["halved steps"] == 0, f"{kind}, {beta}: halved")
    return summary["results"]["tip u_x"]["value"]


def check_level(kind, tip):
    """Where the error of the multipliers is: not above that of a conforming run."""
    summary = run_scene(SCENE + "-conforming.prm", "run", [
        "Grid/Arguments = 42, 7 : 0, 0 : 8.4, 1.4", "Grid/Shift = 0, -0.2",
        "Output/Pictures every = 0", BODY_MESH, *CONFORMING[kind]])
    level = summary["results"]["tip u_x"]["error"]
    print(f"kind {kind}: multiplier {abs(tip / EXACT - 1) / level:.3f} of the error of a "
          f"conforming run, {level:.2e}")
    expect(abs(tip / EXACT - 1) < 1.05 * level, f"kind {kind}: level of the multiplier")


def main():
    for kind in KINDS:
        flat = tip(kind, "projected penalty", 1e24)
        exact = [tip(kind, "lagrange multiplier", beta) for beta in (1e10, 1e30)]
        soft, stiff, stiffest = (tip(kind, "penalty", beta)
                                 for beta in (1e10, 1e20, 1e30))
        gaps = [tip(kind, "projected penalty", beta) - flat
                for beta in (1e15, 1e16)]
        slope = log10(abs(gaps[1] / gaps[0]))
        spring = gaps[0] * 1e15 / LOAD
        print(f"kind {kind}: error {flat / EXACT - 1:.2e}, spring {spring:.4f}, "
              f"slope {slope:.3f}, "
              f"penalty 1e10 {soft / EXACT - 1:.2e}, "
              f"1e20 {stiff / EXACT - 1:.2e}, 1e30 {stiffest / EXACT - 1:.2e}, "
              f"multiplier {exact[0] / EXACT - 1:.2e}", flush=True)
        expect(abs(exact[1] / exact[0] - 1) < 1e-12, f"multipliers {exact}")
        if kind in CONFORMING:
            check_level(kind, exact[0])
        # As the groups of shared multipliers are larger than cells, they differ.
        expect(abs(exact[0] / flat - 1) < 1e-3, f"multiplier {exact[0]}, not {flat}")
        expect(abs(slope + 1) < 0.01, f"kind {kind}: {gaps}")
        expect(abs(stiffest / stiff - 1) < 1e-6, f"kind {kind}: no plateau")
        if kind == "a":
            # An even traction: the clamp is a spring of beta times its 1 m2, and
            # the bar's rule of points is exact.
            expect(abs(spring - 1) < 1e-3, f"spring {spring}")
            expect(abs(flat / EXACT - 1) < 2e-7, "error of the line")
            expect(abs(stiffest / flat - 1) < 1e-8, "error of the plateau")
        expect(max(abs(value / EXACT - 1) for value in (flat, stiff, soft)) < 1e-2,
               f"kind {kind}: error")


main()
