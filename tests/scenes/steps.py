"""What adds up over steps: a wheel that is turned on a round pin, a bar that is pulled
by stabilised multipliers, a block that flies and spins on consistent masses, one that
its clamp turns far in each step."""

from math import cos, hypot, pi, sin
from pathlib import Path

from driver import expect, run_scene

SCENES = Path(__file__).parent
WHEEL, BAR, BLOCK, TURNED = (SCENES / f"steps_{name}.prm"
                             for name in ("wheel", "bar", "block", "turned"))


def circle(radius, n, way):
    return "; ".join(f"{radius * cos(way * 2 * pi * i / n):.15g} "
                     f"{radius * sin(way * 2 * pi * i / n):.15g}" for i in range(n))


def closed(line):
    return line + "; " + line.split(";")[0]


def turned_wheel(enforcement, *pin):
    """The rim turns the wheel; a pin without friction takes no torque. In a step
    the material leaves along the tangent: a gap of 0.3 * 0.025^2 / 2, 20 times."""
    results = run_scene(WHEEL, "wheel", [
        f"Bodies/wheel/Outline = {circle(1, 96, 1)} | {circle(0.3, 96, 1)}",
        f"Boundaries/rim/Polyline = {closed(circle(1, 96, 1))}",
        f"Boundaries/pin/Polyline = {closed(circle(0.3, 96, -1))}",
        f"Boundaries/pin/Enforcement = {enforcement}",
        *(f"Boundaries/pin/{entry}" for entry in pin)])["results"]
    # of what a wheel would need whose hole is glued to the pin
    torque = results["hub M_z"]["value"] / (4 * pi * 1e6 / 2.6 * 0.3**2 * 0.5)
    error = results["turn"]["value"]
    print(f"wheel, {enforcement} {pin}: torque {torque:.1e}, error {error:.1e}",
          flush=True)
    expect(abs(torque) < 1e-3, f"{enforcement} {pin}: the pin holds {torque}")
    expect(error < 2.5e-3, f"{enforcement} {pin}: displacements {error}")


def pulled_bar():
    """An even traction has no jumps: no gap, however many steps."""
    for cells in ("as made", "triangles"):
        results = run_scene(BAR, "bar", [f"Grid/Cells = {cells}"])["results"]
        print(f"bar, {cells}: {results['error']['value']:.1e}", flush=True)
        expect(results["error"]["value"] < 1e-9, f"stabilised: {results['error']}")
    energy = run_scene(BAR, "wave", [
        "Boundaries/pull/Traction = 0; 0", "Bodies/bar/Initial velocity = 1e-3 * x; 0",
        "Time/Kind = dynamic", "Time/End time = 0.1", "Time/Step = 1e-3"])["results"]
    # of 1e-6 x^2 over a unit length and height, density 1
    ratio = energy["energy total"]["value"] / (1e-6 / 6)
    print(f"bar, free wave: energy {ratio:.3f} of the start's", flush=True)
    expect(0.9 < ratio < 1.01, f"stabilised: energy {ratio}")


def spinning_block():
    """Nothing but inertia balances: steps converge, energy and angle stay."""
    for basis in ("linear", "quadratic spline"):
        summary = run_scene(BLOCK, "block", [f"Grid/Basis = {basis}"])
        results, halved = summary["results"], summary["counts"]["halved steps"]
        print(f"block, {basis}: energy {results['energy total']['error']:.1e}, angle "
              f"{results['way angle']['error']:.1e}, {halved} halved steps", flush=True)
        expect(halved == 0, f"{basis}: {halved} steps halved")
        expect(results["energy total"]["error"] < 1e-3, f"{basis}: energy")
        expect(results["way angle"]["error"] < 2e-3, f"{basis}: angle")


def turned_block(enforcement, material, cells):
    """Nothing is stressed: residuals have no force but themselves to be relative to,
    and a quarter of a radian is one step."""
    summary = run_scene(TURNED, "turned", [
        f"Boundaries/clamp/Enforcement = {enforcement}", f"Grid/Cells = {cells}",
        *(f"Bodies/block/Material/{entry}" for entry in material)])
    tip = [summary["results"][f"tip u_{c}"]["value"] for c in "xy"]
    error = hypot(tip[0] - (cos(1) - 1), tip[1] - sin(1))
    counts = summary["counts"]
    print(f"turned block, {enforcement}, {material[0]}, {cells}: "
          f"{counts['newton iterations']} iterations, error {error:.1e}", flush=True)
    expect(counts["halved steps"] == 0 and counts["newton iterations"] <= 28,
           f"{enforcement}, {material}, {cells}: {counts}")
    expect(error < 1e-6, f"{enforcement}, {material}, {cells}: {tip}")


for method in ("projected penalty", "lagrange multiplier", "implicit boundary",
               "nitsche"):
    turned_wheel(method)
turned_wheel("lagrange multiplier", "Superfluous constraints = keep")
turned_wheel("augmented Lagrangian", "Superfluous constraints = stabilise")
pulled_bar()
spinning_block()
turned_block("penalty", ["Model = neo-Hookean"], "triangles")
turned_block("augmented Lagrangian", ["Model = neo-Hookean"], "8 triangles")
turned_block("projected penalty", ["Model = Hencky"], "as made")
turned_block("lagrange multiplier", ["Model = St. Venant-Kirchhoff"], "as made")
