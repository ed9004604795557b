"""Boundaries are as stiff as what they hold: a soft cantilever moves the same
with and without one a million times as stiff beside it."""

from pathlib import Path

from driver import expect, run_scene

SCENE = str(Path(__file__).with_name("two_stiffnesses.prm"))
ALONE = ["Bodies/Names = soft", "Boundaries/Names = clamp"]
METHODS = ("penalty", "projected penalty", "augmented Lagrangian",
           "lagrange multiplier", "implicit boundary", "nitsche")


def results(settings, alone, ranks=1):
    # a scene may not have sections of bodies and boundaries without a name
    text = Path(SCENE).read_text()
    if alone:
        for name in ("stiff", "upper clamp"):
            start = text.index(f"  subsection {name}\n")
            text = text[:start] + text[text.index("\n  end\n", start) + 7:]
    scene = Path("alone.prm" if alone else "both.prm").resolve()
    scene.write_text(text)
    if alone:
        settings = [setting for setting in settings
                    if not setting.startswith(("Bodies/stiff", "Boundaries/upper"))]
    summary = run_scene(str(scene), "run", [*settings, *(ALONE if alone else [])],
                        ranks=ranks)
    return {name: value["value"] for name, value in summary["results"].items()}


def compare(what, settings, bound, ranks=1):
    alone = results(settings, True)
    both = results(settings, False, ranks)
    error = max(abs(both[name] - alone[name]) / abs(alone[of])
                for name, of in (("tip u_x", "tip u_y"), ("tip u_y", "tip u_y"),
                                 ("force F_x", "force F_y"),
                                 ("force F_y", "force F_y"),
                                 ("force M_z", "force M_z")))
    print(f"{what}: {alone['tip u_y']:.5e} m, beside the stiff one {error:.1e} off")
    expect(error < bound, what)


def main():
    for method in METHODS:
        settings = [f"Boundaries/{name}/Enforcement = {method}"
                    for name in ("clamp", "upper clamp")]
        compare(method, settings, 1e-8)
        compare(f"{method}, iterative, 2 ranks", [
            *settings, "Linear solver/Kind = iterative"], 1e-6, 2)
    compare("triangles, stabilised", [
        "Grid/Cells = triangles",
        *(f"Boundaries/{name}/{entry}" for name in ("clamp", "upper clamp")
          for entry in ("Enforcement = lagrange multiplier",
                        "Superfluous constraints = stabilise"))], 1e-8)
    compare("one point a cell", [
        f"Bodies/{body}/Points per direction = 1" for body in ("soft", "stiff")], 1e-8)


main()
