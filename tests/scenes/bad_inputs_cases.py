"""Wrong scenes and command lines, with what the message must say of them.

SCENES: what is done to bad_inputs.prm (a text replaced by another, which may be
several lines), what the message says, and, if the message points to another
line than that of the new text, a text which that line contains ('' if the
mistake is something that is missing and so has no line).
COMMANDS: the arguments of impoint, and what the message says.
"""

MESH = "set Generator = subdivided_hyper_rectangle\n      set Arguments = 16"
CLAMP = "set Polyline = 0 0.5; 0 0"
CUT = "\n    set Rule = cut\n    set Enforcement = projected penalty"
QUANTITY = "set Quantity = probe"
NO_CLAMP = ("""  set Names = clamp
  subsection clamp
    set Polyline = 0 0.5; 0 0
    set Rule = cut
    set Enforcement = projected penalty
  end
""", "")

SCENES = [
    # names and syntax
    ("set Density", "set Densty", "no entry 'Densty'.*mean 'Density'"),
    ("subsection Grid", "subsection Gird", "no section 'Gird'.*mean 'Grid'"),
    ("    set Points per", "    sett Points per", "'sett.*not a line.*'set'"),
    ("set Density = 1000", "set Density 1000", "has no '='"),
    ("set Density = 1000", "set Density = 1000\n    set Density = 900",
     "'Density' is set twice.*first in line 12", "= 900"),
    ("  set Folder = results\nend", "  set Folder = results",
     "'Output' is not closed.*Write 'end'", "subsection Output"),
    ("set Title = A clamped bar", "end", "'end' without an open section"),
    ("set Title = A clamped bar", "include bad_inputs_scene.prm",
     "includes itself"),
    ("set Title = A clamped bar", "include nowhere.prm",
     "nowhere.prm' cannot be read"),
    ("set Names = bar", "set Names = bar, bar", "name 'bar' occurs twice"),
    ("set Names = bar", "set Names = bar, rod", "body 'rod' has no shape", ""),
    ("set Names = clamp", "set Names = wall", "no section 'Boundaries/clamp'",
     "subsection clamp"),
    ("set Names = bar", "set Names = bar,,rod", "an empty name"),
    # values
    ("set Dimension = 2", "set Dimension = 4", "4 is not allowed.*2 or 3"),
    ("set Dimension = 2", "set Dimension = 3", "2 components in 3D",
     "set Shift"),
    ("per direction = 2", "per direction = -1", "'-1' is not allowed.*from 0"),
    ("per direction = 2", "per direction = two", "'two' is not allowed"),
    ("set Density = 1000", "set Density = 0", "density of body 'bar' is 0"),
    ("set Density = 1000", "set Density = -1", "'-1' is not allowed"),
    ("set Density = 1000", "", "density of body 'bar' is 0", ""),
    ("modulus = 90e6", "modulus = -1", "Young's modulus is -1"),
    ("set Young's modulus = 90e6", "", "Young's modulus has no default", ""),
    ("ratio = 0.3", "ratio = 0.5", "ratio is 0.5.*nu < 0.5"),
    ("0; -0.00981", "0; sin(x", "sin.x.*parenthesis"),
    ("0; -0.00981", "0; -9.81 * width", "width"),
    ("0; -0.00981", "-9.81", "1 components instead of 2"),
    ("0; -0.00981", "0; 0; -9.81", "3 components instead of 2"),
    ("Enforcement = projected penalty", "Enforcement = penlty",
     "'penlty' is not allowed.*mean 'penalty'"),
    ("Enforcement = projected penalty", "Enforcement = implicit boundary\n"
     "    set Superfluous constraints = remove", "cannot 'remove' constraints",
     "set Superfluous"),
    # meshes
    (MESH, MESH.replace("hyper_rectangle", "hyper_rectangel"),
     "no generator 'subdivided_hyper_rectangel'.*mean"),
    ("Arguments = 16, 4 : 0, 0 : 2, 0.5", "Arguments = 16, 4 : 2",
     "does not suit the generator.*corner : opposite corner"),
    ("Arguments = 16, 4 : 0, 0 : 2, 0.5", "Arguments = 16, 4 : 0, 0 : 0, 0.5",
     "'16, 4 : 0, 0 : 0, 0.5'|size 0"),
    ("Arguments = 16, 4", "Arguments = -16, 4", "cells"),
    (MESH + ", 4 : 0, 0 : 2, 0.5", "set File = nowhere.msh",
     "nowhere.msh' cannot be read"),
    (MESH + ", 4 : 0, 0 : 2, 0.5", "set File = unreadable.msh",
     "unreadable.msh' cannot be used.*Give a mesh"),
    (MESH + ", 4 : 0, 0 : 2, 0.5", "set File = bad_inputs_scene.prm",
     "does not end like a mesh file"),
    # places
    (CLAMP, "set Polyline = 9 9; 9 8", "'clamp' lies outside of the grid"),
    ("4 : 0, 0 : 2, 0.5", "4 : 0, 0 : 7, 0.5",
     "points of the body 'bar' lie outside of the grid.*Enlarge the grid",
     "Generator = subdivided_hyper_rectangle\n      "),
    (CLAMP, "set Constraint = slip\n    set Polyline = 0 0; 0 0.5", "normals of "
     "boundary 'clamp' point into the material.*Flip normal = true", ""),
    (CLAMP, "set Polyline = 1 0; 1 0", "'1 0; 1 0' has no length"),
    ("set Density", "set Initial stress = log(x - 5); 0; 0\n    set Density",
     "'Initial stress'.*has no finite value at", ""),
    ("set Point = 2, 0.5", "set Point = 2, 7", "no material.*probe 'tip'"),
    ("set Point = 2, 0.5", "set Point = 2", "'2' is no place.*2 numbers"),
    # what clashes, and what is missing
    (*NO_CLAMP, "no section|nothing holds the bodies", ""),
    ("set Names = tip\n  subsection tip",
     "set Names = centre\n  subsection centre", "has the name of the centre of mass"),
    (QUANTITY, "set Boundary = clamp\n    set Quantity = probe",
     "'Boundary' means nothing to the quantity 'probe'"),
    ("set Quantity = probe\n    set Point = 2, 0.5",
     "set Boundary = clam\n    set Quantity = reaction",
     "no boundary 'clam'.*mean 'clamp'"),
    (CLAMP, "set Value = 0; 0.01\n    " + CLAMP, "'Value' does not change.*0.01 . t"),
    (CLAMP, "set Rotation angle = 0.1\n    " + CLAMP, "angle' does not change"),
    (CLAMP, "set Rotation axis = 0, 0, 1\n    set Rotation angle = t\n    " + CLAMP,
     "in 2D has no other axis"),
    (CLAMP, "set Constraint = roller\n    " + CLAMP, "cannot be a 'roller'"),
    (CLAMP, "set Components = x\n    " + CLAMP, "'Components' is set though"),
    (CLAMP, "set Traction = 0; 1\n    " + CLAMP, "'Traction' is set though"),
    (CLAMP, "set Kind = conforming\n    " + CLAMP,
     "conforming boundaries have neither shape", CLAMP),
    (CLAMP, "set Boundary id = 3\n    " + CLAMP, "have no id"),
    (CLAMP, "set Rotation centre = 1, 1\n    " + CLAMP, "'Rotation centre'"),
    ("set Density", "set Initial velocity = 1; 0\n    set Density",
     "'Initial velocity'|quasi-static"),
    (CLAMP + CUT, "set Boundary id = 77\n    set Kind = conforming", "no part with id 77"),
    (CLAMP, "set Active from = 2\n    set Active until = 1\n    " + CLAMP,
     "ends before it begins", "set Active until"),
    (CLAMP, "set Active from = 5\n    " + CLAMP, "acts from 5 s on.*to 1 s"),
    (CLAMP, "set Active until = 0\n    " + CLAMP, "acts until 0 s"),
    (CLAMP + CUT, CLAMP + "\n    set Constraint = traction",
     "'clamp' has no traction.*Traction = 0; -1e3", ""),
    (CLAMP, "", "'clamp' has no shape", ""),
    (MESH, "set File = a.msh\n      " + MESH, "both a mesh file and", MESH),
    ("set Density", "set Outline = 0 0; 1 0; 1 1\n    set Density",
     "outline has no mesh"),
    ("set Density", "set Thickness = 0\n    set Density", "not allowed"),
    ("subsection Output", "subsection Time\n  set Step = 3\nend\n"
     "subsection Output", "step of 3 s is longer than the run", "set Step"),
    ("subsection Output", "subsection Time\n  set Step = 0,25\nend\n"
     "subsection Output", "'0,25' has a comma.*Write a decimal point: 0.25",
     "set Step"),
    ("subsection Output", "subsection Time\n  set Step = 0\nend\n"
     "subsection Output", "'0' is not allowed.*a number above 0", "set Step"),
    ("set Names = tip", "set Names = tip, tip", "name 'tip' occurs twice"),
]

