"""A column under its weight: order 1 before points cross cells, none after."""

from math import log, log2

from driver import expect, run_scene

HEIGHT = 50.
CONFORMING = "beyond/column-compaction.prm"
PENALTY = "beyond/column-compaction-penalty.prm"


def run(scene, cells, points, part_of_gravity=1.):
    """Results on cells of HEIGHT / cells."""
    h = HEIGHT / cells
    body = f"1, {cells} : 0, 0 : {h}, {HEIGHT}"
    cut = f"1, {cells + 1} : 0, {-h / 2} : {h}, {HEIGHT + h / 2}"
    settings = ["Output/Pictures every = 0",
                f"Grid/Arguments = {cut if scene == PENALTY else body}",
                f"Bodies/column/Mesh/Arguments = {body}",
                f"Bodies/column/Points per direction = {points}",
                f"Bodies/column/Body force = 0; {-10 * part_of_gravity}*t",
                f"Measurements/stress/Exact = {-800 * part_of_gravity}*t*(50 - y)",
                f"Measurements/stress/Scale = {40e3 * part_of_gravity}",
                f"Measurements/support/Reference = 0; {40e3 * part_of_gravity * h}*t"]
    if scene == PENALTY:
        settings.append(f"Boundaries/base/Polyline = 0 0; {h} 0")
    results = run_scene(scene, "run", settings)["results"]
    expect(results["support F_y"]["error"] < 1e-9, f"weight, {scene} {cells} {points}")
    return results


def stress_error(*arguments):
    return run(*arguments)["stress"]["value"]


def exact_sinking():
    """Of the top: ln(lambda)/lambda = -s, s from 0 to 4 over the height."""
    # ds = -(1 - ln lambda)/lambda^2 dlambda, by the midpoint rule in lambda.
    low, high = 1e-3, 1.
    for _ in range(100):
        middle = (low + high) / 2
        low, high = (middle, high) if -log(middle) / middle > 4 else (low, middle)
    n = 100000
    width = (1 - low) / n
    sum_of = sum((1 - at) * (1 - log(at)) / at**2
                 for at in (low + (i + 0.5) * width for i in range(n)))
    return -HEIGHT * sum_of * width / 4


def main():
    # A ten-thousandth of gravity: 2 x 2 points on a base that the grid cuts are
    # of order 1, too, but 3 x 3 lie on the cells' sides there.
    for scene, points in ((CONFORMING, 2), (CONFORMING, 3), (PENALTY, 2), (PENALTY, 3)):
        coarse, fine = (stress_error(scene, cells, points, 1e-4) for cells in (32, 64))
        rate = log2(coarse / fine)
        print(f"{scene}, {points} x {points}, no crossing: rate {rate:.3f}")
        expect(rate > 0.95, "rate")
    # Constant in a cell, and the points h/(2 sqrt 3) off its centre.
    error = stress_error(CONFORMING, 64, 2, 1e-4)
    expect(abs(error / (0.5 / 3**0.5 / 64) - 1) < 1e-3, "error of a constant stress")

    # Of the known values 10 %: what crossing does changes with round-off.
    known = {2: (0.0888, 0.1088, 0.0901, 0.0895), 3: (0.0450, 0.0653, 0.0680, 0.0782)}
    sinking = exact_sinking()
    print(f"exact sinking of the top: {sinking:.4f} m")
    for points, values in known.items():
        for cells, should in zip((8, 16, 32, 64), values):
            results = run(CONFORMING, cells, points)
            error = results["stress"]["value"]
            top = results["top u_y"]["value"] / sinking - 1
            print(f"{points} x {points}, {cells} cells: stress {error:.4f}, top {top:.3f}")
            expect(abs(error / should - 1) < 0.1, "stress with crossing")
            expect(abs(top) < 0.1, "top")
    for cells in (8, 64):
        error = stress_error(PENALTY, cells, 2)
        print(f"cut base, {cells} cells: stress {error:.4f}")
        expect(error < 0.12, "stress on the cut base")


main()
