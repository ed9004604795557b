"""Nitsche's method on quadratic splines and few points: paper P's cantilever (4.1).

Small strains: the error of the tip wherever the clamp cuts its cells, at the hard
places, too; a ghost penalty bounds the condition number; forces and moments of
large strains balance; Newton's iteration and the
non-symmetric form; the contained block of paper I (5.1); a pressed plastic block.
"""

import random
from pathlib import Path

from driver import expect, run_scene

SMALL = "beyond/cantilever-nitsche.prm"
LARGE = "beyond/cantilever-total-lagrangian.prm"
BLOCK = "implicit-boundary/5.1-contained-block.prm"
PRESS = Path(__file__).with_name("pressed_block.prm")
NEWTON = Path(__file__).with_name("newton.prm")
QUIET = ["Output/Pictures every = 0"]
NEAR_FACES = [1e-3, 1e-6, 1e-9, 1e-12]
BOUNDS = {0: 2e-4, 1: 2e-5, 2: 2e-6}  # of h = 1/2, 1/4, 1/8
N_RANDOM = {0: 12, 1: 6, 2: 2}


def tip_error(level, cut, settings=()):
    """cut: of a cell, from its left face to the clamp."""
    h = 0.5 / 2**level
    summary = run_scene(SMALL, "run", [
        *QUIET, f"Grid/Refinements = {level}",
        f"Grid/Shift = {-h * cut!r}, {-1 - 0.3 * h!r}", *settings])
    return summary["results"]["tip u_y"]["error"]


def check_cuts(title, settings, levels, bounds):
    numbers = random.Random(3)
    for level in levels:
        cuts = [numbers.random() for _ in range(N_RANDOM[level])]
        if level == 0:
            cuts += [*NEAR_FACES, *[1 - cut for cut in NEAR_FACES]]
        errors = {cut: tip_error(level, cut, settings) for cut in cuts}
        worst = max(errors, key=errors.get)
        print(f"{title}, h = 2^-{level + 1}, {len(cuts)} cuts: {min(errors.values()):.2e} "
              f"to {errors[worst]:.2e}, at {worst:.6g}", flush=True)
        expect(errors[worst] <= bounds[level], f"{title}: {errors[worst]} at {worst}")


def check_ghost_penalty(basis):
    """With it neither the error nor the matrix knows where the clamp cuts."""
    found = {}
    for factor in (0, 0.1):
        for cut in (1 - 1e-3, 1 - 1e-6, 1 - 1e-9):
            results = run_scene(SMALL, "ghost", [
                *QUIET, f"Grid/Basis = {basis}", f"Grid/Ghost penalty = {factor}",
                "Grid/Refinements = 1", f"Grid/Shift = {-0.25 * cut!r}, -1.075",
                "Measurements/Names = tip, condition",
                "Measurements/condition/Quantity = condition"])["results"]
            found[factor, cut] = results["condition"]["value"], results["tip u_y"]["error"]
    conditions, errors = (
        [[found[factor, cut][i] for cut in (1 - 1e-3, 1 - 1e-6, 1 - 1e-9)]
         for factor in (0, 0.1)] for i in range(2))
    print(f"{basis}: condition numbers without a ghost penalty", *("%.1e" % c for c in
          conditions[0]), "with it", *("%.2e" % c for c in conditions[1]), "errors",
          *("%.2e" % e for e in errors[1]))
    expect(conditions[0][2] > 1e6 * conditions[0][0], f"{basis}: no need of one")
    expect(max(conditions[1]) < 1.1 * min(conditions[1]), f"{basis}: condition number")
    expect(max(errors[1]) < 1.1 * min(errors[1]), f"{basis}: error")


