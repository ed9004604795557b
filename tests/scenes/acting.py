"""When boundaries act, and how slip walls turn with them."""

from math import cos, sin

from driver import expect, run_scene

QUIET = ["Output/Pictures every = 0"]
BEAM = "penalty/4.1-cantilever-small-strain.prm"
BLOCK = "implicit-boundary/5.1-contained-block.prm"
SIDES = ("left", "bottom", "top", "push")
TURN = 0.6


def check_late_boundary():
    """A support that lies below the beam until it acts, in cells without material."""
    kept = [*QUIET, "Grid/Refinements = 0", "Grid/Shift = -0.25, -1.15",
            "Bodies/beam/Mesh/Refinements = 0", "Grid/Reset = never"]
    late = [*kept, "Boundaries/Names = clamp, late",
            "Boundaries/late/Polyline = 0 -0.2; 8 -0.2", "Boundaries/late/Rule = cut"]
    alone, resting, acting = (
        run_scene(BEAM, "run", settings)["results"]["tip u_y"]["value"]
        for settings in (kept, [*late, "Boundaries/late/Active from = 0.9"], late))
    print(f"tip {alone:.6e} m, with a support that rests {resting / alone - 1:.1e}, "
          f"that acts {acting / alone - 1:.1e}")
    expect(abs(resting / alone - 1) < 1e-6, "a boundary stiffens before it acts")
    expect(abs(acting / alone) < 0.1, "the support does nothing when it acts")


def check_turning_walls():
    """Walls that compress a block by 1 % and then turn it: so does the block, to 1.2e-3
    of its displacement; to 8.5e-3 only if their normals stay as they were."""
    c, s = cos(TURN), sin(TURN)
    pushed = "(x - (x + 50) / 100)"
    settings = [*QUIET, "Grid/Reset = never", "Bodies/block/Points per direction = 2",
                "Bodies/block/Material/Model = Hencky", "Time/End time = 2",
                "Time/Step = 0.2", "Boundaries/push/Value = -min(t, 1); 0",
                f"Measurements/r_u/Exact = {c!r} * {pushed} - {s!r} * y - x; "
                f"{s!r} * {pushed} + {c!r} * y - y"]
    for side in SIDES:
        settings += [f"Boundaries/{side}/Rotation angle = {TURN} * max(t - 1, 0)",
                     f"Boundaries/{side}/Rotation centre = 0, 0"]
        settings.append(f"Boundaries/{side}/Enforcement = nitsche")
    error = run_scene(BLOCK, "run", settings)["results"]["r_u"]["value"]
    print(f"nitsche: block that was compressed and turned, error {error:.1e}")
    expect(error < 2e-3, "normals of slip walls that turn")


def check_initial_acceleration():
    """A bar in steps of 20 times the passage of a wave: only with accelerations of the
    start that its hold and masses have, not its stiffness, does it move as far."""
    tips = {}
    for method in ("lagrange multiplier", "nitsche", "implicit boundary"):
        summary = run_scene(BEAM, "run", [
            *QUIET, "Grid/Refinements = 0", "Grid/Shift = -0.25, -1.15",
            "Bodies/beam/Mesh/Refinements = 0", "Time/Kind = dynamic", "Time/Step = 0.5",
            "Bodies/beam/Body force = 9.81; 0", f"Boundaries/clamp/Enforcement = {method}"])
        expect(summary["counts"]["halved steps"] == 0, f"{method}: halved")
        tips[method] = summary["results"]["tip u_x"]["value"]
        print(f"{method}: tip {tips[method]:.6e} m")
    for method, tip in tips.items():
        expect(abs(tip / tips["lagrange multiplier"] - 1) < 1e-2, method)


check_late_boundary()
check_turning_walls()
check_initial_acceleration()
