"""Paper I, sections 5.5 and 5.6: no point goes behind a footing or funnel's wall.

Argument: 'footing' or 'funnel'.
"""

import csv
import sys

from driver import expect, run_scene

ALLOWED = 0.05  # of a cell
# Walls that give way show that the test would see it.
WEAK = ["Enforcement = penalty", "Penalty factor = 0.01"]


def rows(scene, settings):
    run_scene(f"implicit-boundary/{scene}", "run",
              ["Output/Pictures every = 0", *settings])
    with open("run/history.csv") as file:
        return [{name: float(value) for name, value in row.items()}
                for row in csv.DictReader(file)]


def deepest(history):
    depths = {name: max(row[name] for row in history) for name in history[0]
              if name.endswith(" depth")}
    name = max(depths, key=depths.get)
    print(f"{len(history)} steps: deepest {depths[name]:.4f} of a cell, {name}")
    return depths[name]


def check(scene, n_steps, moved, settings):
    history = rows(scene, settings)
    expect(len(history) == n_steps, "steps were halved")
    expect(deepest(history) <= ALLOWED, "points are behind a wall")
    weak = [f"Boundaries/{moved}/{entry}" for entry in WEAK]
    expect(deepest(rows(scene, [*settings, *weak])) > ALLOWED,
           "walls that give way are not seen")
    return history


def footing():
    history = check("5.5-footing.prm", 20, "footing", [])
    forces = [-row["force F_y"] for row in history]
    print(f"force at 0.05 m {forces[0]:.4g} N/m, at 1 m {forces[-1]:.4g} N/m")
    expect(all(a < b for a, b in zip(forces, forces[1:])),
           "the force doesn't grow with depth")


def funnel():
    settings = ["Time/End time = 12"]
    history = check("5.6-funnel.prm", 12, "top", settings)
    multiplier = rows("5.6-funnel.prm", [
        *settings, "Boundaries/top/Enforcement = lagrange multiplier"])
    for row, other in zip(history, multiplier):
        print(f"force at {4 * row['time']:.0f} mm: {row['force F_x']:.1f} N/mm, "
              f"with multipliers {other['force F_x']:.1f} N/mm")
        expect(abs(row["force F_x"] / other["force F_x"] - 1) < 0.01,
               "the curved wall locks")
    for row in history:
        for place in ("bottom", "middle", "top"):
            expect(abs(row[f"edge_{place} u_x"] + 4 * row["time"]) < 1e-4,
                   f"the right edge isn't vertical at {row['time']} s")


{"footing": footing, "funnel": funnel}[sys.argv[1]]()
