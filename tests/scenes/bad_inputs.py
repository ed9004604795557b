"""Each mistake gives one message with its three parts, exit status 1, no files.

Also: a run that cannot go on ends with status 2 and keeps what it has, and two
ranks give one message, too.
"""

import json
import re
import subprocess
from pathlib import Path

import driver
from bad_inputs_cases import COMMANDS, SCENE, SCENES
from driver import expect

GOOD = Path(__file__).with_name("bad_inputs.prm").read_text()
RESULTS = Path("results")


def impoint(arguments, ranks=1):
    """As driver.run(), but a program that hangs is a failure."""
    command = [driver.PROGRAM, *arguments]
    if ranks > 1:
        command = [driver.MPIEXEC, "-np", str(ranks), *command]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def remove_results():
    subprocess.run(["rm", "-rf", str(RESULTS)], check=True)


def complaint(arguments, title, ranks=1):
    """The lines of the one message that these arguments must give."""
    files = sorted(Path().rglob("*"))
    process = impoint(arguments, ranks)
    report = f"{title}: {process.returncode}\n{process.stdout}{process.stderr}"
    expect(process.returncode == 1, "status is not 1 for " + report)
    expect(process.stdout.count("\n") <= (0 if ranks == 1 else 12),
           "more than the message is printed for " + report)
    lines = process.stderr.splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("Error: ")]
    expect(len(starts) == 1, "not one message for " + report)
    lines = lines[starts[0]:] if ranks > 1 else lines
    expect(len(lines) == 3 or ranks > 1, "message isn't 3 lines for " + report)
    expect(lines[1].startswith("  in ") and lines[2].startswith("  "),
           "message lacks place or advice for " + report)
    expect("internal error" not in report, "internal error for " + report)
    expect(sorted(Path().rglob("*")) == files, "files changed by " + report)
    return lines[:3]


def check_scene(old, new, says, at=None):
    expect(GOOD.count(old) == 1 or old.startswith("set Names"),
           f"'{old}' is no unique text")
    text = GOOD.replace(old, new, 1)
    Path(SCENE).write_text(text)
    title = f"'{old}' -> '{new}'"
    message = complaint([SCENE], title)
    expect(re.search(says, " ".join(message), re.IGNORECASE),
           f"{title}: '{says}' is not in\n" + "\n".join(message))
    place = new.split("\n")[0] if at is None else at
    if place:
        expect(place in text, f"'{place}' is not in the scene")
        line = text[:text.index(place)].count("\n") + 1
        expect(message[1].endswith(f"{SCENE}:{line}"),
               f"{title}: place is not line {line}:\n" + "\n".join(message))


def check_command(arguments, says):
    message = complaint(arguments, str(arguments))
    expect(re.search(says, " ".join(message)),
           f"{arguments}: '{says}' is not in\n" + "\n".join(message))


def check_two_ranks():
    for setting in ("Newton/Tolerance = 1", "Bodies/bar/Mesh/Shift = 9, 0",
                    "Boundaries/clamp/Polyline = 1 0; 1 0",
                    "Bodies/bar/Initial stress = log(1.5 - x); 0; 0",
                    "Measurements/tip/Point = 2, 7"):
        complaint([SCENE, "--set", setting], setting, ranks=2)
    print("on two ranks, one message: yes")


def check_failing_run(ranks):
    """A load a million times the scene's: the bar leaves the grid."""
    remove_results()
    process = impoint([SCENE, "--set", "Bodies/bar/Material/Model = Hencky",
                       "--set", "Bodies/bar/Body force = 0; -9810 * t",
                       "--set", "Time/Step = 0.25",
                       "--set", "Output/Pictures every = 1000"], ranks)
    expect(re.search("material point .* leaves the grid at", process.stderr) and
           ".." not in process.stderr, process.stderr)
    expect(process.returncode == 2, f"status is not 2:\n{process.stdout}"
           f"{process.stderr}")
    messages = [line for line in process.stderr.splitlines()
                if line.startswith("Error: ")]
    expect(len(messages) == 1 and
           re.search(r"step \d+ at time \S+ s.*: ", messages[0]),
           "no step and reason in " + process.stderr)
    summary = json.loads((RESULTS / "summary.json").read_text())
    expect(summary["status"] == "failed", "status isn't failed")
    expect(summary["message"] in messages[0], summary["message"])
    rows = (RESULTS / "history.csv").read_text().splitlines()
    expect(len(rows) == summary["counts"]["steps"] + 1, "history lacks rows")
    pictures = sorted((RESULTS / "vtu").glob("points-*.vtu"))
    expect(summary["counts"]["steps"] > 0 and len(pictures) == 2,
           "the first and the last good state are not pictured")
    print(f"run that cannot go on, {ranks} ranks: status 2, state kept: yes")


def check_first_step_fails(ranks):
    """A load that is there at once: halving the step cannot help."""
    remove_results()
    process = impoint([SCENE, "--set", "Bodies/bar/Material/Model = Hencky",
                       "--set", "Bodies/bar/Body force = 0; -9810"], ranks)
    said = process.stdout + process.stderr
    expect(process.returncode == 2 and "no load depends on t" in said, said)
    summary = json.loads((RESULTS / "summary.json").read_text())
    expect(summary["counts"]["halved steps"] == 0, "a step was tried again")
    expect(summary["results"] == {} and "u_x" not in process.stdout,
           "results though no step was done")
    rows = (RESULTS / "history.csv").read_text().splitlines()
    expect(len(rows) == 1 and rows[0].startswith("step,time"), str(rows))
    print(f"constant load, {ranks} ranks: not halved, no results: yes")


