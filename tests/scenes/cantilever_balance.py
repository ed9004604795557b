"""Papers P and L: what the cantilever's clamp carries, load steps and 3D."""

from cantilever_runs import KINDS, SCENE, balance, clamp, results, size, tip
from driver import expect

CUBES = SCENE + "-3d"
ALIGNED = ["Grid/Shift = 0, -1.125, -0.125"]


def check_numbers_of_particles():
    """Paper L, section 4.3, on cells of 1/4 m: 8 ... 128 particles."""
    tips = []
    for length in (1 / 8, 1 / 32, 1 / 128):
        reactions = results("multiplier/4.3-support-reactions", [
            "Grid/Arguments = 33, 9 : 0, 0 : 8.25, 2.25",
            "Grid/Shift = -0.125, -1.125",
            "Bodies/beam/Mesh/Arguments = 64, 8 : 0, 0 : 8, 1",
            f"Boundaries/clamp/Segment length = {length}"])
        balance(f"{1 / length:.0f} particles", reactions)
        tips.append(reactions["tip u_y"]["value"])
    spread = max(tips) / min(tips) - 1
    print(f"spread of the tip's displacement {abs(spread):.1e}")
    expect(abs(spread) < 1e-6, f"tips {tips}")


def check_three_dimensions():
    conforming = tip(CUBES + "-conforming", [])
    gaps = [abs(tip(CUBES, ALIGNED + clamp("penalty", factor)) / conforming - 1)
            for factor in (1e3, 1e5)]
    print("to the conforming tip at 1e3, 1e5 E/h:", *(f"{g:.3e}" for g in gaps))
    expect(gaps[1] < 2e-6 and abs(gaps[0] / gaps[1] / 100 - 1) < 0.02, str(gaps))

    plane = tip(SCENE, size("a", 1))
    solid = results(CUBES, [])
    balance("hexahedra", solid)
    print(f"hexahedra to the plane: {solid['tip u_y']['value'] / plane - 1:.1e}, "
          f"to the conforming: {solid['tip u_y']['value'] / conforming - 1:.1e}")
    expect(abs(solid["tip u_y"]["value"] / plane - 1) < 1e-6, "not the plane's")
    expect(abs(solid["tip u_y"]["value"] / conforming - 1) < 3e-3, "far off")
    balance("tetrahedra", results(CUBES + "-tetrahedra", []))


def main():
    for kind, name in KINDS.items():
        balance(f"kind {kind}", results(SCENE + name, size(kind, 1)))

    stepped = results(SCENE + "-steps", [])
    balance("20 steps", stepped)
    print(f"20 steps: error {stepped['tip u_y']['error']:.2e}")
    expect(stepped["tip u_y"]["error"] < 0.02, "20 steps")

    check_numbers_of_particles()
    check_three_dimensions()


main()
