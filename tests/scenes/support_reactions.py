"""Paper L, section 4.3: the multipliers of a clamp on all kinds of grids.

Those that cells share follow the exact traction: the bending profile, linear over
the height, of the total variation 12 M. (A converged finite-element run has 1.10 of
that, as the clamp keeps its end plane.) So do those of all cells with a penalty on
their jumps. Without either they oscillate on triangles (Fig. 3). Forces and moments
balance in the deformed state, wherever cells are cut, also where the cut cells hold
no material point.
"""

import os
import sys
from math import hypot
from pathlib import Path

from cantilever_runs import KINDS, SCENE, balance, results, size
from driver import expect

sys.path.append(str(Path(os.environ["IMPOINT_SOURCE"]) / "scripts"))
from vtu import read_rows  # noqa: E402

MOMENT = 313920.
SIZE = 1 / 8
# Of the variation over the exact one's; without sharing it is above the second.
LARGEST = 1.5
OSCILLATES = {"c": 5., "d": 20.}
# Beyond 0.894 no material point is left in the cut cells of kind a; at 0.075 and
# 0.125 the clamp follows a line of vertices of kind d.
CUTS = {"a": (1e-9, 0.1, 0.9, 1 - 1e-9), "b": (0.2, 0.6),
        "c": (1e-9, 0.1, 0.9, 1 - 1e-9),
        "d": (1e-9, 0.075, 0.125, 0.3, 0.7, 0.9, 1 - 1e-9)}
# Of the tip over numbers of particles: where cells are cut anyhow, they are also
# the rule of integration along the clamp.
SPREAD = {"a": 1e-12, "b": 2e-4, "c": 1e-12, "d": 1e-3}


def run(kind, *settings, cut=0.5):
    """The clamp at a place of the cells, 0: their left, 1: their right face."""
    grid = size(kind, 2)
    if kind != "b":
        grid[-1] = f"Grid/Shift = {-cut * SIZE!r}, {-1 - SIZE / 2}"
    elif cut != 0.5:
        grid.append(f"Grid/Shift = {2.39 + cut * SIZE!r}, {-4.74 + 0.3 * cut * SIZE!r}")
    return results(SCENE + KINDS[kind], [
        *grid, "Output/Pictures every = 1",
        "Boundaries/clamp/Enforcement = lagrange multiplier", *settings])


def variation():
    """Of the last run's traction along the clamp, in units of the exact one's."""
    fields = read_rows(sorted(Path("run/vtu").glob("boundary-*.vtu"))[-1])
    rows = sorted((place[1], *(f / area[0] for f in force[:2])) for
                  place, force, area in
                  zip(fields["place"], fields["force"], fields["area"]))
    return sum(hypot(b[1] - a[1], b[2] - a[2])
               for a, b in zip(rows, rows[1:])) / (12 * MOMENT)


def check_smoothness(kind):
    choice = "Boundaries/clamp/Superfluous constraints = "
    run(kind, choice + "keep")
    all_kept = variation()
    run(kind, choice + "remove")
    removed = variation()
    balance(f"kind {kind}, stabilised", run(kind, choice + "stabilise"))
    stabilised = variation()
    balance(f"kind {kind}", run(kind))
    shared = variation()
    print(f"kind {kind}, variation of the traction over the exact one's: shared "
          f"{shared:.2f}, stabilised {stabilised:.2f}, removed {removed:.2f}, all "
          f"{all_kept:.2f}", flush=True)
    expect(max(shared, stabilised) < LARGEST, f"kind {kind}: {shared}, {stabilised}")
    if kind in OSCILLATES:
        expect(all_kept > OSCILLATES[kind] and removed > LARGEST,
               f"kind {kind}: nothing to see without sharing")


def check_numbers_of_particles(kind):
    """A particle a cell and 64 times as many."""
    tips = [run(kind, "Boundaries/clamp/Rule = equal",
                "Boundaries/clamp/Particles per segment = 1",
                f"Boundaries/clamp/Segment length = {SIZE / n}")
            ["tip u_y"]["value"] for n in (4, 16, 64)]
    spread = max(tips) / min(tips) - 1
    print(f"kind {kind}, tip over numbers of particles: {abs(spread):.1e}",
          flush=True)
    expect(abs(spread) < SPREAD[kind], f"kind {kind}: tips {tips}")


def main():
    for kind in KINDS:
        check_smoothness(kind)
        check_numbers_of_particles(kind)
    for kind, cuts in CUTS.items():
        for cut in cuts:
            reactions = run(kind, cut=cut)
            balance(f"kind {kind}, cut at {cut:.2g}", reactions)
            found = variation()
            print(f"  tip {reactions['tip u_y']['error']:.2e}, variation "
                  f"{found:.2f}", flush=True)
            expect(found < LARGEST, f"variation {found}")


main()
