"""Paper L, Fig. 11: the cantilever's error over h on the four kinds of grids."""

from cantilever_runs import KINDS, SCENE, TIP, clamp, rate, size, tip
from driver import expect

SMALL_STRAIN_TIP = -6.78039621e-4

# Errors of a prototype at h = 1/4, 1/8, 1/16 m: what kind a must have.
PROTOTYPE = [2.9e-2, 7.6e-3, 1.9e-3]


def errors(kind, settings, scene, exact):
    """At h = 1/4, 1/8, 1/16 m; prints them and the last rate."""
    values = [abs(tip(scene, size(kind, n) + settings) / exact - 1)
              for n in (1, 2, 3)]
    last = rate(values[1], values[2])
    print(" ".join(f"{value:.3e}" for value in values),
          f"rate {last:.2f}: kind {kind},",
          ", ".join(entry.split("=")[1].strip() for entry in settings), flush=True)
    return values, last


def main():
    for kind, name in KINDS.items():
        values, last = errors(kind, clamp("projected penalty", 1e4),
                              SCENE + name, TIP)
        expect(1.9 <= last <= 2.5, f"kind {kind}: projected penalty")
        if kind == "a":
            expect(all(abs(value / should - 1) < 0.03
                       for value, should in zip(values, PROTOTYPE)),
                   f"errors {values}, not {PROTOTYPE}")
        _, last = errors(kind, clamp("penalty", 1e2), SCENE + name, TIP)
        expect(1.9 <= last <= 2.5, f"kind {kind}: penalty at 1e2")

    values = [abs(tip(SCENE + "-unstructured",
                      [f"Grid/Refinements = {n}", f"Bodies/beam/Mesh/Refinements = {n}"])
                  / TIP - 1) for n in (2, 3)]
    print("mesh file:", values)
    expect(1.9 <= rate(*values) <= 2.5, f"triangles of a mesh file: {values}")

    # Each particle holds its place: on triangles the clamp locks.
    for factor in (1e4, 1e8):
        _, last = errors("c", clamp("penalty", factor), SCENE + KINDS["c"], TIP)
        expect(1.4 <= last <= 1.8, f"penalty at {factor} must lock")
    _, last = errors("c", clamp("projected penalty", 9e7), SCENE + KINDS["c"],
                     TIP)
    expect(1.9 <= last <= 2.5, "projected penalty must not lock")

    values, last = errors("a", [], SCENE + "-small-strain", SMALL_STRAIN_TIP)
    expect(1.9 <= last <= 2.5 and values[-1] < 2e-3, "small strains")


main()
