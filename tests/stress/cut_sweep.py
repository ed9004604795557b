"""The error doesn't depend on where a boundary cuts the cells.

    cut_sweep.py all|clipped|"body mesh"|block [NUMBER [METHOD ...]]

The cantilever with points of either kind, and the contained block of paper I,
section 5.1, at 30 degrees, at a NUMBER of even places of the grid's shift through a
cell (10; with 6 the median is off by 5 %), and at hard ones: close to the cell's
faces, on them, and where the cut cell looses its last body-mesh point. No run
fails, and no error is above twice the median of the even places (so that the choice
of the others doesn't shift it). Methods that are exact for the block stay below
1e-11.
"""

import statistics
import sys
from pathlib import Path

from many_runs import SOURCE, Runs

CANTILEVER = Path(__file__).with_name("cut_sweep.prm")
BLOCK = SOURCE / "prm/implicit-boundary/5.1-contained-block-30.prm"
CASES = ["clipped", "body mesh", "block"] if sys.argv[1] == "all" else sys.argv[1:2]
N_EVEN = int(sys.argv[2]) if len(sys.argv) > 2 else 10
METHODS = sys.argv[3:] or ["penalty", "projected penalty", "augmented Lagrangian",
                           "lagrange multiplier", "implicit boundary", "nitsche"]
CELL = 0.25
EVEN = [(i + 0.5) / N_EVEN for i in range(N_EVEN)]
NEAR_FACES = [1e-3, 1e-6, 1e-9, 1e-12]
# Above 0.89434 the cut cell holds no Gauss point of the body mesh; at 0.6655 a cell in
# a corner of the block has a point of next to no volume.
HARD = [0.894, 0.8944, 0.6655, 0., *NEAR_FACES, *[1. - cut for cut in NEAR_FACES]]
EXACT = {"augmented Lagrangian": 1e-11, "lagrange multiplier": 1e-11,
         "nitsche": 1e-11}
run = Runs()


def cantilever(points, cut, method):
    # a cut of 0 is the cell's left face; material is on the right
    return CANTILEVER, "tip u_y", [
        f"Bodies/beam/Points = {points}",
        f"Boundaries/clamp/Enforcement = {method}",
        f"Grid/Shift = {-CELL * (1. + cut)!r}, -0.55"]


def block(cut, method):
    return BLOCK, "r_u", [
        *(f"Boundaries/{side}/{entry}"
          for side in ("left", "bottom", "top", "push")
          for entry in (f"Enforcement = {method}", "Band width = 1e-6")),
        f"Grid/Shift = {10 * cut!r}, 0", "Output/Pictures every = 0",
        "Measurements/Names = r_u, condition",
        "Measurements/condition/Quantity = condition",
        "Output/Verbosity = silent", "Bodies/block/Points per direction = 2"]


def errors_at(case, cut, method):
    """The error, and condition numbers without and with a scaled diagonal."""
    scene, name, settings = (block(cut, method) if case == "block" else
                             cantilever(case, cut, method))
    status, text, summary = run(scene, settings)
    if status != "done" or summary["counts"]["halved steps"] > 0:
        sys.exit(f"FAILED: {case}, {method} at {cut}: {status} {text}")
    results = summary["results"]
    error = results[name]["value" if case == "block" else "error"]
    return error, results["condition"]["value"], results["condition scaled"]["value"]


def check(case, method):
    """What is wrong, if anything is."""
    found = {cut: errors_at(case, cut, method) for cut in [*EVEN, *HARD]}
    errors = {cut: numbers[0] for cut, numbers in found.items()}
    median, whole, scaled = (statistics.median(found[cut][i] for cut in EVEN)
                             for i in range(3))
    worst = max(errors, key=errors.get)
    print(f"{case}, {method}, {len(errors)} cuts: median error {median:.3e}, "
          f"largest {errors[worst] / median:.2f} times that, at {worst:.6g}; "
          f"condition {whole:.1e} to {max(n[1] for n in found.values()):.1e}, "
          f"scaled {scaled:.1e} to {max(n[2] for n in found.values()):.1e}",
          flush=True)
    bound = EXACT.get(method, 0.) if case == "block" else 0.
    if errors[worst] <= max(bound, 2. * median):
        return []
    return [f"{case}, {method}: {errors[worst]:.4e} at {worst}, twice {median:.4e}"]


def main():
    failures = [text for case in CASES for method in METHODS
                for text in check(case, method)]
    if failures:
        sys.exit("FAILED: " + "\n".join(failures))


main()
