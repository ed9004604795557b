"""What the tests in Python share: runs the program as a user would."""

import json
import os
import subprocess
import sys
from pathlib import Path

PROGRAM = os.environ["IMPOINT_PROGRAM"]
SCENES = Path(os.environ["IMPOINT_SOURCE"]) / "prm"
MPIEXEC = os.environ["IMPOINT_MPIEXEC"]


def run(arguments, ranks=1):
    """The finished process of "impoint ARGUMENTS", its output as text."""
    command = [PROGRAM, *map(str, arguments)]
    if ranks > 1:
        command = [MPIEXEC, "-np", str(ranks), *command]
    return subprocess.run(command, capture_output=True, text=True)


def run_scene(scene, folder, settings=(), ranks=1):
    """Runs a scene that has to succeed and gives its summary.json.

    scene is relative to prm/ or absolute, folder is made anew in the working
    directory, settings are overrides "Section/Entry = value".
    """
    overrides = [word for setting in settings for word in ("--set", setting)]
    process = run([SCENES / scene, "--output", Path(folder).resolve(),
                   "--overwrite", *overrides], ranks)
    expect(process.returncode == 0,
           f"{scene} {settings} ended with {process.returncode}:\n"
           f"{process.stdout}\n{process.stderr}")
    return json.loads((Path(folder) / "summary.json").read_text())


def expect(condition, message):
    """Ends the test as failed unless condition holds."""
    if not condition:
        sys.exit("FAILED: " + message)