def check_balance(settings):
    """The clamp carries the weight and its moment."""
    summary = run_scene(LARGE, "large", [*QUIET, "Time/Step = 1", *settings,
                                         "Measurements/Names = tip, support, weight",
                                         "Measurements/weight/Quantity = path",
                                         "Measurements/weight/Direction = 1, 0"])
    results = summary["results"]
    moment = 78480 * (4 + results["weight path"]["value"])
    print(f"{settings}: tip {results['tip u_y']['error']:.2e}, weight "
          f"{results['support F_y']['error']:.1e}, moment "
          f"{results['support M_z']['value'] / moment - 1:.1e}, "
          f"{summary['counts']['newton iterations']} iterations")
    expect(results["support F_y"]["error"] < 1e-9, "weight")
    expect(abs(results["support M_z"]["value"] / moment - 1) < 1e-8, "moment")
    return results["tip u_y"]["error"]


def check_newton():
    for title, settings in {"fixed": [], "slip": ["Bodies/block/Body force = 0; -75",
                                                  "Boundaries/floor/Constraint = slip",
                                                  "Boundaries/floor/Polyline = 0 0; 1 0 | 0 1; 0 0",
                                                  "Boundaries/floor/Normals = particle"],
                            "plastic": ["Bodies/block/Material/Model = von Mises",
                                        "Bodies/block/Material/Yield stress = 2e5"]}.items():
        results = run_scene(NEWTON, "newton", ["Boundaries/floor/Enforcement = nitsche",
                                               *settings])["results"]
        print(f"Newton, {title}: order {results['rate order']['value']:.2f}")
        expect(results["rate order"]["value"] > 1.8, f"order, {title}")


def check_block():
    for angle in (0, 17, 30, 45, 88):
        for form in ("symmetric", "non-symmetric"):
            summary = run_scene(BLOCK, "block", [
                *QUIET, f"Grid/Rotation = {angle}",
                *[f"Boundaries/{side}/{entry}" for side in
                  ("left", "bottom", "top", "push") for entry in
                  ("Enforcement = nitsche", f"Nitsche form = {form}")]])
            worst = max(result["value"] for name, result in
                        summary["results"].items() if name.startswith("r_"))
            print(f"block at {angle} degrees, {form}: {worst:.1e}")
            expect(worst <= 1e-11, f"block at {angle} degrees")


def check_plastic():
    """Far beyond the yield stress, walls that cut cells do what sides of the grid
    do, in as many iterations: linear displacements are in both spaces."""
    found = {}
    for title, settings in {
            "conforming": [f"Boundaries/{wall}/{entry}" for wall, side in
                           (("ram", 0), ("stop", 1), ("floor", 2)) for entry in
                           ("Kind = conforming", f"Boundary id = {side}",
                            "Polyline =", "Rule = equal", "Enforcement = projected penalty")]
            + ["Grid/Shift = 0, 0", "Grid/Arguments = 10, 5 : 0, 0 : 1, 0.5"],
            "linear": [],
            "quadratic spline": ["Grid/Basis = quadratic spline",
                                 "Grid/Ghost penalty = 1e-3"]}.items():
        summary = run_scene(PRESS, "press", settings)
        results, counts = summary["results"], summary["counts"]
        found[title] = [results[name]["value"] for name in ("force F_x", "corner u_y")]
        error = max(abs(a / b - 1) for a, b in zip(found[title], found["conforming"]))
        print(f"pressed block, {title}: {found[title][0]:.8e} N, {error:.1e}, "
              f"{counts['newton iterations']} iterations", flush=True)
        expect(error < 1e-8 and counts["halved steps"] == 0, f"pressed block, {title}")
        expect(counts["newton iterations"] <= 45, f"pressed block, {title}")


def main():
    check_cuts("quadratic splines", [], (0, 1, 2), BOUNDS)
    check_cuts("cubic splines", ["Grid/Basis = cubic spline",
                                 "Bodies/beam/Points per direction = 4"], (0,), {0: 1e-5})
    check_ghost_penalty("linear")
    check_ghost_penalty("quadratic spline")
    error = tip_error(0, 0.5, ["Boundaries/clamp/Nitsche form = non-symmetric"])
    print(f"non-symmetric, h = 1/2: {error:.2e}")
    expect(error < 1e-3, "non-symmetric")
    expect(check_balance([]) < 3e-5, "tip")
    check_balance(["Grid/Reset = every step"])
    check_newton()
    check_block()
    check_plastic()


main()