SCENE = "bad_inputs_scene.prm"
COMMANDS = [
    ([], "no scene is given.*impoint SCENE.prm"),
    ([SCENE, "--set", "Time.Step=1"], "no entry 'Time.Step'.*Write 'Time/Step'"),
    ([SCENE, "--set", "Boundaries/clamp.Rule=cut"],
     "Write 'Boundaries/clamp/Rule'"),
    ([SCENE, "--set", "Bodies.bar/Density=1"], "Write 'Bodies/bar'"),
    (["nowhere.prm"], "nowhere.prm' cannot be read"),
    (["."], "is a folder"),
    (["long" * 100 + ".prm"], "cannot be looked for: File name too long"),
    (["loop.prm"], "cannot be looked for: Too many levels"),
    ([SCENE, "--output", "kept", "--overwrite"],
     "kept' cannot be prepared: .*csv' says: Directory not empty"),
    ([SCENE, SCENE], "a second scene"),
    ([SCENE, "--overwite"], "no option '--overwite'.*mean '--overwrite'"),
    ([SCENE, "--set"], "nothing follows '--set'"),
    ([SCENE, "--set", "Time/Step"], "not an entry and a value.*Time/Step"),
    ([SCENE, "--set", "Time/Stp = 1"], "no entry 'Stp'.*--set.*mean 'Step'"),
    ([SCENE, *[word for entry in (
        "Bodies/bar/Material/Model = von Mises",
        "Bodies/bar/Material/Yield stress = 1e5",
        "Boundaries/clamp/Enforcement = nitsche",
        "Boundaries/clamp/Nitsche form = symmetric") for word in ("--set", entry)]],
     "symmetric form.*plastic material.*Nitsche form = incomplete"),
    ([SCENE, *[word for entry in (
        "Grid/Basis = quadratic", "Time/Kind = dynamic",
        "Time/Mass = lumped") for word in ("--set", entry)]],
     "lumped masses of a 'quadratic' basis.*Mass = consistent"),
    ([SCENE, *[word for entry in (
        "Grid/Basis = quadratic", "Time/Kind = dynamic",
        "Grid/Reset = every step") for word in ("--set", entry)]],
     "'quadratic' basis in motion on a grid that is reset.*Reset = never"),
    ([SCENE, "--check", "--help"], "exclude each other"),
    ([SCENE, "--output", "unreadable.msh"], "unreadable.msh' is a file"),
    ([SCENE, "--output", "/proc/impoint"], "/proc/impoint' cannot be"),
    ([SCENE, "--check", "--output", "/proc/impoint"], "/proc/impoint' cannot be"),
    ([SCENE, "--check", "--output", "full"], "already holds"),
    ([SCENE, "--check", "--set", "Time/Smallest step = 0"], "from 1e-12 to 1"),
    ([SCENE, "--check", "--set", "Time/Step = 1e-12"], "more than 1e9"),
    ([SCENE, "--check", "--set", "Grid/Refinements = 20"],
     "20 refinements make 3.3e\\+13 cells.*at most 1[0-3]"),
    ([SCENE, "--check", "--set", "Grid/Arguments = 30000, 30000000 : 0, 0 : 1, 1"],
     "makes 9e\\+11 cells, more than this machine can hold"),
    ([SCENE, "--check", "--set", "Measurements/Names = tip, clamp",
      "--set", "Measurements/clamp/Quantity = reaction",
      "--set", "Measurements/clamp/Boundary = clamp"], "has a boundary's name"),
    ([SCENE, "--check", "--set", "Measurements/Names = tip, mass",
      "--set", "Measurements/mass/Quantity = slope",
      "--set", "Measurements/mass/Direction = 1, 0"], "'mass' occurs twice"),
    (["number#1/scene.prm"], "no scene file can hold the path.*without '#'"),
    (["--resume", "full"], "not the output folder of a run.*no parameters.prm"),
    (["--resume", "full", SCENE], "'--resume' and the scene.*exclude each"),
    (["--resume", "full", "--overwrite"], "'--overwrite' exclude each other"),
    (["--resume", "full", "--check"], "'--check' exclude each other"),
    ([SCENE, "--output", "full"], "already holds.*--output.*--overwrite"),
    (["rerun/parameters.prm"], "already holds.*--output.*--overwrite"),
]
