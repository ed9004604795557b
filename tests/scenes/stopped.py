"""What stops a run leaves a checkpoint: a signal, also through mpirun, a failure. A damaged file is
recognised, and the one before it serves."""

import csv
import os
import re
import shutil
import signal
import subprocess
from pathlib import Path

from driver import expect
from resume import (BLOCK, command, expect_same_end, files_of, finish,
                    summary_of)

FAILING = Path(__file__).with_name("bad_inputs.prm")


def states(folder):
    return sorted((folder / "checkpoint").glob("*.state"))


def copied(folder, name):
    shutil.rmtree(name, ignore_errors=True)
    return Path(shutil.copytree(folder, name))


def check_damage(whole):
    files = states(whole)
    expect([file.name for file in files] ==
           ["step-000000028.state", "step-000000032.state"],
           f"not the last two checkpoints: {files}")
    for title, damage in (("cut", lambda old: old[:-1]),
                          ("altered", lambda old: old[:5000] + b"?" +
                           old[5001:])):
        folder = copied(whole, title)
        newest = states(folder)[-1]
        newest.write_bytes(damage(newest.read_bytes()))
        said = " ".join(finish(["--resume", folder]).split())
        expect(newest.name + "' is damaged: going on from an older" in said,
               f"no warning of a damaged file in {said}")
        expect(files_of(folder) == files_of(whole), "other digits")
        for file in states(folder):
            file.write_bytes(damage(file.read_bytes()))
        said = finish(["--resume", folder], ranks=2, status=1)
        expect(said.count("Error: the checkpoint") == 1 and
               "is damaged" in said, said)
    print("damaged checkpoints are recognised: yes")

    folder = copied(whole, "empty")
    shutil.rmtree(folder / "checkpoint")
    said = finish(["--resume", folder], status=1)
    expect("holds no checkpoint" in said, said)

    folder = copied(whole, "altered scene")
    scene = (folder / "parameters.prm").read_text()
    scene = re.sub(r"(set Quantity *= *)impulse", r"\1reaction", scene)
    (folder / "parameters.prm").write_text(scene)
    said = finish(["--resume", folder], status=1)
    expect("does not fit the scene" in said, said)
    print("no checkpoint, or one of another scene: said so")


def expect_pictures(folder, number):
    """The first state and the last one."""
    times = re.findall('timestep="([^"]+)"',
                       (folder / "points.pvd").read_text())
    with open(folder / "history.csv") as file:
        last = list(csv.DictReader(file))[-1]["time"]
    expect(len(times) == number and float(times[0]) == 0 and
           abs(float(times[-1]) / float(last) - 1) < 1e-5,
           f"pictures at {times} s, the last step at {last} s")


def check_signal(whole):
    for number, ranks in ((signal.SIGTERM, 1), (signal.SIGINT, 1),
                          (signal.SIGHUP, 1), (signal.SIGINT, 2)):
        folder = Path(f"signal-{number}-{ranks}")
        process = subprocess.Popen(
            command([*BLOCK, "--output", folder, "--overwrite",
                     "--set", "Output/Checkpoint every = 0",
                     "--set", "Measurements/path/Reference = 1; 0",
                     "--set", "Output/Pictures every = 1000"], ranks),
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            env={**os.environ, "OMPI_MCA_odls_base_sigkill_timeout": "3"})
        for line in process.stdout:  # until the first step is done
            if re.match(r" +1 ", line):
                break
        process.send_signal(number)
        said = process.communicate()[0]
        expect((process.returncode == 2 or ranks > 1) and
               "\nstopped: " in said and "--resume" in said and
               "told to stop by a signal" in said, said)
        summary = summary_of(folder)
        steps = summary["counts"]["steps"]
        expect(0 < steps < 35 and len(states(folder)) == 1 and
               summary["status"] == "failed" and
               not any("reference" in result
                       for result in summary["results"].values()),
               f"{steps} steps, {states(folder)}, {summary}")
        expect_pictures(folder, 2)
        finish(["--resume", folder], ranks)
        expect_same_end(f"resumed after signal {number}, {ranks} ranks", whole,
                        folder)
        expect_pictures(folder, 2)


def check_failure():
    folder = Path("failure")
    message = {}
    finish([FAILING, "--output", folder, "--overwrite",
            "--set", "Bodies/bar/Material/Model = Hencky",
            "--set", "Bodies/bar/Body force = 0; -9810 * t",
            "--set", "Time/Step = 0.25"], status=2)
    message["first"] = summary_of(folder)["message"]
    expect(len(states(folder)) == 1, "no checkpoint of the last good state")
    finish(["--resume", folder], ranks=2, status=2)
    message["again"] = summary_of(folder)["message"]
    expect(message["first"].split(":")[0] == message["again"].split(":")[0],
           f"{message}")
    print("a run that fails leaves its last good state: yes")


def main():
    whole = Path("whole")
    finish([*BLOCK, "--output", whole, "--overwrite"])
    check_damage(whole)
    check_signal(whole)
    check_failure()


main()
