"""Figures of tests/benchmarks/accuracy: error over seconds and over unknowns, from its rows."""
import csv

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

COLOURS = {"linear": "tab:blue", "quadratic spline": "tab:orange", "cubic spline": "tab:green", "quadratic": "tab:red"}
MARKERS = {"conforming": "s", "penalty": "^", "projected penalty": "o", "lagrange multiplier": "D",
           "implicit boundary": "v", "nitsche": "*", "none": "."}


def style(row):
    if row["code"] == "Kratos":
        return {"color": "black", "marker": MARKERS.get(row["enforcement"], "D"), "linestyle": "-"}
    line = "-" if row["points a cell"].startswith("clipped") else ":"
    if row["reset"] == "never":
        line = "--"
    return {"color": COLOURS[row["basis"]], "marker": MARKERS[row["enforcement"]], "linestyle": line}


def legend(rows):
    line = lambda label, **more: Line2D([], [], label=label, **more)
    entries = [line(basis, color=colour) for basis, colour in COLOURS.items() if any(r["basis"] == basis for r in rows)]
    if any(row["code"] == "Kratos" for row in rows):
        entries.append(line("Kratos", color="black"))
    grey = {"color": "grey"}
    for label, dashes in (("clipped points", "-"), ("other points", ":"), ("never reset", "--")):
        if any(style(row)["linestyle"] == dashes for row in rows):
            entries.append(line(label, linestyle=dashes, **grey))
    for name, marker in MARKERS.items():
        if name != "none" and any(row["enforcement"] == name for row in rows):
            entries.append(line(name, linestyle="", marker=marker, **grey))
    return entries


def draw(path, title, picture):
    """Kind a of the grid only: the others are in the rows."""
    with open(path) as file:
        rows = [row for row in csv.DictReader(file) if row["kind"] == "a" and row["error"]]
    figure, axes = pyplot.subplots(1, 2, figsize=(8.4, 4.6), sharey=True)
    for axis, column in zip(axes, ("seconds", "unknowns")):
        for key in dict.fromkeys((r["code"], r["basis"], r["points a cell"], r["enforcement"], r["reset"]) for r in rows):
            series = [r for r in rows if (r["code"], r["basis"], r["points a cell"], r["enforcement"], r["reset"]) == key]
            points = [(float(r[column]), float(r["error"])) for r in series if r[column] and float(r["error"]) > 0]
            if points:
                axis.loglog(*zip(*points), markersize=4, linewidth=0.9, **style(series[0]))
        axis.set(xlabel={"seconds": "solution loop [s]", "unknowns": "unknowns"}[column])
        axis.grid(alpha=0.3)
    axes[0].set(ylabel="relative error")
    figure.suptitle(title)
    figure.legend(handles=legend(rows), fontsize="x-small", loc="lower center", ncols=5)
    figure.tight_layout(rect=(0, 0.12, 1, 1))
    figure.savefig(picture, dpi=62)
    pyplot.close(figure)
