"""A load on a side of the grid, or on a line of its own, is exact on every basis.

Linear displacements, two steps, quadrilaterals, triangles, hexahedra and tetrahedra.
"""

from driver import expect, run_scene

SCENE = "beyond/pulled-block.prm"
QUIET = ["Output/Pictures every = 0"]
LINE = ["Boundaries/load/Kind = nonconforming", "Boundaries/load/Boundary id = 0",
        "Boundaries/load/Polyline = 2 0; 2 1", "Boundaries/load/Rule = cut"]
BOX = ["Dimension = 3", "Grid/Arguments = 4, 2, 2 : 0, 0, 0 : 2, 1, 1",
       "Bodies/block/Mesh/Arguments = 1, 1, 1 : 0, 0, 0 : 2, 1, 1",
       "Boundaries/Names = left, bottom, load, back, front",
       *[f"Boundaries/{side}/{entry}" for side, number in (("back", 4), ("front", 5))
         for entry in ("Kind = conforming", f"Boundary id = {number}", "Constraint = slip")],
       "Boundaries/load/Traction = 1e4 * t; 0; 0", "Measurements/corner/Point = 2, 1, 1",
       "Measurements/corner/Reference = 0.0182; -0.0039; 0",
       "Measurements/support/Reference = -1e4; 0; 0"]
CASES = {
    "quadrilaterals": [],
    "a line of its own": LINE,
    "triangles": ["Grid/Cells = triangles"],
    "quadratic triangles": ["Grid/Cells = triangles", "Grid/Basis = quadratic"],
    "quadratic splines": ["Grid/Basis = quadratic spline"],
    "cubic splines": ["Grid/Basis = cubic spline"],
    "hexahedra": BOX,
    "tetrahedra": [*BOX, "Grid/Cells = tetrahedra"],
    "spline hexahedra": [*BOX, "Grid/Basis = quadratic spline"],
}

for title, settings in CASES.items():
    for ranks in (1, 2) if title in ("quadrilaterals", "tetrahedra") else (1,):
        results = run_scene(SCENE, "pulled", [*QUIET, *settings], ranks)["results"]
        worst = max(abs(results[name]["error"]) for name in
                    ("corner u_x", "corner u_y", "support F_x"))
        print(f"{title}, {ranks} ranks: {worst:.1e}", flush=True)
        expect(worst < 1e-9, title)
