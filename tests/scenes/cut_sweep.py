"""The error doesn't depend on where a boundary cuts the cells.

The clamp of cut_sweep.prm stands at random places of a cell, close to its faces
and on them: the largest error is at most twice the median, and no run fails.
A number as argument: so many random places instead of a few.
"""

import random
import statistics
import sys
from pathlib import Path

from driver import expect, run_scene

SCENE = Path(__file__).with_name("cut_sweep.prm")
CELL = 0.25
NEAR_FACES = [1e-3, 1e-6, 1e-9, 1e-12]
# From 0.9 on the cut cell is without Gauss points of the body mesh.
FEW = [0.12, 0.31, 0.47, 0.63, 0.79, 0.92, 0.96]


def cuts():
    """Places of the clamp in its cell, from 0 to 1 of the cell's size; the
    material is on the side of 1."""
    places = FEW
    if len(sys.argv) > 1:
        generator = random.Random(1)
        places = [generator.random() for _ in range(int(sys.argv[1]))]
    return [*places, 0., *NEAR_FACES, *[1. - cut for cut in NEAR_FACES]]


def error_at(cut, settings):
    shift = f"Grid/Shift = {-CELL * (1. + cut)!r}, -0.55"
    summary = run_scene(SCENE, "results", [*settings, shift])
    expect(summary["counts"]["halved steps"] == 0, f"step halved at {cut}")
    return summary["results"]["tip u_y"]["error"]


def main():
    for points in ("clipped", "body mesh"):
        for method in ("penalty", "projected penalty"):
            errors = {cut: error_at(cut, [
                f"Bodies/beam/Points = {points}",
                f"Boundaries/clamp/Enforcement = {method}"]) for cut in cuts()}
            median = statistics.median(errors.values())
            worst = max(errors, key=errors.get)
            print(f"{points}, {method}, {len(errors)} cuts: median error "
                  f"{median:.3e}, largest {errors[worst]:.3e} at {worst:.6g}, "
                  f"smallest {min(errors.values()):.3e}", flush=True)
            expect(errors[worst] <= 2. * median,
                   f"{points}, {method}: error {errors[worst]} at {worst} is "
                   f"above twice the median {median}")


main()
