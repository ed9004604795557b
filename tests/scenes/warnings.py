"""What the program does not refuse but warns of."""

import csv
from pathlib import Path

import driver
from driver import expect

BAR = Path(__file__).with_name("bad_inputs.prm")
BAR_3D = Path(__file__).with_name("ranks_bar_3d.prm")
BLOCK = Path(__file__).with_name("ranks_falling_block.prm")
LOAD = ["Boundaries/Names = clamp, load",
        "Boundaries/load/Constraint = traction",
        "Boundaries/load/Traction = 0; -1"]


def said_by(scene, settings, ranks=1, check=True):
    arguments = [word for setting in settings for word in ("--set", setting)]
    arguments += (["--check", "--output", "none"] if check else
                  ["--output", "out", "--overwrite"])
    process = driver.run([scene, *arguments], ranks)
    expect(process.returncode == 0, f"{settings}: {process.stderr}")
    return " ".join((process.stdout + process.stderr).split())


def expect_warning(title, text, scene, settings, **keywords):
    for ranks in (1, 2):
        said = said_by(scene, settings, ranks, **keywords)
        expect(text in said, f"{title}, {ranks} ranks: '{text}' not in {said}")
        expect(said.count("Warning") == 1, f"{title}: {said}")
    print(f"{title}: warned of")


def check_lost_probe():
    """It is 1.3 h off the block, within a cell of the block's cells at times."""
    lost = "probe 'beside' is further than one cell from all material at t ="
    expect_warning("a probe that loses its material", lost, BLOCK,
                   ["Measurements/Names = path, beside",
                    "Measurements/beside/Quantity = probe",
                    "Measurements/beside/Point = -0.9, 0.5",
                    "Time/End time = 0.3", "Output/Pictures every = 0"],
                   check=False)
    with open("out/history.csv") as file:
        values = [row["beside u_x"] for row in csv.DictReader(file)]
    n_known = len([value for value in values if value != "nan"])
    expect(0 < n_known < len(values) == 15 and
           values[n_known:] == ["nan"] * (15 - n_known), str(values))
    summary = driver.json.loads(Path("out/summary.json").read_text())
    expect(summary["results"]["beside u_x"]["value"] is None and
           lost in summary["warnings"][0], str(summary))


def check_reference():
    """Results of a run that is done are not lost for it."""
    expect_warning("a reference without a value",
                   "'tip u_y' has no reference", BAR,
                   ["Measurements/tip/Reference = 0; 1 / (t - 1)",
                    "Output/Verbosity = results"], check=False)
    summary = driver.json.loads(Path("out/summary.json").read_text())
    expect("reference" in summary["results"]["tip u_x"] and
           "reference" not in summary["results"]["tip u_y"] and
           len(summary["warnings"]) == 1, str(summary))


def check_round_off():
    """Forces that a stiff body's motion leaves no digits of."""
    scene = Path(__file__).with_name("round_off.prm")
    for model in ("linear elastic", "Hencky"):
        for stiff in (1e9, 1e15):
            settings = ["Output/Verbosity = normal"]
            for body in ("soft", "stiff"):
                settings.append(f"Bodies/{body}/Material/Model = {model}")
            settings.append(f"Bodies/stiff/Material/Young's modulus = {stiff}")
            if stiff > 1e9:
                expect_warning(f"round-off, {model}", "leaves forces out of balance",
                               scene, settings, check=False)
            else:
                said = said_by(scene, settings, check=False)
                expect("Warning" not in said, said)
            results = driver.json.loads(Path("out/summary.json").read_text())["results"]
            pull, hold = (results[f"{name} F_x"]["value"] for name in ("pull", "hold"))
            with open("out/history.csv") as file:
                residual = float(list(csv.DictReader(file))[-1]["residual"])
            expect(abs(pull + hold) <= 2 * residual * abs(pull) + 1e-9,
                   f"{model}: {pull} and {hold}, but a residual of {residual}")
            expect((residual > 1e-3) == (stiff > 1e9), f"{residual}")


def main():
    check_round_off()
    for scene in (BAR, BAR_3D):
        expect("Warning" not in said_by(scene, []), f"{scene} is all right")
    expect_warning("a line that ends outside of the grid",
                   "33 % of boundary 'clamp' lie outside of the grid", BAR,
                   ["Boundaries/clamp/Polyline = 0 0.625; 0 -0.5"])
    expect_warning("normals of a fixed wall",
                   "point into the material. Forces don't depend", BAR,
                   ["Boundaries/clamp/Polyline = 0 0; 0 0.5"])
    expect_warning("fewer particles than cut cells",
                   "'clamp' has 4 particles but cuts 9 cells of the grid",
                   BAR_3D, ["Boundaries/clamp/Rule = equal"])
    few = ["Grid/Basis = cubic spline", "Boundaries/clamp/Particles per segment = 2"]
    expect_warning("few particles for a cubic spline",
                   "'Particles per segment = 2', few for a basis 'cubic spline'. Set 4",
                   BAR, few)
    expect("Warning" not in said_by(BAR, few[:1]), "the default serves")
    expect_warning("few points for a quadratic basis",
                   "23 of 23 cells that bodies fill have fewer points than a "
                   "'quadratic' basis needs (5)", BAR,
                   ["Grid/Basis = quadratic",
                    "Bodies/bar/Mesh/Arguments = 8, 2 : 0, 0 : 2, 0.5"])
    lost = "50 % of boundary 'load' have no material in their cells"
    expect_warning("a load beside the material", lost, BAR,
                   [*LOAD, "Grid/Arguments = 14, 3 : 0, 0 : 3.5, 0.75",
                    "Boundaries/load/Rule = cut",
                    "Boundaries/load/Polyline = 2 0; 2 0.5 | 3 0; 3 0.5"],
                   check=False)

    expect_warning("consistent masses on a grid that is reset",
                   "'Projection = consistent' on a grid that is reset", BLOCK,
                   ["Time/Projection = consistent"])
    check_lost_probe()
    check_reference()

    said = said_by(BAR, ["Time/Step = 0.25", "Linear solver/Kind = iterative",
                         "Bodies/bar/Body force = 0; -0.01 * t * t",
                         "Bodies/bar/Material/Model = neo-Hookean"],
                   check=False)
    expect("Warning" not in said, said)
    with open("out/history.csv") as file:
        rows = list(csv.DictReader(file))
    counts = driver.json.loads(Path("out/summary.json").read_text())["counts"]
    total = sum(int(row["linear iterations"]) for row in rows)
    expect(len(rows) == 4 and total == counts["linear iterations"] > 0,
           f"{total} iterations in the rows, {counts['linear iterations']}")
    print("linear iterations in history.csv are those of the step: yes")


main()
