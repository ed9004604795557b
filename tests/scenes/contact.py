"""Contact and friction at walls that do not follow the grid, by each method.

Argument: 'friction' (a block on a plane sticks or slides as Coulomb says; 'friction-long':
all angles, grids and methods), 'ball' (thrown, in short steps), 'rolling' (a cylinder on
a plane slides, spins or rolls) or 'rod' (a turning rod pushes a block).
"""

import csv
import math
import sys

from driver import expect, run_scene

METHODS = ["penalty", "projected penalty", "augmented Lagrangian",
           "lagrange multiplier"]
G = 9.81


def rows(scene, settings):
    summary = run_scene(scene, "run", ["Output/Pictures every = 0", *settings])
    with open("run/history.csv") as file:
        return summary, [{name: float(value) for name, value in row.items()}
                         for row in csv.DictReader(file)]


def acceleration(history, column, start):
    """Of a parabola through the times from start on, by least squares."""
    late = [row for row in history if row["time"] > start - 1e-9]
    mean = sum(row["time"] for row in late) / len(late)
    t = [row["time"] - mean for row in late]
    second = sum(x**2 for x in t) / len(t)
    third = sum(x**3 for x in t) / len(t)
    weights = [x**2 - second - third / second * x for x in t]
    return 2 * (sum(w * row[column] for w, row in zip(weights, late)) /
                sum(w * x**2 for w, x in zip(weights, t)))


def block(degrees, part, rotation, method):
    """The block on a plane with friction of a part of tan(angle)."""
    angle = math.radians(degrees)
    c, s = math.cos(angle), math.sin(angle)
    friction = part * s / c
    summary, history = rows("beyond/friction-block.prm", [
        f"Grid/Rotation = {rotation}",
        f"Bodies/block/Mesh/Rotation = {-degrees}",
        f"Bodies/block/Mesh/Shift = {0.3 * c}, {-0.3 * s}",
        f"Boundaries/plane/Polyline = 0 0; {3 * c} {-3 * s}",
        f"Boundaries/plane/Friction coefficient = {friction}",
        f"Boundaries/plane/Enforcement = {method}",
        f"Measurements/centre/Direction = {c}, {-s}",
        "Time/End time = 0.4"])
    return summary, history, G * (s - friction * c)


def short():
    for i, degrees in enumerate((20, 30, 45)):
        for j, rotation in enumerate((-degrees, 0, 17 - degrees)):
            yield degrees, rotation, METHODS[(i + j) % 4], (0.9,), (
                (1.1,) if i == j else ())


def long():
    for degrees in (10, 20, 30, 45):
        for rotation in (-degrees, 0, 17 - degrees, 45 - degrees):
            for method in METHODS:
                yield degrees, rotation, method, (0.2, 0.9), (1.1,)


def friction(cases):
    missed = []
    for degrees, rotation, method, slides, sticks in cases():
        for part in slides:
            what = f"{degrees} degrees, {part} tan, grid at {rotation}, {method}"
            summary, history, exact = block(degrees, part, rotation, method)
            error = acceleration(history, "centre path", 0.2) / exact - 1
            print(f"{what}: acceleration {error:.1e}, "
                  f"{summary['counts']['halved steps']} steps halved", flush=True)
            if not abs(error) < 1e-3:
                missed.append(f"{what}: sliding is {error:.1e} off")
        for part in sticks:
            what = f"{degrees} degrees, {part} tan, grid at {rotation}, {method}"
            _, history, _ = block(degrees, part, rotation, method)
            late = [row["centre path"] for row in history
                    if row["time"] > 0.3 - 1e-9]
            print(f"{what}: sticks at {late[-1]:.2e} m, then moves "
                  f"{late[-1] - late[0]:.1e} m", flush=True)
            if not 0 < late[-1] < 2e-4:
                missed.append(f"{what}: does not stick")
            if not abs(late[-1] - late[0]) < 1e-6:
                missed.append(f"{what}: creeps")
    expect(not missed, "\n".join(missed))


def ball():
    """Steps far shorter than a collision: energy falls, friction is that of sliding."""
    c, s = math.cos(math.radians(20)), math.sin(math.radians(20))
    for method in METHODS:
        for step in (1e-3, 2e-4, 5e-5):
            what = f"ball, {method}, steps of {step} s"
            summary, history = rows("beyond/friction-ball.prm", [
                f"Boundaries/plane/Enforcement = {method}", f"Time/Step = {step}"])
            energy = [row["kinetic energy"] + row["strain energy"] +
                      row["mass"] * G * row["centre y"] for row in history]
            rise = max(e - min(energy[:i + 1]) for i, e in enumerate(energy)
                       ) / history[0]["kinetic energy"]
            along = history[-1]["hit I_x"] * c - history[-1]["hit I_y"] * s
            across = history[-1]["hit I_x"] * s + history[-1]["hit I_y"] * c
            print(f"{what}: energy rises by {rise:.1e}, friction "
                  f"{-along / across:.9f}, {summary['counts']['halved steps']} halved")
            expect(rise < 1e-4, f"{what}: energy grows")
            expect(abs(along / across + 0.2) < 1e-6, f"{what}: friction is off")


def rolling():
    for scene, allowed in (
            ("beyond/friction-cylinder.prm", (5e-3, 5e-2)),
            ("penalty/4.3-rolling-cylinder.prm", (3e-2, 3e-2)),
            ("penalty/4.3-rolling-cylinder-3d.prm", (3.5e-2, 0.15))):
        results = rows(scene, [])[0]["results"]
        for part, bound in zip(("path", "angle"), allowed):
            error = results[f"centre {part}"]["error"]
            print(f"{scene}: {part} {error:.1e}")
            expect(error < bound, f"{scene}: {part}")


def rod():
    for method in METHODS:
        summary, _ = rows("beyond/rotating-rod.prm",
                          [f"Boundaries/rod/Enforcement = {method}"])
        results = summary["results"]
        print(method, summary["counts"]["halved steps"], {
            name: f"{result['error']:.1e}" for name, result in results.items()})
        for name, result in results.items():
            expect(result["error"] < 2e-2, f"{method}: {name}")


if __name__ == "__main__":
    {"friction": lambda: friction(short), "friction-long": lambda: friction(long),
     "ball": ball, "rolling": rolling, "rod": rod}[sys.argv[1]]()
