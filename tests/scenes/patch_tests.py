"""Linear displacements, imposed on a cut boundary, are those of the whole body.

Arguments: '2d' or '3d', and the number of random inclinations (3). Each has a grid
turned and shifted, and a displacement A x + b of its own, A of size 1e-3, from
fixed seeds. Errors are relative to the exact values, both in the norm L2.
"""

import random
import sys
from pathlib import Path

from driver import expect, run_scene

HERE = Path(__file__).parent
YOUNG, POISSON = 1e6, 0.3
MU = YOUNG / (2 * (1 + POISSON))
LAMBDA = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON))
AXES = "xyz"
STRESSES = {2: [(0, 0), (1, 1), (0, 1)],
            3: [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]}

GRIDS = {
    "a, quads": (2, []),
    "b, flat quads": (2, ["Grid/Arguments = 14, 9 : -1.2, -1.2 : 1.2, 1.2"]),
    "c, triangles": (2, ["Grid/Cells = triangles"]),
    "d, distorted triangles": (2, ["Grid/Cells = triangles",
                                   "Grid/Distortion = 0.25"]),
    "hexes": (3, []),
    "tets": (3, ["Grid/Cells = tetrahedra"]),
    "distorted tets": (3, ["Grid/Cells = tetrahedra", "Grid/Distortion = 0.2"]),
}
# A boundary each, as multipliers are constant in a cell and tractions of two sides
# differ.
# Constraints that hardly differ, where cells share none, are told apart the sooner
# the larger gamma.
FACTORS = {method: 1e4 for method in ("penalty", "projected penalty",
                                      "implicit boundary", "augmented Lagrangian",
                                      "lagrange multiplier")}
FACTORS["stabilised"] = 1e6
SIDES = {2: ("left", "right", "bottom", "top"),
         3: ("left", "right", "bottom", "top", "back", "front")}
# Largest error of the displacement. Multipliers are exact; a penalty of 1e4 E/h
# gives way by the strain times h / 1e4, implicit boundaries by 3/8 delta times
# the strain (delta / h = 1e-6), more where tractions of two sides meet in a cell.
BOUNDS = {"penalty": 2e-4, "projected penalty": 2e-4, "implicit boundary": 5e-6,
          "augmented Lagrangian": 1e-11, "lagrange multiplier": 1e-11,
          # of the iteration over many weak multipliers: 6e-11 on distorted tets
          "stabilised": 2e-10}
# Strains are differences over a cell, a fifth of the body.
STRESS_FACTOR = 10.


def sides(dim, entry):
    return [f"Boundaries/{side}/{entry}" for side in SIDES[dim]]


def enforcement(dim, method):
    factor = sides(dim, f"Penalty factor = {FACTORS[method]}")
    if method != "stabilised":
        return factor + sides(dim, f"Enforcement = {method}")
    # a penalty on jumps costs nothing where tractions are even
    return (factor + sides(dim, "Enforcement = lagrange multiplier")
            + sides(dim, "Superfluous constraints = stabilise"))


def random_case(seed, dim):
    """Settings of a random grid and displacement."""
    numbers = random.Random(seed)
    grid = [f"Grid/Rotation = {numbers.uniform(0, 90)!r}", "Grid/Shift = "
            + ", ".join(repr(numbers.uniform(-0.1, 0.1)) for _ in range(dim))]
    if dim == 3:
        grid.append("Grid/Axis = " + ", ".join(
            repr(numbers.uniform(0.1, 1)) for _ in range(dim)))
    A = [[numbers.uniform(-1e-3, 1e-3) for _ in range(dim)] for _ in range(dim)]
    b = [numbers.uniform(-1e-3, 1e-3) for _ in range(dim)]
    linear = [" + ".join([repr(b[i])] + [f"({A[i][j]!r}) * {AXES[j]}"
                                         for j in range(dim)])
              for i in range(dim)]
    trace = sum(A[i][i] for i in range(dim))
    stress = [MU * (A[i][j] + A[j][i]) + (LAMBDA * trace if i == j else 0)
              for i, j in STRESSES[dim]]
    value = "; ".join(f"t * ({u})" for u in linear)
    return grid + sides(dim, f"Value = {value}") + [
        "Measurements/displacement/Exact = " + "; ".join(linear),
        "Measurements/stress/Exact = " + "; ".join(map(repr, stress))]


def errors(dim, settings):
    summary = run_scene(HERE / f"patch_{dim}d.prm", "run", settings)
    return [summary["results"][name]["value"]
            for name in ("displacement", "stress")]


def check(title, dim, method, settings):
    """What is wrong, if anything is."""
    found = [errors(dim, [*settings, *enforcement(dim, method),
                          *random_case(seed, dim)]) for seed in seeds()]
    displacement, stress = (max(column) for column in zip(*found))
    print(f"{title}, {method}: displacement {displacement:.1e}, stress "
          f"{stress:.1e}", flush=True)
    bound = BOUNDS[method]
    if displacement <= bound and stress <= STRESS_FACTOR * bound:
        return []
    return [f"{title}, {method}: {displacement:.1e}, {stress:.1e}"]


def seeds():
    return range(int(sys.argv[2]) if len(sys.argv) > 2 else 3)


def main():
    failures = []
    for title, (dim, settings) in GRIDS.items():
        if sys.argv[1] == f"{dim}d":
            for method in BOUNDS:
                failures += check(title, dim, method, settings)
    expect(not failures, "\n".join(failures))


main()
