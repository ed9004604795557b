"""Cells that are finer than the points are apart: pieces of the body that hang on the
rest by a vertex do not turn about it, and reactions balance its weight."""

from driver import expect, run_scene

PLANE = ["Grid/Refinements = 1", "Grid/Arguments = 24, 24 : -1, -6 : 11, 6",
         "Bodies/beam/Mesh/Refinements = 0", "Bodies/beam/Points per direction = 3"]
SOLID = ["Grid/Refinements = 0", "Grid/Axis = 1, 2, 3",
         "Grid/Arguments = 20, 10, 10 : -1, -2.2, -2.2 : 9, 2.8, 2.8",
         "Bodies/beam/Mesh/Refinements = 0", "Bodies/beam/Points per direction = 2",
         "Bodies/beam/Mesh/Arguments = 16, 2, 2 : 0, 0, 0 : 8, 1, 1"]
CASES = [  # scene, its settings, cells, shift of the grid, rotation
    ("penalty/4.1-cantilever.prm", PLANE, "triangles", "0.4569, -0.1599", 0),
    ("penalty/4.1-cantilever.prm", PLANE, "8 triangles", "0.4572, 0.468", 8.69),
    ("penalty/4.1-cantilever.prm", PLANE, "8 triangles", "-0.2565, -0.0257", -37.06),
    ("penalty/4.1-cantilever-3d.prm", SOLID, "tetrahedra", "-0.041, -0.13, 0.026", 0),
    ("penalty/4.1-cantilever-3d.prm", SOLID, "tetrahedra", "0.224, 0.065, 0.041", -13.1)]
WEIGHT = 8 * 1000 * 9.81

for scene, entries, cells, shift, degrees in CASES:
    results = run_scene(scene, "run", [*entries, f"Grid/Cells = {cells}",
                                       f"Grid/Shift = {shift}",
                                       f"Grid/Rotation = {degrees}"])["results"]
    force = results["support F_y"]["value"]
    print(f"{scene}, {cells}, {shift}, {degrees} degrees: "
          f"tip {results['tip u_y']['value']:.4g} m, reaction {force:.10g} N")
    expect(abs(force / WEIGHT - 1) < 1e-8, "the reaction is not the weight")
