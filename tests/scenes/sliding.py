"""P 4.3, L 4.4: a cylinder slides down a plane on all kinds of grids."""

from driver import expect, run_scene

TWO_D = "multiplier/4.4-sliding-cylinder"
THREE_D = "multiplier/4.4-sliding-cylinder-3d"

# Constant acceleration is exact in any steps, so these are coarse.
COARSE_2D = ["Time/Step = 0.05"]
COARSE_3D = ["Grid/Arguments = 18, 25, 6 : -0.24, -4.32, -0.72 : 4.08, 1.68, 0.72",
             "Bodies/cylinder/Mesh/Refinements = 1",
             "Bodies/cylinder/Points per direction = 3", "Time/Step = 0.1"]
PARTICLES = ["Boundaries/plane/Enforcement = penalty"]

RUNS = {
    "a, squares": (TWO_D, COARSE_2D),
    "a, squares, particle-wise": (TWO_D, COARSE_2D + PARTICLES),
    "b, turned squares": (TWO_D + "-rotated", COARSE_2D),
    "c, triangles": (TWO_D + "-triangles", COARSE_2D),
    "d, unstructured triangles": (TWO_D + "-distorted", COARSE_2D),
    "d, triangles of a mesh file": (TWO_D + "-unstructured", COARSE_2D),
    "d, beta = 1e18 Pa/m": ("penalty/4.3-sliding-cylinder", ["Time/Step = 0.02"]),
    "hexahedra": (THREE_D, COARSE_3D),
    "tetrahedra": (THREE_D + "-tetrahedra", COARSE_3D),
    "unstructured tetrahedra": (THREE_D + "-distorted", COARSE_3D),
    "tetrahedra of a mesh file": (THREE_D + "-unstructured",
                                  ["Time/Step = 0.05", "Grid/Refinements = 0"]),
    "unstructured tetrahedra, beta = 1e18 Pa/m": ("penalty/4.3-sliding-cylinder-3d", []),
}


def main():
    for name, (scene, settings) in RUNS.items():
        results = run_scene(scene + ".prm", "run",
                            ["Output/Pictures every = 0", *settings])["results"]
        path = results["centre path"]
        angle = abs(results["centre angle"]["value"])
        across = abs(results["across path"]["value"])
        print(f"{name}: path {path['value']:.7f} m, error {path['error']:.1e}, "
              f"angle {angle:.1e}, off the plane {across:.1e} m")
        expect(abs(path["reference"] - 4.2478546) < 1e-7, "the reference itself")
        expect(path["error"] < 1e-6, f"path of {name}")
        expect(angle < 0.02, f"angle of {name}")
        # It settles by the load over Young's modulus, about 1e-4 m.
        expect(across < 1e-3, f"support of {name}")


main()
