"""Paper I, section 5.4: a slender cantilever at 0, 45 and 90 degrees to the grid."""

import csv

from driver import expect, run_scene

SCENE = "implicit-boundary/5.4-slender-cantilever.prm"
# Cells over the 160 mm of the grid, and points a direction.
GRIDS = ((40, 5), (80, 5))


def curve(angle, cells, points):
    """Displacement of the tip over the 20 steps of the load."""
    summary = run_scene(SCENE, "run", [
        f"Grid/Rotation = {angle}", "Output/Pictures every = 0",
        f"Grid/Arguments = {cells}, {cells} : -80, -80 : 80, 80",
        f"Bodies/beam/Points per direction = {points}"])
    force = summary["results"]["reaction F_y"]["value"]
    expect(abs(force / 400 - 1) < 1e-9, f"{force} N carry a weight of 400 N")
    with open("run/history.csv") as file:
        return [float(row["tip u_y"]) for row in csv.DictReader(file)]


def difference(some, others):
    return max(abs(a - b) for a, b in zip(some, others)) / abs(others[-1])


def main():
    inclined = []
    for cells, points in GRIDS:
        lying, tilted, upright = (curve(angle, cells, points)
                                  for angle in (0, 45, 90))
        expect(len(lying) == 20, "steps were halved")
        aligned = difference(upright, lying)
        inclined.append(difference(tilted, lying))
        print(f"cells of {160 / cells} mm: tip {lying[-1]:.3f} mm, 90 degrees "
              f"differ by {aligned:.1e}, 45 degrees by {inclined[-1]:.4f}")
        expect(aligned < 1e-3, "the curves at 0 and 90 degrees")
    # 0.063 and 0.037 while each particle held its place, which locks at 45 degrees.
    expect(max(inclined) < 0.005, "45 degrees lock")


main()
