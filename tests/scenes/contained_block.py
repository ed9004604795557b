"""Paper I, section 5.1: a contained block at any angle to the grid."""

from driver import expect, run_scene

SCENE = "implicit-boundary/5.1-contained-block.prm"
SIDES = ("left", "bottom", "top", "push")

# Table 1 of paper I: r_u and r_sigma_xx at an angle in degrees.
TABLE_1 = {0: (1.573e-9, 5.804e-9), 30: (1.173e-8, 1.299e-8),
           45: (2.036e-9, 9.133e-9), 90: (1.573e-9, 5.804e-9)}
OTHER_ANGLES = (7, 17, 61.3, 88)

# r_sigma_xx over delta / h: two gaps of 3/8 delta t / (lambda + 2 mu), where the last
# factor is the strain, make the strain smaller by 2 * 3/8 delta / (100 mm).
STRESS_FACTOR = 2 * 3 / 8 * 10 / 100


def sides(entry):
    return [f"Boundaries/{side}/{entry}" for side in SIDES]


def errors(angle, settings):
    summary = run_scene(SCENE, "run", [
        f"Grid/Rotation = {angle}", "Output/Pictures every = 0", *settings])
    return [summary["results"][name]["value"] for name in
            ("r_u", "r_sigma xx", "r_sigma yy", "r_sigma xy")]


def widths(width):
    return sides(f"Band width = {width}")


def check_table():
    for angle, bounds in TABLE_1.items():
        found = errors(angle, [])[:2]
        print(f"{angle} degrees: r_u {found[0]:.3e}, r_sigma_xx {found[1]:.3e}, "
              f"Table 1 {bounds[0]:.3e}, {bounds[1]:.3e}")
        expect(found[0] <= bounds[0] and found[1] <= bounds[1],
               f"Table 1 at {angle} degrees")


def check_angles():
    for angle in (*TABLE_1, *OTHER_ANGLES):
        # Of each particle's gap; means of cells at the corners add up to 16 %.
        found = errors(angle, widths(1e-6) + sides("Superfluous constraints = keep"))
        print(f"{angle} degrees, width 1e-6: r_u {found[0]:.3e}, r_sigma_xx "
              f"{found[1]:.4e}, by hand {1e-6 * STRESS_FACTOR:.4e}")
        expect(abs(found[1] / (1e-6 * STRESS_FACTOR) - 1) < 0.05,
               f"stress error at {angle} degrees is not that of the band")


def check_linear(angle, exponents):
    """Fig. 13: errors are in proportion to the width."""
    factors = {n: errors(angle, widths(f"1e-{n}"))[0] * 10**n
               for n in exponents}
    print(f"{angle} degrees, r_u h / delta: "
          + ", ".join(f"1e-{n}: {factor:.4f}" for n, factor in factors.items()))
    expect(max(factors.values()) < 1.2 * min(factors.values()),
           f"r_u is not linear in the width at {angle} degrees")


def check_refinement(angle):
    """Figs. 10-12: at a fixed delta / h errors fall with h at least."""
    found = [errors(angle, [f"Grid/Refinements = {n}", *widths(1e-4)])[0]
             for n in range(3)]
    print(f"{angle} degrees, grids of 10, 5, 2.5 mm: r_u "
          + ", ".join(f"{error:.3e}" for error in found))
    for coarse, fine in zip(found, found[1:]):
        expect(fine < 0.6 * coarse, f"no convergence at {angle} degrees")


def check_exact(method):
    for angle in (*TABLE_1, *OTHER_ANGLES):
        worst = max(errors(angle, sides(f"Enforcement = {method}")))
        print(f"{angle} degrees, {method}: {worst:.1e}")
        expect(worst <= 1e-11, f"{method} at {angle} degrees")


check_table()
check_angles()
check_linear(90, range(1, 9))
check_linear(30, range(1, 9))
check_refinement(90)
check_refinement(30)
check_exact("lagrange multiplier")
check_exact("augmented Lagrangian")
