"""The grid is never reset (total Lagrangian), or is, on quadratic splines.

Arguments: how often the vortex' grid is refined (1). The cantilever of paper P (4.1)
under its whole weight in 20 steps; the column, for each enforcement at its base; the
generalised vortex (dynamic).
"""

import sys
from math import log2
from pathlib import Path

from driver import expect, run_scene
from ranks import COARSE

SHIFTED = Path(__file__).with_name("kept_grid_shifted.prm")
FLIGHT = Path(__file__).with_name("kept_grid_flight.prm")
QUIET = ["Output/Pictures every = 0"]
REFINEMENTS = int(sys.argv[1]) if len(sys.argv) > 1 else 1
METHODS = ("penalty", "projected penalty", "augmented Lagrangian",
           "lagrange multiplier", "implicit boundary", "nitsche")


def tip_error(level, settings):
    h = 0.5 / 2**level
    summary = run_scene("beyond/cantilever-total-lagrangian.prm", "run", [
        *QUIET, f"Grid/Refinements = {level}",
        f"Grid/Shift = {-h / 2}, {-1 - 0.3 * h}", *settings])
    expect(summary["counts"]["halved steps"] == 0, "a step was halved")
    return summary["results"]["tip u_y"]["error"]


def check_cantilever():
    for level, bound in enumerate((3e-4, 3e-5)):
        one, many = (tip_error(level, settings) for settings in (["Time/Step = 1"], []))
        print(f"cantilever, never reset, h = 2^-{level + 1}: 1 step {one:.2e}, "
              f"20 steps {many:.2e}", flush=True)
        expect(max(one, many) <= bound, "cantilever, never reset")
    error = tip_error(1, ["Grid/Reset = every step",
                          "Bodies/beam/Points per direction = 3"])
    print(f"cantilever, reset 20 times, h = 1/4: {error:.2e}")
    expect(error <= 5e-4, "cantilever, reset")


def column_error(cells, settings):
    """With a base that cuts the lowest cell in halves."""
    h = 50 / cells
    return run_scene("beyond/column-compaction-penalty.prm", "run", [
        *QUIET, "Bodies/column/Points per direction = 3",
        f"Grid/Arguments = 1, {cells + 1} : 0, {-h / 2} : {h}, {50 + h / 2}",
        f"Bodies/column/Mesh/Arguments = 1, {cells} : 0, 0 : {h}, 50",
        f"Boundaries/base/Polyline = 0 0; {h} 0",
        f"Measurements/support/Reference = 0; {40e3 * h}*t",
        *settings])["results"]["stress"]["value"]


def check_column():
    """What is left with a grid that is reset is the points' rule of integration
    in cells that they were not made for: of no order, but small on splines."""
    spline = ["Grid/Basis = quadratic spline"]
    exact_rule = ["Bodies/column/Points = clipped", "Bodies/column/Piece = gauss",
                  "Grid/Reset = never"]
    linear = [column_error(cells, []) for cells in (8, 16)]
    for method in METHODS:
        base = [f"Boundaries/base/Enforcement = {method}"]
        found = [column_error(cells, spline + base) for cells in (8, 16)]
        kept = [column_error(cells, spline + base + exact_rule) for cells in (8, 16)]
        print(f"column, {method}, 8 and 16 cells: reset "
              + ", ".join(f"{error:.4f}" for error in found)
              + ", never reset " + ", ".join(f"{error:.2e}" for error in kept), flush=True)
        expect(all(10 * ours < theirs for ours, theirs in zip(found, linear)), method)
        expect(log2(kept[0] / kept[1]) > 1.7, f"{method}, never reset")


def check_vortex():
    # With a reset each step the goal is 1.8: missed by a little from h = 1/8 to 1/16.
    for basis, cells, reset, least in (
            ("quadratic spline", "as made", "never", 2.5),
            ("quadratic spline", "as made", "every step", 1.7),
            ("quadratic", "as made", "never", 2.5),
            ("quadratic", "triangles", "never", 2.5)):
        found = []
        name = f"vortex, {basis}, cells {cells}, reset {reset}"
        for level in range(REFINEMENTS + 1):
            results = run_scene("beyond/generalised-vortex.prm", "vortex", [
                *QUIET, f"Grid/Refinements = {level}", f"Grid/Reset = {reset}",
                f"Grid/Basis = {basis}", f"Grid/Cells = {cells}"])["results"]
            found.append(results["displacement"]["value"])
            print(f"{name}, h = 2^-{level + 3}: {found[-1]:.3e}, energy "
                  f"{results['energy total']['error']:.2e}", flush=True)
        rate = log2(found[-2] / found[-1])
        print(f"{name}: rate {rate:.2f}")
        expect(rate >= least, name)


def check_moment():
    """Of a block's weight about the origin, held at a side that moves by half its
    width: 10 kN times a lever of 1 m."""
    for steps in (1, 5):
        moment = run_scene(SHIFTED, "run", [f"Time/Step = {1 / steps}"])[
            "results"]["support M_z"]["value"]
        print(f"shifted block, {steps} steps: moment {moment / 1e4 - 1:.1e} off")
        expect(abs(moment / 1e4 - 1) < 1e-9, "moment of a conforming boundary")


def check_steps():
    """A linear problem does not know in how many steps it is solved: nor do what
    holds cells with few points and ghost penalties."""
    for title, settings in (
            ("few points", ["Bodies/beam/Mesh/Arguments = 16, 2 : 0, 0 : 8, 1",
                            "Bodies/beam/Points per direction = 1"]),
            ("ghost penalty", ["Grid/Ghost penalty = 1"])):
        found = []
        for steps in (1, 10):
            found.append(run_scene("quickstart.prm", "run", [
                *QUIET, *COARSE, "Grid/Reset = never", *settings,
                "Bodies/beam/Material/Model = linear elastic",
                "Bodies/beam/Body force = 0; -9.81 * t",
                f"Time/Step = {1 / steps}"])["results"]["tip u_y"]["value"])
        print(f"{title}, 10 steps instead of one: {found[1] / found[0] - 1:.1e} off")
        expect(abs(found[1] / found[0] - 1) < 1e-9, f"{title} depends on steps")


def check_flight():
    """A disk under its weight, thrown: its path is exact, and it stays as it
    was."""
    for cells in ("as made", "triangles", "8 triangles"):
        results = run_scene(FLIGHT, "run", [f"Grid/Cells = {cells}"])["results"]
        strain = results["energy strain"]["value"] / results["energy kinetic"]["value"]
        print(f"flight, quadratic, cells {cells}: path "
              f"{results['centre path']['error']:.1e} m off, strain energy {strain:.1e}")
        expect(results["centre path"]["error"] < 1e-8 and strain < 1e-8, cells)


check_flight()
check_moment()
check_steps()
check_cantilever()
check_column()
check_vortex()
