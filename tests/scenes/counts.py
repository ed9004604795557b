"""A scene pays for what it uses: the counts in summary.json."""

from driver import expect, run_scene

STEPS = 4
LINEAR = ["Grid/Arguments = 19, 7 : 0, 0 : 9.5, 3.5",
          "Grid/Shift = -0.2, -1.8",
          "Bodies/beam/Mesh/Arguments = 32, 4 : 0, 0 : 8, 1",
          "Bodies/beam/Body force = 0; -0.00981 * t",
          "Bodies/beam/Material/Model = linear elastic",
          f"Time/Step = {1 / STEPS}"]
# The same cells around the beam, of 190 x 70.
LARGE = ["Grid/Arguments = 190, 70 : 0, 0 : 95, 35",
         "Grid/Shift = -47.7, -18.3"]
MOVING = ["Bodies/beam/Body force = 0; -9.81 * t",
          "Bodies/beam/Material/Model = neo-Hookean"]


def show_and_compare(title, counts, expected):
    for name, value in expected.items():
        print(f"{title}: {counts[name]} {name}")
        expect(counts[name] == value,
               f"{title}: {counts[name]} {name} instead of {value}")


def main():
    linear = run_scene("quickstart.prm", "linear", LINEAR)["counts"]
    show_and_compare("linear elasticity", linear,
                     {"steps": STEPS, "halved steps": 0, "tangents": STEPS,
                      "newton iterations": STEPS, "patterns": 1,
                      "projections": 0, "sorts": 0})
    # One a step, or fewer: the factor of an earlier step serves the next.
    expect(1 <= linear["factorisations"] <= STEPS,
           f"{linear['factorisations']} factorisations in {STEPS} steps")
    print("at most one factorisation a step: yes")

    large = run_scene("quickstart.prm", "large", [*LINEAR, *LARGE])["counts"]
    show_and_compare("a grid 100 times larger", large, linear)
    expect(0 < linear["visited cells"] < 60 and
           0 < linear["visited nodes"] < 80, "more is visited than the beam's")

    moving = run_scene("quickstart.prm", "moving", [*LINEAR, *MOVING])["counts"]
    expect(0 < moving["sorts"] <= STEPS and
           moving["newton iterations"] > STEPS, "sorts aren't counted")
    print("points that change cells are sorted: yes")
    expect(moving["searches"] == moving["shape values"] == STEPS,
           "searches and shape values aren't counted")

    kept = run_scene("quickstart.prm", "kept", [
        *LINEAR, *MOVING, "Grid/Reset = never",
        "Boundaries/clamp/Enforcement = nitsche"])["counts"]
    show_and_compare("grid never reset", kept,
                     {"steps": STEPS, "sorts": 0, "searches": 0,
                      "shape values": 0, "patterns": 1, "projections": 0})


main()
