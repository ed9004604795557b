"""Splines on points from the outline: errors of the cantilever (paper P, 4.1) in
small strains, as a prototype of the method has them, on cells that cut all of its
sides; conforming boundaries on splines."""

from math import log2

from driver import expect, run_scene

SCENE = "penalty/4.1-cantilever-small-strain.prm"
OUTLINE = ["Output/Pictures every = 0", "Bodies/beam/Points = clipped",
           "Bodies/beam/Piece = gauss", "Bodies/beam/Mesh/Generator =",
           "Bodies/beam/Outline = 0 0; 8 0; 8 1; 0 1"]


def tip_error(basis, points, level, settings=()):
    """At h = 2^-level / 2, with the number of points that were needed."""
    h = 0.5 / 2**level
    summary = run_scene(SCENE, "run", [
        *OUTLINE, f"Grid/Basis = {basis}", f"Grid/Refinements = {level}",
        f"Bodies/beam/Points per direction = {points}",
        f"Grid/Shift = {-h / 2}, {-1 - 0.3 * h}", *settings])
    return summary["results"]["tip u_y"]["error"], summary["counts"]["points"]


def check_cantilever():
    # of the prototype, which has no ghost penalty: 3 x 3 points, projected
    # penalty at 1e4 E/h
    for level, should in enumerate((1.1e-3, 1.1e-4, 1.5e-5)):
        error, n_points = tip_error("quadratic spline", 3, level,
                                    ["Grid/Ghost penalty = 0"])
        print(f"quadratic spline, h = 2^-{level + 1}: {error:.2e}")
        expect(abs(error / should - 1) < 0.07, f"error at level {level}")
        # tensor rules in the boxes that the grid leaves of the beam
        cells = (8 * 2**(level + 1) + 1) * (2**(level + 1) + 1)
        expect(n_points == 9 * cells, f"{n_points} points in {cells} cells")
    for basis, points, bound in (("cubic spline", 4, 6e-3), ("quadratic", 3, 6e-3)):
        coarse, fine = (tip_error(basis, points, level)[0] for level in (0, 2))
        rate = log2(coarse / fine) / 2
        print(f"{basis}: {coarse:.2e}, {fine:.2e}, rate {rate:.2f}")
        expect(coarse < bound and rate > 3.5, f"{basis}: rate {rate}")


def check_conforming():
    """A clamp on the grid's side holds every place of it, at no error but that
    of the functions: the same without the part of the grid outside of it."""
    for basis, points, bound in (("quadratic spline", 3, 2e-5),
                                 ("cubic spline", 4, 5e-6)):
        error, _ = tip_error(basis, points, 1, [
            "Grid/Arguments = 17, 5 : 0, 0 : 8.5, 2.5", "Grid/Shift = 0, -1.15",
            "Boundaries/clamp/Kind = conforming", "Boundaries/clamp/Polyline =",
            "Boundaries/clamp/Rule = equal",
            "Boundaries/clamp/Particles per segment = 0",
            "Boundaries/clamp/Penalty factor = 10000",
            "Boundaries/clamp/Enforcement = projected penalty"])
        print(f"conforming, {basis}: {error:.2e}")
        expect(error < bound, f"conforming {basis}")


check_cantilever()
check_conforming()
