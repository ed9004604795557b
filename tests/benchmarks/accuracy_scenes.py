"""What tests/benchmarks/accuracy runs: scenes, and the ways to compute each."""
from dataclasses import dataclass, replace


@dataclass(frozen=True)
class Way:
    """n: points a direction of a cell; kind of grid as paper L's Table 1."""
    basis: str
    points: str         # body mesh, sub-cells (clipped, papers' way) or clipped (Gauss rules)
    n: int
    enforcement: str
    kind: str = "a"
    reset: str = "every step"
    finest: int = 9     # level

    def label(self):
        return "%s, %s %d" % (self.basis, self.points, self.n)


DEGREES = {"linear": 1, "quadratic spline": 2, "cubic spline": 3, "quadratic": 2}
ALL = ("penalty", "projected penalty", "lagrange multiplier", "implicit boundary", "nitsche")
TWO = ("projected penalty", "nitsche")
# the papers' functions and points first; points that serve each basis
LINEAR, LINEAR_CLIPPED = ("linear", "body mesh", 2), ("linear", "clipped", 2)
SPLINE, SPLINE_3 = ("quadratic spline", "clipped", 2), ("quadratic spline", "clipped", 3)
SPLINE_BODY = ("quadratic spline", "body mesh", 2)
CUBIC, ELEMENT = ("cubic spline", "clipped", 4), ("quadratic", "clipped", 3)


def ways(bases, methods, **more):
    return [Way(*basis, method, **more) for basis in bases for method in methods]


def way_settings(way, body, boundaries):
    """The entries of any scene; what is already so is left out."""
    at = "Bodies/%s/" % body
    settings = ["Grid/Basis = " + way.basis, "Grid/Reset = " + way.reset,
                at + "Points = " + ("body mesh" if way.points == "body mesh" else "clipped"),
                at + "Points per direction = %d" % way.n]
    if way.points == "clipped":
        settings.append(at + "Piece = gauss")
    if way.enforcement != "conforming":
        for name in boundaries:
            settings += ["Boundaries/%s/Enforcement = %s" % (name, way.enforcement),
                         "Boundaries/%s/Particles per segment = %d" % (name, DEGREES[way.basis] + 1)]
    return settings


def conforming(name):
    at = "Boundaries/%s/" % name
    return [at + entry for entry in ("Kind = conforming", "Polyline =", "Rule = equal", "Particles per segment = 0",
                                     "Penalty factor = 10000", "Enforcement = projected penalty")]


def outline(body, text):
    at = "Bodies/%s/" % body
    return [at + "Points per simplex = 0", at + "Mesh/Generator =", at + "Mesh/Arguments =", at + "Mesh/Refinements = 0",
            at + "Mesh/Cells = as made", at + "Outline = " + text]


def numbers(*values):
    return ", ".join(repr(v) for v in values)


class Scene:
    """One of the papers' (or beyond them): files by kind of grid, results that have references, ways, levels."""
    title, files, results, levels, ways, timed = "", {}, [], range(4), [], True

    def settings(self, way, level):
        raise NotImplementedError

    def error(self, results):
        """Relative; of several components: of the vector."""
        pairs = [(results[name]["value"], results[name]["reference"]) for name in self.results]
        size = sum(b * b for _, b in pairs) ** 0.5
        return sum((a - b) ** 2 for a, b in pairs) ** 0.5 / size


class Cantilever(Scene):
    title = "P4.1 cantilever, full gravity"
    files = {"a": "penalty/4.1-cantilever.prm", "b": "penalty/4.1-cantilever-rotated.prm",
             "c": "penalty/4.1-cantilever-triangles.prm", "d": "penalty/4.1-cantilever-distorted.prm"}
    results = ["tip u_x", "tip u_y"]
    levels = range(4)
    ways = (ways([LINEAR, LINEAR_CLIPPED, SPLINE_BODY, SPLINE, SPLINE_3, CUBIC, ELEMENT], ALL)
            + ways([LINEAR, SPLINE_3, CUBIC, ELEMENT], ["conforming"])
            + ways([LINEAR, LINEAR_CLIPPED, SPLINE_3, ELEMENT], TWO, kind="b")
            + ways([("linear", "body mesh", 12), LINEAR_CLIPPED, ELEMENT], TWO, kind="c")
            + ways([("linear", "body mesh", 12), LINEAR_CLIPPED, ELEMENT], TWO, kind="d"))

    def settings(self, way, level):
        h = 0.5 / 2 ** level
        start = 0. if way.enforcement == "conforming" else -h / 2
        settings = ["Grid/Refinements = %d" % level]
        if way.kind != "b":
            settings.append("Grid/Shift = " + numbers(start, -1 - 0.3 * h))
        if way.points == "body mesh":
            settings.append("Bodies/beam/Mesh/Refinements = %d" % level)
        else:
            settings += outline("beam", "0 0; 8 0; 8 1; 0 1")
        if way.enforcement == "conforming":
            settings += conforming("clamp")
        return settings + way_settings(
            replace(way, n=2) if way.kind in "cd" and way.points == "body mesh" else way, "beam", ["clamp"])


