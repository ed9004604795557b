"""A run that is killed at any moment and resumed ends as if nothing had been.

On as many ranks with the same digits, on other numbers of ranks to 1e-9. A
damaged checkpoint is recognised; a signal and a failure leave one.

Argument: none, or 'collapse' for ten kills each of a collapse of sand (2 minutes).
"""

import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import driver
from driver import expect
from ranks import HELD, VORTEX, end_of_run, largest_difference

HERE = Path(__file__).parent
BLOCK = [HERE / "ranks_falling_block.prm",
         "--set", "Output/Checkpoint every = 4",
         "--set", "Measurements/Names = path, tip, push, depth, E, newton",
         "--set", "Measurements/tip/Quantity = probe",
         "--set", "Measurements/tip/Point = 0.4, 0.4",
         "--set", "Measurements/push/Quantity = impulse",
         "--set", "Measurements/push/Boundary = plane",
         "--set", "Measurements/depth/Quantity = penetration",
         "--set", "Measurements/depth/Boundary = plane",
         "--set", "Measurements/E/Quantity = energy",
         "--set", "Measurements/newton/Quantity = newton"]
BAR = [HERE / "ranks_bar_3d.prm", "--set", "Time/Step = 0.1",
       "--set", "Bodies/bar/Body force = 0; t; -5 * t",
       "--set", "Output/Checkpoint every = 1"]
MULTIPLIERS = [*BAR, "--set", "Grid/Cells = tetrahedra", "--set",
               "Boundaries/clamp/Enforcement = lagrange multiplier"]
HELD_RUN = [*BAR, *(word for setting in [*HELD, "Grid/Reset = never"]
                    for word in ("--set", setting))]
VORTEX_RUN = [driver.SCENES / "beyond/generalised-vortex.prm", *(
    word for setting in [*VORTEX, "Output/Checkpoint every = 2"]
    for word in ("--set", setting))]
COLLAPSE = [driver.SCENES / "multiplier/4.5-granular-column-penalty.prm",
            "--set", "Time/End time = 0.2", "--set", "Output/Checkpoint every = 7"]
RANDOM = random.Random(5)


def command(arguments, ranks):
    words = [driver.PROGRAM, *map(str, arguments)]
    return words if ranks == 1 else [driver.MPIEXEC, "-np", str(ranks), *words]


def finish(arguments, ranks=1, status=0):
    process = subprocess.run(command(arguments, ranks), capture_output=True,
                             text=True, timeout=1000)
    expect(process.returncode == status, f"{arguments} on {ranks} ranks: "
           f"{process.returncode}\n{process.stdout}{process.stderr}")
    return process.stdout + process.stderr


def kill_after(seconds, arguments, ranks):
    """Whether the run was still at work and got killed."""
    process = subprocess.Popen(command(arguments, ranks),
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    time.sleep(seconds)
    victims = [process.pid]
    if ranks > 1:  # those that mpirun started; it ends after them
        found = subprocess.run(["ps", "-o", "pid=", "--ppid", str(process.pid)],
                               capture_output=True, text=True)
        victims = list(map(int, found.stdout.split()))
    for victim in victims:
        try:
            os.kill(victim, signal.SIGKILL)
        except ProcessLookupError:
            pass
    return process.wait() != 0


def files_of(folder):
    """Texts that must be the same, but for the date in them."""
    return {name: re.sub("<!--.*?-->", "", (folder / name).read_text(),
                         flags=re.S)
            for name in ("history.csv", "points.pvd", "boundary.pvd",
                         "grid.pvd") if (folder / name).exists()}


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def expect_same_end(title, one, other):
    """To 1e-9, but for the order of Newton's iteration, which is its way."""
    ends = [{name: value for name, value in
             end_of_run(folder, summary_of(folder)).items()
             if "newton" not in name} for folder in (one, other)]
    name, difference = largest_difference(*ends)
    print(f"{title}: {difference:.1e} of what is allowed ({name})")
    expect(difference <= 1, f"{name} differs")


def has_checkpoint(folder):
    return any((folder / "checkpoint").glob("*.state"))


def kill_and_resume(title, scene, ranks, n_kills, others, longest=0.7):
    """Between kills it runs for at most the part longest of the whole."""
    whole, killed = Path(f"{title}-{ranks}"), Path(f"{title}-{ranks}-killed")
    for left_over in (whole, killed):  # by an earlier call, of another version
        shutil.rmtree(left_over, ignore_errors=True)
    start = time.monotonic()
    finish([*scene, "--output", whole, "--overwrite"], ranks)
    duration = time.monotonic() - start

    # The first run has to get as far as a checkpoint, and not to its end.
    n, seconds = 0, 0.4 * duration
    while not has_checkpoint(killed) or not n:
        was_killed = kill_after(
            seconds, [*scene, "--output", killed, "--overwrite"], ranks)
        n += was_killed
        seconds *= 1.3 if was_killed else 0.6
    while n < n_kills and kill_after(
            RANDOM.uniform(0.3, 1) * longest * duration,
            ["--resume", killed], ranks):
        n += 1
    for other in others:
        copy = Path(f"{title}-{ranks}-to-{other}")
        shutil.rmtree(copy, ignore_errors=True)
        shutil.copytree(killed, copy)
        finish(["--resume", copy], other)
        expect_same_end(f"{title}, {ranks} to {other} ranks", whole, copy)
    finish(["--resume", killed], ranks)
    expect(files_of(whole) == files_of(killed), f"{title}: other digits")
    ends = [summary_of(folder) for folder in (whole, killed)]
    for part in ("results", "counts"):
        expect(ends[0][part] == ends[1][part], f"{title}: other {part}")
    print(f"{title}, {ranks} ranks, killed {n} times: same digits", flush=True)


def collapse():
    for ranks in (1, 2):
        kill_and_resume("collapse", COLLAPSE, ranks, 10, [3 - ranks, 3], 0.15)


def main():
    for ranks in (1, 2):
        kill_and_resume("block", BLOCK, ranks, 5, [3 - ranks, 3])
    kill_and_resume("bar", BAR, 1, 2, [2])
    kill_and_resume("held nodes, kept grid", HELD_RUN, 2, 1, [1, 3])
    kill_and_resume("multipliers", MULTIPLIERS, 1, 1, [3])
    kill_and_resume("vortex", VORTEX_RUN, 2, 1, [1, 3])


if __name__ == "__main__":
    collapse() if "collapse" in sys.argv[1:] else main()
