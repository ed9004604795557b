"""What the tests of the cantilever (papers P and L, section 4.1) share."""

from math import log2

from driver import expect, run_scene

SCENE = "penalty/4.1-cantilever"
KINDS = {"a": "", "b": "-rotated", "c": "-triangles", "d": "-distorted"}
TIP = -0.677458


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