class Tuned(Cantilever):
    """On the fewest functions: the beam's long sides along the grid, cells of 1/n of its height, twice as long."""
    title = "P4.1 cantilever, grid along the sides"
    files = {"a": "penalty/4.1-cantilever.prm"}
    levels = range(8)
    ways = (ways([LINEAR_CLIPPED], ["nitsche"])
            + ways([SPLINE, SPLINE_3, ("cubic spline", "clipped", 3), CUBIC], ["nitsche"], finest=5))
    cells = ((1, 1), (1, 2), (2, 1), (2, 2), (3, 2), (4, 2), (10, 1), (20, 1))  # over the height; length over height

    def settings(self, way, level):
        n, aspect = self.cells[level]
        h = 1 / n
        columns = 8 * n // aspect + 1
        return (["Grid/Refinements = 0", "Grid/Shift = " + numbers(-h * aspect / 2, -1.),
                 "Grid/Arguments = %d, %d : 0, 0 : %r, 3" % (columns, 3 * n, columns * h * aspect)]
                + outline("beam", "0 0; 8 0; 8 1; 0 1") + way_settings(way, "beam", ["clamp"]))


class Solid(Scene):
    title = "P4.1 cantilever in 3D"
    files = {"a": "penalty/4.1-cantilever-3d.prm", "c": "penalty/4.1-cantilever-3d-tetrahedra.prm"}
    results = ["tip u_x", "tip u_y"]
    levels = range(3)
    ways = (ways([LINEAR, LINEAR_CLIPPED], TWO) + ways([SPLINE, SPLINE_3], ALL[1:])
            + [Way(*CUBIC, "nitsche", finest=1), Way(*ELEMENT, "nitsche", finest=1)]
            + [Way(*LINEAR_CLIPPED, "nitsche", kind="c"), Way(*ELEMENT, "nitsche", kind="c", finest=1)])

    def settings(self, way, level):
        h = 0.5 / 2 ** level
        at = "Bodies/beam/"
        body = (32, 4, 4) if way.points == "body mesh" else (1, 1, 1)
        settings = ["Grid/Arguments = 17, 5, 3 : 0, 0, 0 : 8.5, 2.5, 1.5", "Grid/Refinements = %d" % level,
                    "Grid/Shift = " + numbers(-h / 2, -1 - 0.3 * h, -0.3 * h),
                    at + "Mesh/Arguments = %d, %d, %d : 0, 0, 0 : 8, 1, 1" % body,
                    at + "Mesh/Refinements = %d" % (level if way.points == "body mesh" else 0)]
        if way.points == "clipped":
            settings += [at + "Points per simplex = 0", at + "Mesh/Cells = as made"]
        return settings + way_settings(way, "beam", ["clamp"])


