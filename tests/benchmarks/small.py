"""Benchmarks still work: their programs run at small sizes, whatever the time, their scenes pass --check.

The argument is the folder of the programs.
"""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
from pathlib import Path

from driver import expect, run

HERE = Path(__file__).parent
ARGUMENTS = {"assembly": ["--small"], "straightforward": ["--small"], "linear_solvers": ["2", "10"]}


def load(name):
    loader = importlib.machinery.SourceFileLoader(name, str(HERE / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


def scenes():
    """Scene and overrides of all that the scripts run."""
    runs, enforcements, instructions = map(load, ("run", "enforcements", "instructions"))
    yield from (scene() for scene in runs.SCENES.values())
    yield instructions.block(160, 100, 4)
    yield runs.QUICKSTART, instructions.boundary_entries(110)
    for scene, entries in (enforcements.plane(28), enforcements.solid(6, 2)):
        for method in enforcements.METHODS:
            yield os.path.join(enforcements.SCENES, scene), entries + ["Boundaries/clamp/Enforcement = " + method]


def main():
    expect(set(ARGUMENTS) == {path.stem for path in HERE.glob("*.cc")}, "a benchmark is not run here")
    for name, arguments in ARGUMENTS.items():
        done = subprocess.run([os.path.join(sys.argv[1], name), *arguments], text=True, capture_output=True)
        expect(done.returncode == 0, name + ":\n" + done.stdout + done.stderr)
    Path("empty.prm").touch()
    for scene, entries in scenes():
        settings = [word for entry in entries for word in ("--set", entry)]
        done = run(["--check", scene or "empty.prm", "--output", "none", *settings])
        expect(done.returncode == 0, "%s %s:\n%s" % (scene, entries, done.stderr))


if __name__ == "__main__":
    main()
