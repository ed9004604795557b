"""The wall under a heap of sand does not yield with time, however stiff it is and
whatever the steps.

Argument: 'all' for all stiffnesses and steps (5 min), else three of each.
"""

import csv
import sys
from pathlib import Path

from driver import expect, run_scene

H = 0.01
# A penalty on the step's gap alone sinks by p / beta in each step, 1e-5 m at 1e8 Pa/m.
ALLOWED = 1e-4 * H


def lowest(beta, step):
    """How far the deepest point under the heap's top has sunk after 0.5 s and 2 s."""
    folder = f"heap-{beta:.0e}-{step}"
    factor = [f"Boundaries/{wall}/Penalty factor = {beta}"
              for wall in ("wall", "floor")]
    summary = run_scene(Path(__file__).parent / "sand_heap.prm", folder,
                        [*factor, f"Time/Step = {step}"])
    expect(summary["counts"]["halved steps"] == 0, f"{folder}: steps were lost")
    with open(f"{folder}/history.csv") as file:
        rows = list(csv.DictReader(file))
    at = {round(float(row["time"]), 9): row for row in rows}
    return [-float(at[time]["foot u_y"]) for time in (0.5, 2)]


def main():
    cases = [(1e8, 5e-3), (1e10, 5e-3), (1e13, 2.5e-3)]
    if "all" in sys.argv[1:]:
        cases = [(10**n, step) for n in range(8, 14)
                 for step in (2.5e-3, 1e-3, 5e-4)]
    for beta, step in cases:
        early, late = lowest(beta, step)
        print(f"beta {beta:.0e} Pa/m, steps of {step} s: deepest point "
              f"{early:.3e} m down at 0.5 s, {late - early:.1e} m more at 2 s")
        expect(abs(late - early) < ALLOWED, "the wall yields with time")


main()
