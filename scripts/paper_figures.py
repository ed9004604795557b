"""What the scripts that draw the papers' figures share: runs, axes, the command."""

import argparse
import csv
import json
import subprocess
import tempfile
from pathlib import Path

import matplotlib

from vtu import read_vtu

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

SCENES = Path(__file__).resolve().parent.parent / "prm"


class Runs:
    """Runs scenes into a folder, one run after the other."""

    def __init__(self, program, folder):
        self.program, self.folder = program, folder

    def results(self, scene, *settings, pictures=0):
        """Values of the results; the scene is relative to prm/."""
        words = [word for setting in
                 (f"Output/Pictures every = {pictures}",
                  "Output/Verbosity = silent", *settings)
                 for word in ("--set", setting)]
        subprocess.run([self.program, SCENES / scene, "--output", self.folder,
                        "--overwrite", *words], check=True)
        summary = json.loads((self.folder / "summary.json").read_text())
        return {name: result["value"]
                for name, result in summary["results"].items()}

    def history(self, *names):
        with open(self.folder / "history.csv") as file:
            rows = list(csv.DictReader(file))
        return [[float(row[name]) for row in rows] for name in names]

    def picture(self, kind, number):
        files = sorted((self.folder / "vtu").glob(f"{kind}-*.vtu"))
        return read_vtu(files[number])


def panels(n, width=3.3, height=3.):
    figure, axes = pyplot.subplots(1, n, figsize=(width * n, height),
                                   layout="constrained", squeeze=False)
    return figure, axes[0]


def draw(figures, description):
    """The command: draws one of the figures, functions of Runs by their names."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("program")
    parser.add_argument("figure", choices=figures)
    parser.add_argument("picture", type=Path, help="file to write, .png")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        figure = figures[options.figure](Runs(options.program, Path(folder)))
        figure.savefig(options.picture, dpi=75)
