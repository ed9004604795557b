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
                          ("altered", lambda old: old[:5000] +
                           bytes([old[5000] ^ 255]) + old[5001:])):
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

    for entry, old, new, says in (
            ("Quantity", "impulse", "reaction", "does not fit the scene"),
            ("Shift", "-1.03, -8.04", "-1.04, -8.04",
             "'Shift' in section 'Grid'.*whose run had '-1.03, -8.04'")):
        folder = copied(whole, "altered scene")
        scene = (folder / "parameters.prm").read_text()
        altered = re.sub(f"(set {entry} *= *){old}", rf"\g<1>{new}", scene)
        expect(altered != scene, f"no {entry} in {scene}")
        (folder / "parameters.prm").write_text(altered)
        expect_error(folder, says)
    print("no checkpoint, or one of another scene: said so")


def expect_error(folder, says, ranks=1):
    said = finish(["--resume", folder], ranks, status=1)
    lines = said[said.index("Error: "):].splitlines()
    expect(said.count("Error: ") == 1 and lines[1].startswith("  in ") and
           lines[2].startswith("  ") and
           re.search(says, " ".join(sorted(lines[:3]))), said)


def check_format(whole):
    """That of the newest file counts: an older one would lose steps."""
    for old in ("1", "10"):
        folder = copied(whole, "other format")
        newest = states(folder)[-1]
        stored = newest.read_bytes().replace(b"format 3\n", f"format {old}\n".encode(), 1)
        newest.write_bytes(stored)
        expect_error(folder, f"has format {old}, this version of impoint .* format 3",
                     ranks=2 if old == "1" else 1)
    print("a checkpoint of another format: said so")


def check_clock(whole):
    """Checkpoints by the clock leave the digits of the running simulation, and
    what goes on from them ends with the same."""
    files = []
    for minutes in ("1e-9", "1000"):
        folder = Path(f"minutes-{minutes}")
        finish([*BLOCK, "--output", folder, "--overwrite",
                "--set", "Output/Checkpoint every = 0",
                "--set", f"Output/Checkpoint minutes = {minutes}"])
        files.append(files_of(folder))
        expect(bool(states(folder)) == (minutes == "1e-9"), f"{states(folder)}")
    expect(files[0] == files[1], "checkpoints by the clock alter digits")
    folder = Path("minutes-1e-9")
    said = finish(["--resume", folder])
    expect("goes on after step 29" in said and files_of(folder) == files[0],
           "other digits than not stopped:\n" + said)
    print("checkpoints by the clock: the same digits")


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
    check_format(whole)
    check_clock(whole)
    check_signal(whole)
    check_failure()


main()
