"""Paper L, Fig. 11: the cantilever's error over h on the four kinds of grids.

Argument: n of the finest grid, of cells of 2^-n / 2 m (3).
"""

import sys

from cantilever_runs import KINDS, SCENE, TIP, clamp, rate, results, size, tip
from driver import expect

SMALL_STRAIN_TIP = -6.78039621e-4

# Errors of a prototype at h = 1/4, 1/8, 1/16 m: what kind a must have.
PROTOTYPE = [2.9e-2, 7.6e-3, 1.9e-3]


FINEST = int(sys.argv[1]) if len(sys.argv) > 1 else 3

# Whatever their factor; of a penalty on each particle see below.
METHODS = {"projected penalty": 1e4, "augmented Lagrangian": 1e4,
           "lagrange multiplier": 1, "implicit boundary": 1}


def errors(kind, settings, scene, exact, coarsest=2):
    """From n = coarsest to FINEST; prints them and the last rate."""
    values = [abs(tip(scene, size(kind, n) + settings) / exact - 1)
              for n in range(coarsest, FINEST + 1)]
    last = rate(values[-2], values[-1])
    print(" ".join(f"{value:.3e}" for value in values),
          f"rate {last:.2f}: kind {kind},",
          ", ".join(entry.split("=")[1].strip() for entry in settings), flush=True)
    return values, last


def check_torsion():
    """In 3D: the torque of implicit boundaries is that of multipliers."""
    def torque(method, choice="automatic"):
        settings = [f"Boundaries/{side}/{entry}" for side in ("held", "turned") for entry in
                    (f"Enforcement = {method}", f"Superfluous constraints = {choice}")]
        return results("beyond/twisted-bar", settings)["turning M_x"]["value"]

    exact = torque("lagrange multiplier")
    means, each = (torque("implicit boundary", choice) / exact
                   for choice in ("automatic", "keep"))
    print(f"torque {exact:.1f} Nm, with implicit boundaries {means:.7f}, of each "
          f"particle {each:.2f} of it")
    expect(abs(means - 1) < 1e-5, "torsion with implicit boundaries")
    expect(each > 1.2, "implicit boundary of each particle must lock in torsion")


def main():
    for kind, name in KINDS.items():
        for method, factor in METHODS.items():
            _, last = errors(kind, clamp(method, factor), SCENE + name, TIP)
            expect(1.9 <= last <= 2.5, f"kind {kind}: {method}")
        _, last = errors(kind, clamp("penalty", 1e2), SCENE + name, TIP)
        expect(1.9 <= last <= 2.5, f"kind {kind}: penalty at 1e2")
    values, _ = errors("a", clamp("projected penalty", 1e4), SCENE, TIP, 1)
    expect(all(abs(value / should - 1) < 0.03
               for value, should in zip(values, PROTOTYPE)),
           f"errors {values}, not {PROTOTYPE}")

    values = [abs(tip(SCENE + "-unstructured",
                      [f"Grid/Refinements = {n}", f"Bodies/beam/Mesh/Refinements = {n}"])
                  / TIP - 1) for n in (2, 3)]
    print("mesh file:", values)
    expect(1.9 <= rate(*values) <= 2.5, f"triangles of a mesh file: {values}")

    # Each particle holds its place: where cells are cut anyhow the clamp locks.
    for factor in (1e4, 1e8):
        _, last = errors("c", clamp("penalty", factor), SCENE + KINDS["c"], TIP)
        expect(1.4 <= last <= 1.8, f"penalty at {factor} must lock")
    for kind in "bc":
        each = ["Boundaries/clamp/Superfluous constraints = keep",
                "Boundaries/clamp/Enforcement = implicit boundary"]
        _, last = errors(kind, each, SCENE + KINDS[kind], TIP)
        expect(last <= 1.7, "implicit boundary of each particle must lock")
    _, last = errors("c", clamp("projected penalty", 9e7), SCENE + KINDS["c"],
                     TIP)
    expect(1.9 <= last <= 2.5, "projected penalty must not lock")

    values, last = errors("a", [], SCENE + "-small-strain", SMALL_STRAIN_TIP)
    expect(1.9 <= last <= 2.5 and values[-1] < 2e-3, "small strains")


main()
check_torsion()
