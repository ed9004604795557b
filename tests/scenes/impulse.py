"""Impulses of forces that act from the start: all of them are the change of momentum."""

import csv
from pathlib import Path

from driver import expect, run_scene

SCENE = Path(__file__).with_name("impulse.prm")
MASS, GRAVITY = 1000., 10.  # [kg], [m/s2]
FLOORS = {"conforming": ["Boundaries/floor/Kind = conforming",
                         "Boundaries/floor/Boundary id = 2"]}
for method in ("penalty", "lagrange multiplier", "implicit boundary", "nitsche"):
    FLOORS[method] = ["Boundaries/floor/Polyline = 0 0; 1 0",
                      f"Boundaries/floor/Enforcement = {method}"]


def momentum(path):
    """What Newmark's method with beta = 1/4 makes of the places of the centre."""
    with open(path / "history.csv") as file:
        rows = [(float(row["dt"]), float(row["centre y"])) for row in csv.DictReader(file)]
    y, v = 0.5, 0.
    for dt, new in rows:
        y, v = new, 2 * (new - y) / dt - v
    return MASS * v


def check_floors():
    for title, settings in FLOORS.items():
        for load in ([], ["Grid/Reset = never"]):
            summary = run_scene(SCENE, "run", [*settings, *load])
            impulse = summary["results"]["floor I_y"]["value"]
            weight = MASS * GRAVITY * 0.03
            error = (impulse - weight - momentum(Path("run"))) / weight
            print(f"{title}, {load}: floor {impulse / weight:.4f} of the weight's "
                  f"impulse, momentum {error:.1e} off", flush=True)
            expect(impulse > 1e-3 * weight, f"{title}: no force")
            expect(abs(error) < 1e-9, f"{title}: the momentum is {error:.1e} off")


def check_traction():
    for kind in ("dynamic", "quasi-static"):
        for step in (0.01, 0.03):
            summary = run_scene(SCENE, "run", [
                *FLOORS["penalty"], "Grid/Arguments = 6, 5 : -0.25, 0 : 1.25, 1.25",
                "Boundaries/Names = floor, side", f"Time/Step = {step}",
                f"Time/Kind = {kind}", "Boundaries/side/Polyline = 0 1; 0 0",
                "Boundaries/side/Rule = cut", "Boundaries/side/Constraint = traction",
                "Boundaries/side/Traction = 1000 * (1 + t); 0",
                "Measurements/Names = floor, side", "Measurements/side/Quantity = impulse",
                "Measurements/side/Boundary = side"])
            error = summary["results"]["side I_x"]["value"] / 30.45 - 1
            print(f"traction, {kind}, steps of {step}: {error:.1e} off")
            expect(abs(error) < 1e-12, f"traction, {kind}")


check_floors()
check_traction()
