"""What the tests of the cantilever (papers P and L, section 4.1) share."""

import csv
from math import log2
from pathlib import Path

from driver import expect, run_scene

SCENE = "penalty/4.1-cantilever"
KINDS = {"a": "", "b": "-rotated", "c": "-triangles", "d": "-distorted"}
TIP = -0.677458
WEIGHT = 78480.


def size(kind, n):
    """Overrides for cells of size h = 2^-n / 2 m, halfway cut on grid kind a."""
    h = 0.5**(n + 1)
    settings = [f"Grid/Refinements = {n}",
                f"Bodies/beam/Mesh/Refinements = {n}"]
    return settings if kind == "b" else [
        *settings, f"Grid/Shift = {-h / 2}, {-1 - h / 2}"]


def clamp(method, factor, unit="E/h"):
    return [f"Boundaries/clamp/Enforcement = {method}",
            f"Boundaries/clamp/Penalty unit = {unit}",
            f"Boundaries/clamp/Penalty factor = {factor:.17g}"]


def results(scene, settings):
    """Values and errors of a run, whose steps all succeeded at once."""
    summary = run_scene(scene + ".prm", "run",
                        ["Output/Pictures every = 0", *settings])
    expect(summary["counts"]["halved steps"] == 0, f"{scene} {settings}: halved")
    return summary["results"]


def tip(scene, settings):
    return results(scene, settings)["tip u_y"]["value"]


def rate(coarse, fine):
    return log2(coarse / fine)


def balance(name, reactions):
    """The last state's imbalance of forces and moments, relative."""
    with Path("run/history.csv").open() as history:
        last = list(csv.DictReader(history))[-1]
    force = abs(reactions["support F_y"]["value"] / WEIGHT - 1)
    moment = abs(reactions["support M_z"]["value"] /
                 (9.81 * float(last["mass"]) * float(last["centre x"])) - 1)
    print(f"{name}: force {force:.1e}, moment {moment:.1e}", flush=True)
    expect(force < 1e-8 and moment < 1e-8, f"{name} is out of balance")