def bar_end():
    """St. Venant-Kirchhoff in one dimension: E/2 F (F^2 - 1) = rho g (L - X), integrated by Simpson's rule."""
    load, young, n = 1000 * 9.81, 90e6, 200

    def stretch(stress):
        f = 1.
        for _ in range(50):
            f -= (young / 2 * f * (f * f - 1) - stress) / (young / 2 * (3 * f * f - 1))
        return f - 1
    weights = [1] + [4, 2] * (n // 2 - 1) + [4, 1]
    return sum(w * stretch(load * 8 * (1 - i / n)) for i, w in enumerate(weights)) * 8 / n / 3


class Bar(Scene):
    title = "L4.1 pulled bar"
    files = {"a": "multiplier/4.1-pulled-bar.prm", "b": "multiplier/4.1-pulled-bar-rotated.prm",
             "c": "multiplier/4.1-pulled-bar-triangles.prm", "d": "multiplier/4.1-pulled-bar-distorted.prm"}
    results = ["tip u_x"]
    ways = (ways([LINEAR, LINEAR_CLIPPED, SPLINE_BODY, SPLINE_3, CUBIC, ELEMENT], ALL)
            + ways([LINEAR, LINEAR_CLIPPED, SPLINE_3, ELEMENT], TWO, kind="b")
            + ways([("linear", "body mesh", 12), LINEAR_CLIPPED, ELEMENT], TWO, kind="c")
            + ways([("linear", "body mesh", 12), LINEAR_CLIPPED, ELEMENT], TWO, kind="d"))

    def settings(self, way, level):
        h = 0.5 / 2 ** level
        settings = ["Grid/Refinements = %d" % level, "Boundaries/clamp/Rule = cut",
                    "Boundaries/clamp/Segment length = 0", "Measurements/tip/Reference = %r" % bar_end()]
        if way.kind == "b":
            settings.append("Grid/Arguments = 16, 11 : 0, 0 : 8, 5.5")
        else:
            settings += ["Grid/Arguments = 17, 4 : 0, 0 : 8.5, 2", "Grid/Shift = " + numbers(-h / 2, -0.5 - 0.3 * h)]
        if way.points == "body mesh":
            settings += ["Bodies/bar/Mesh/Arguments = 32, 4 : 0, 0 : 8, 1", "Bodies/bar/Mesh/Refinements = %d" % level]
        else:
            settings += outline("bar", "0 0; 8 0; 8 1; 0 1")
        return settings + way_settings(
            replace(way, n=2) if way.kind in "cd" and way.points == "body mesh" else way, "bar", ["clamp"])


class Block(Scene):
    title = "I5.1 contained block at 30 degrees"
    files = {"a": "implicit-boundary/5.1-contained-block-30.prm"}
    results = ["r_sigma"]
    levels = range(1)
    ways = ways([("linear", "sub-cells", 1), LINEAR_CLIPPED, SPLINE_3, CUBIC, ELEMENT], ALL[1:])
    walls = ["left", "bottom", "top", "push"]

    def settings(self, way, level):
        return way_settings(way, "block", self.walls)

    def error(self, results):
        return max(result["value"] for name, result in results.items() if name.startswith("r_sigma"))


class DeepBeam(Scene):
    title = "I5.2 deep beam"
    files = {"a": "implicit-boundary/5.2-deep-beam-penalty.prm"}
    results = ["corner u_y"]
    ways = ways([("linear", "sub-cells", 4), LINEAR_CLIPPED, SPLINE_3, CUBIC, ELEMENT], ALL)
    # conforming, quadratic elements, h = 10 ... 1.25 mm: -28.475656, -28.516767, -28.531987, -28.537685 (order 1.42, that
    # of the support's ends), extrapolated; linear functions extrapolate to -28.5420
    corner = -28.5411

    def settings(self, way, level):
        h = 20. / 2 ** level
        return ["Grid/Arguments = 8, 9 : 0, 0 : 160, 180", "Grid/Refinements = %d" % level,
                "Grid/Shift = " + numbers(-h / 2, -40 - 0.3 * h), "Boundaries/support/Penalty factor = 10000",
                "Measurements/corner/Reference = none; %r" % self.corner] + way_settings(way, "beam", ["support"])


class Column(Scene):
    title = "Column compaction, base cut"
    files = {"a": "beyond/column-compaction-penalty.prm"}
    results = ["stress"]
    bases = [("linear", "body mesh", 2), ("linear", "body mesh", 3), ("quadratic spline", "body mesh", 3),
             ("quadratic spline", "clipped", 3), ("cubic spline", "clipped", 4)]
    ways = ways(bases, TWO) + ways([("linear", "clipped", 3), *bases[3:]], TWO, reset="never")

    def settings(self, way, level):
        cells = 8 * 2 ** level
        h = 50 / cells
        return ["Grid/Arguments = 1, %d : 0, %r : %r, %r" % (cells + 1, -h / 2, h, 50 + h / 2),
                "Bodies/column/Mesh/Arguments = 1, %d : 0, 0 : %r, 50" % (cells, h),
                "Boundaries/base/Polyline = 0 0; %r 0" % h,
                "Measurements/support/Reference = 0; %r*t" % (40e3 * h)] + way_settings(way, "column", ["base"])

    def error(self, results):
        return results["stress"]["value"]


class Vortex(Scene):
    title = "Generalised vortex"
    files = {"a": "beyond/generalised-vortex.prm"}
    results = ["displacement"]
    levels = range(3)
    ways = [Way(*basis, "none", reset=reset) for reset in ("never", "every step")
            for basis in (LINEAR_CLIPPED, SPLINE_3, CUBIC)] + [Way(*ELEMENT, "none", reset="never")]

    def settings(self, way, level):
        return ["Grid/Refinements = %d" % level] + way_settings(way, "ring", [])

    def error(self, results):
        return results["displacement"]["value"]


class Cylinder(Scene):
    title = "L4.4 sliding cylinder"
    files = {"a": "multiplier/4.4-sliding-cylinder.prm", "b": "multiplier/4.4-sliding-cylinder-rotated.prm",
             "c": "multiplier/4.4-sliding-cylinder-triangles.prm", "d": "multiplier/4.4-sliding-cylinder-distorted.prm"}
    results = ["centre path"]
    levels = range(1)
    ways = (ways([("linear", "body mesh", 2), ("quadratic spline", "body mesh", 2)], ALL)
            + [way for kind in "bcd" for way in ways([("linear", "body mesh", 2)], TWO, kind=kind)])

    def settings(self, way, level):
        return way_settings(way, "cylinder", ["plane"])


SCENES = {"P4.1": Cantilever(), "P4.1 tuned": Tuned(), "P4.1 3D": Solid(), "L4.1": Bar(), "I5.1": Block(),
          "I5.2": DeepBeam(), "column": Column(), "vortex": Vortex(), "sliding": Cylinder()}
