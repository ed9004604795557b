"""Bases of degree two and three on points from the outline: errors of the cantilever
(paper P, 4.1) in small strains, on cells that cut all of its sides, and of a ring
held at a curve; conforming boundaries on splines."""

from math import cos, radians, sin

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


def turned(angle):
    """A grid about the beam's middle, turned."""
    c, s = cos(radians(angle)), sin(radians(angle))
    return ["Grid/Arguments = 20, 20 : 0, 0 : 10, 10", f"Grid/Rotation = {angle}",
            f"Grid/Shift = {4.013 - 5 * c + 5 * s}, {0.47 - 5 * s - 5 * c}"]


def check_cantilever():
    """What hold a cell's mean gap have springs beside it on these functions:
    errors as by Nitsche's method, on inclined clamps, too (means alone: 8e-4,
    8e-5, 8e-6, inclined 1e-2). A penalty's own gap is 5e-6."""
    for enforcement, gap in (("nitsche", 0), ("lagrange multiplier", 0),
                             ("augmented Lagrangian", 0), ("implicit boundary", 0),
                             ("projected penalty", 5e-6)):
        for angle in (0, 30):
            more = [f"Boundaries/clamp/Enforcement = {enforcement}",
                    *(turned(angle) if angle else [])]
            if gap == 0:
                more.append("Boundaries/clamp/Penalty factor = 10000")
            errors = []
            for level, bound in enumerate((2e-4, 2e-5, 2.5e-6)):
                error, n_points = tip_error("quadratic spline", 3, level, more)
                errors.append(error)
                expect(error < bound + gap, f"{enforcement}, level {level}: {error}")
                # tensor rules in the boxes that the grid leaves of the beam
                cells = (8 * 2**(level + 1) + 1) * (2**(level + 1) + 1)
                expect(angle or n_points == 9 * cells,
                       f"{n_points} points in {cells} cells")
            print(f"{enforcement}, {angle} degrees:",
                  *(f"{error:.2e}" for error in errors))
    # cubic splines' errors change their sign here: far below Nitsche's
    for basis, points, bounds in (("cubic spline", 4, (5e-6, 5e-7)),
                                  ("quadratic", 3, (1.2e-4, 1e-6))):
        errors = [tip_error(
            basis, points, level,
            ["Boundaries/clamp/Enforcement = lagrange multiplier",
             "Boundaries/clamp/Penalty factor = 10000"])[0] for level in (0, 2)]
        print(f"{basis}, multiplier: {errors[0]:.2e}, {errors[1]:.2e}")
        for error, bound in zip(errors, bounds):
            expect(error < bound, f"{basis}: error {error}")


def check_ring():
    """A curved boundary: each particle held for itself locks (2e-2)."""
    for basis, enforcement, bound in (
            ("quadratic spline", "lagrange multiplier", 2e-4),
            ("quadratic spline", "implicit boundary", 2e-4),
            ("quadratic spline", "projected penalty", 2e-4),
            ("quadratic spline", "nitsche", 1e-4),
            ("quadratic", "lagrange multiplier", 1e-4),
            ("linear", "lagrange multiplier", 6e-3),
            # 22 steps while slivers had no bound
            ("linear", "nitsche", 6e-3)):
        summary = run_scene("beyond/held-ring.prm", "ring", [
            "Output/Pictures every = 0", f"Grid/Basis = {basis}",
            f"Boundaries/hub/Enforcement = {enforcement}"])
        results, counts = summary["results"], summary["counts"]
        error = max(results[f"top u_{x}"]["error"] for x in "xy")
        print(f"ring, {basis}, {enforcement}: {error:.1e}, "
              f"{counts['newton iterations']} iterations")
        expect(error < bound and counts["newton iterations"] <= 4,
               f"ring, {basis}, {enforcement}")
        expect(abs(results["support M_z"]["value"]) < 1e-4, "moment of the hub")


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
check_ring()
check_conforming()
