"""Newton's residuals fall quadratically for each material and for penalty slip.

The order is that of the last three residuals above round-off; loads and penalty
are such that the third of them is neither near round-off nor the first small
one, where an order of two does not show.
"""

from pathlib import Path

from driver import expect, run_scene

SCENE = Path(__file__).with_name("newton.prm")
SMALLEST_ORDER = 1.8

CORNER = ["Bodies/block/Body force = 0; -200",
          "Boundaries/floor/Constraint = slip",
          "Boundaries/floor/Penalty factor = 1e4"]
# In a band as wide as this, residuals fall far before they meet round-off.
IMPLICIT = ["Boundaries/floor/Enforcement = implicit boundary",
            "Boundaries/floor/Band width = 1e-6"]
RUNS = {
    "St. Venant-Kirchhoff": ["Bodies/block/Material/Model = "
                             "St. Venant-Kirchhoff"],
    "neo-Hookean": [],
    "Hencky": ["Bodies/block/Material/Model = Hencky"],
    "penalty slip, chamfered corner": [
        *CORNER, "Boundaries/floor/Enforcement = penalty",
        "Boundaries/floor/Polyline = 0 0.3; 0.3 0; 1 0 | 0 1; 0 0.3"],
    "projected penalty slip, corner": [
        *CORNER, "Bodies/block/Body force = 0; -400",
        "Boundaries/floor/Polyline = 0 0; 1 0 | 0 1; 0 0"],
    "augmented Lagrangian": ["Boundaries/floor/Enforcement = "
                             "augmented Lagrangian"],
    "Lagrange multiplier": ["Boundaries/floor/Enforcement = "
                            "lagrange multiplier"],
    "implicit boundary": IMPLICIT,
    "implicit boundary slip, corner": [
        *CORNER, *IMPLICIT, "Boundaries/floor/Normals = particle",
        "Boundaries/floor/Polyline = 0 0; 1 0 | 0 1; 0 0"],
}
# Fine enough that the preconditioner alone is not nearly exact.
SLOPPY = ["Linear solver/Kind = iterative", "Linear solver/Tolerance = 0.1",
          "Grid/Arguments = 40, 32 : 0, 0 : 2.5, 2", "Bodies/block/Mesh/Refinements = 2"]


def order_and_counts(folder, settings):
    summary = run_scene(SCENE, folder, settings)
    return summary["results"]["rate order"]["value"], summary["counts"]


def main():
    for title, settings in RUNS.items():
        order, counts = order_and_counts(title, settings)
        print(f"{title}: order {order:.2f}, {counts['newton iterations']} "
              "iterations")
        expect(order >= SMALLEST_ORDER, f"{title}: order {order}")
        expect(counts["halved steps"] == 0, f"{title}: the step was halved")
    # What this test would see of a tangent that is not the residual's.
    order, _ = order_and_counts("sloppy", SLOPPY)
    print(f"sloppy linear solver: order {order:.2f}")
    expect(order < 1.5, "the order doesn't tell inexact from exact tangents")


main()
