"""Scenes of Kratos' MPMApplication: its stored results and the exact ones."""

import csv

from driver import expect, run_scene

# Node (0, 0): F_x, F_y; node (0, 1): F_x, F_y [N] of Kratos' dynamic cantilever.
CANTILEVER = {
    0.2: (8990.44173810582, 1622.8334210732667, -9183.02954936627, 1876.8241045136772),
    0.3: (14409.43024248143, 2128.381991106879, -14432.069936864533, 2806.8512556169667),
    0.5: (16558.573551981663, 1811.0192499517264, -16455.28487267334, 3174.159955890889),
    0.7: (6668.6945310598985, 1116.5315526678703, -6764.517309643878, 1514.0021349085641),
    0.9: (2272.2237507811, 876.2448055134795, -2066.7117450495316, 1016.0635211137098),
    1.1: (11315.353111465245, 2192.8812711409264, -11354.861312856467, 2707.818881242217),
}

# The same from an independent script that iterates to 1e-10, rounded to 1e-3 N.
CONVERGED = {
    0.2: (8990.374, 1622.838, -9183.111, 1876.822),
    0.3: (14409.425, 2128.383, -14432.068, 2806.853),
    0.5: (16558.565, 1811.024, -16455.294, 3174.165),
    0.7: (6668.574, 1116.536, -6764.646, 1514.003),
    0.9: (2272.207, 876.235, -2066.665, 1016.053),
    1.1: (11315.316, 2192.887, -11354.919, 2707.817),
}


def results(scene):
    return run_scene(f"beyond/{scene}.prm", "run",
                     ["Output/Pictures every = 0"])["results"]


def history():
    with open("run/history.csv") as file:
        return {round(float(row["time"]), 6): {key: float(row[key]) for key in row}
                for row in csv.DictReader(file)}


def below(name, error, bound):
    print(f"{name}: {error:.1e}, bound {bound:.1e}")
    expect(abs(error) < bound, name)


def free_fall():
    error = results("kratos-free-fall")["speed"]["value"]
    # Newton's tolerance
    below("free fall, speed", error, 1e-10)
    for time, row in history().items():
        expect(abs(row["block path"] / (9.81 * time**2 / 2) - 1) < 1e-10,
               f"free fall, path at {time} s")
    for time, stored in {0.1: 0.04904999999989475, 0.4: 0.7848000000052442,
                         1.0: 4.904999999952353}.items():
        below(f"free fall, path at {time} s against Kratos",
              history()[time]["block path"] / stored - 1, 1e-10)


def hexahedron():
    found = results("kratos-hexahedron")
    below("hexahedron, stress", found["stress"]["value"], 1e-10)
    exact = -0.9995 * 0.999 / (1 + 0.2 * (1 - 0.999**2))
    below("hexahedron, formula", exact / -0.9981014590366637 - 1, 1e-13)
    for component in "xyz":
        below(f"hexahedron, u_{component}", found[f"corner u_{component}"]["error"], 1e-10)


def slip():
    found = results("kratos-slip")
    below("slip, path", found["block path"]["error"], 1e-8)
    # Points tremble: the block is not quite rigid. Kratos stores 1.6e-4 m/s
    # across the strip for one of them.
    below("slip, speed along", found["along"]["value"], 1e-6)
    below("slip, speed across [m/s]", found["across"]["value"], 2e-4)


def cantilever():
    results("kratos-cantilever")
    for time, row in history().items():
        if time not in CANTILEVER:
            continue
        # Only these two nodes carry anything; x = 0 leaves the moment F_x(0, 1).
        upper = -row["reaction M_z"]
        found = (row["reaction F_x"] - upper, upper, row["reaction F_y"])
        for name, table, bound in (("Kratos", CANTILEVER, 1e-4),
                                   ("converged", CONVERGED, 1e-6)):
            low_x, low_y, up_x, up_y = table[time]
            below(f"cantilever at {time} s, {name}",
                  max(abs(one / other - 1)
                      for one, other in zip(found, (low_x, up_x, low_y + up_y))), bound)


def line_load():
    found = results("kratos-line-load")
    for name in ("tip u_x", "tip u_y", "middle u_y", "reaction F_y", "reaction M_z"):
        below(f"line load, {name}", found[name]["error"], 1e-5)
    below("line load, reaction F_x [load]", found["reaction F_x"]["value"] / 800, 1e-5)


free_fall()
hexahedron()
slip()
cantilever()
line_load()