def check_begin_fails(ranks):
    """The first picture has no place: that ends the run as in any step."""
    Path("results").mkdir(exist_ok=True)
    Path("results/vtu").touch()
    process = impoint([SCENE, "--set", "Output/Pictures every = 1"], ranks)
    said = [line for line in process.stderr.splitlines() if "Error: " in line]
    expect(process.returncode == 2 and len(said) == 1 and
           re.search("vtu/points.* cannot be written: Not a directory", said[0]),
           process.stdout + process.stderr)
    summary = json.loads((RESULTS / "summary.json").read_text())
    expect(summary["status"] == "failed" and
           summary["message"] in said[0], summary)
    print(f"no place for pictures, {ranks} ranks: status 2, summary: yes")


def check_newton_fails():
    """No step is small enough for an iteration that may not iterate."""
    remove_results()
    process = impoint([SCENE, "--set", "Bodies/bar/Material/Model = Hencky",
                       "--set", "Bodies/bar/Body force = 0; -9.81 * t",
                       "--set", "Newton/Maximum iterations = 1"])
    expect(process.returncode == 2 and
           "halved down to the smallest" in process.stderr, process.stderr)
    print("run whose steps all fail: says that they were halved: yes")


VALUE = "0; if(x > 1.2, 1e-3 * (sqrt(0.8 - t) - sqrt(0.8)), 0)"
FAILING_EXPRESSIONS = {
    "load": ["Bodies/bar/Body force = 0; -1e-3 * sqrt(1.8 - t * x)"],
    "wall": ["Boundaries/clamp/Polyline = 0 0; 2 0", f"Boundaries/clamp/Value = {VALUE}"],
    "conforming wall": ["Boundaries/Names = clamp, base",
                        "Boundaries/base/Kind = conforming",
                        "Boundaries/base/Boundary id = 2",
                        f"Boundaries/base/Value = {VALUE}"]}


def check_expressions_fail(ranks):
    """At the end they have no value, on the rank with the tip only."""
    for title, settings in FAILING_EXPRESSIONS.items():
        remove_results()
        process = impoint([SCENE, *(word for setting in ["Time/Step = 0.25", *settings]
                                    for word in ("--set", setting))], ranks)
        expect(process.returncode == 2 and
               process.stderr.count("has no finite value at") == 1, process.stderr)
        summary = json.loads((RESULTS / "summary.json").read_text())
        expect(summary["counts"]["steps"] == 3 and "tip u_y" in summary["results"],
               "the steps before are lost")
        print(f"{title} without a value, {ranks} ranks: status 2, state kept: yes")


def check_leaving_grid(ranks):
    """A bar that flies: its first point that leaves is named, at once."""
    remove_results()
    process = impoint([SCENE, "--set", "Time/Kind = dynamic",
                       "--set", "Bodies/bar/Initial velocity = 2; 0",
                       "--set", "Boundaries/clamp/Active until = 1e-3",
                       "--set", "Time/Step = 0.05"], ranks)
    said = re.search(r"step (\d+) at time (\S+) s.*: material point \d+ leaves "
                     r"the grid at \((\S+) \S+\)", process.stderr)
    expect(process.returncode == 2 and said, process.stdout + process.stderr)
    counts = json.loads((RESULTS / "summary.json").read_text())["counts"]
    expect(counts["halved steps"] == 0 and int(said[1]) == counts["steps"] + 1
           and 2.375 < float(said[3]) < 2.5, process.stderr)
    print(f"point that leaves the grid, {ranks} ranks: named at once: yes")


def main():
    remove_results()
    Path("unreadable.msh").write_text("no mesh\n")
    Path("number#1").mkdir(exist_ok=True)
    Path("number#1/scene.prm").write_text(GOOD)
    Path("full").mkdir(exist_ok=True)
    Path("full/summary.json").write_text("{}\n")
    Path("kept/history.csv/file").mkdir(parents=True, exist_ok=True)
    Path("loop.prm").unlink(missing_ok=True)
    Path("loop.prm").symlink_to("loop.prm")
    Path("rerun").mkdir(exist_ok=True)
    Path("rerun/parameters.prm").write_text(
        GOOD.replace("Folder = results", "Folder = ."))
    for case in SCENES:
        check_scene(*case)
    print(f"{len(SCENES)} wrong scenes: one message each, nothing written")
    Path(SCENE).write_text(GOOD)
    for case in COMMANDS:
        check_command(*case)
    print(f"{len(COMMANDS)} wrong commands: one message each, nothing written")
    check_two_ranks()
    check_newton_fails()
    for ranks in (1, 2):
        remove_results()
        check_begin_fails(ranks)
        check_failing_run(ranks)
        check_first_step_fails(ranks)
        check_expressions_fail(ranks)
        check_leaving_grid(ranks)


main()
