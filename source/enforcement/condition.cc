#include <impoint/base/parameter_file.h>
#include <impoint/enforcement/kinds.h>

#include <deal.II/physics/transformations.h>

namespace Impoint
{
  using Enforcement::TractionFrom;

  bool ConditionParameters::has_multipliers() const
  {
    return Enforcement::kind(enforcement).traction == TractionFrom::multipliers;
  }



  bool ConditionParameters::carries_material() const
  {
    return constraint != Constraint::traction &&
           Enforcement::kind(enforcement).traction == TractionFrom::material;
  }



  bool ConditionParameters::is_two_sided() const
  {
    const auto from_what = Enforcement::kind(enforcement).traction;
    return constraint == Constraint::traction ||
           (constraint == Constraint::fixed &&
            (from_what == TractionFrom::gap ||
             from_what == TractionFrom::multipliers));
  }



  void ConditionParameters::declare(ParameterFile     &file,
                                    const std::string &boundary_name)
  {
    name      = boundary_name;
    section   = "Boundaries/" + name;
    auto &prm = file.handler();
    prm.enter_subsection("Boundaries");
    prm.enter_subsection(name);
    std::vector<std::string> names, helps;
    for (const auto &row : Enforcement::kinds())
      {
        names.push_back(row.name);
        helps.push_back(row.name + ": " + row.help);
      }
    prm.add_choice("Constraint",
                   constraint,
                   "fixed: the whole displacement is prescribed; slip: its "
                   "normal part; roller: the listed components (conforming "
                   "only); traction: a load instead of a displacement.",
                   {{"fixed", Constraint::fixed},
                    {"slip", Constraint::slip},
                    {"roller", Constraint::roller},
                    {"traction", Constraint::traction}});
    prm.add_parameter("Components",
                      components,
                      "Components that a roller holds: x, y, z, separated by "
                      "commas.",
                      Patterns::List(Patterns::Selection("x|y|z"), 0, 3));
    prm.add_parameter("Enforcement",
                      enforcement,
                      "Method of a nonconforming boundary. " +
                        Words::join(helps, "; ") + ".",
                      Patterns::Selection(Words::join(names, "|")));
    declare_factors(prm);
    prm.add_choice(
      "Normals",
      normals,
      "Normals of a slip condition: each particle's own, or "
      "averaged at the nodes (P Eq. 54); automatic: nodal where "
      "the particles' normals differ, but particle where a cell has one mean "
      "gap of its own ('projected penalty', multipliers that are not shared).",
      {{"automatic", Normals::automatic},
       {"particle", Normals::particle},
       {"nodal", Normals::nodal}});
    prm.add_parameter(
      "Releasing",
      releasing,
      "The boundary presses but does not pull: contact with a "
      "wall (P Eq. 55). A fixed one sticks while it presses, by "
      "at most ten times the pressure.",
      Patterns::Bool());
    prm.add_parameter("Friction coefficient",
                      friction,
                      "Coulomb friction of a slip boundary [-].",
                      Patterns::Double(0.));
    declare_motion(prm);
    prm.leave_subsection();
    prm.leave_subsection();
  }



  /** What the methods look at, each on its own. */
  void ConditionParameters::declare_factors(EntryHandler &prm)
  {
    prm.add_parameter(
      "Penalty factor",
      factor,
      "Penalty factor beta, in the unit below. The augmented Lagrangian "
      "takes it for a whole cut cell and more for smaller pieces.",
      Patterns::Double(1e-300));
    prm.add_choice(
      "Penalty unit",
      factor_is_absolute,
      "E/h: beta is a multiple of Young's modulus over the cell "
      "size (of the material in or near the cell); Pa/m: absolute.",
      {{"E/h", false}, {"Pa/m", true}});
    prm.add_choice(
      "Superfluous constraints",
      superfluous,
      "Multipliers of more cells than displacements can follow oscillate: keep "
      "all; share one among neighbours until it has 0.4 h^(dim-1) of the "
      "boundary (simplices: 1); remove superfluous ones (L Section 3.2.2); or "
      "stabilise all by a penalty on their jumps, which leaves gaps of "
      "O(h^2). An implicit boundary keeps the gap of each particle, or shares "
      "means. automatic: share by 'lagrange multiplier' and 'augmented "
      "Lagrangian', and by 'implicit boundary' where it is not along faces or "
      "directions of the cell; else keep.",
      {{"automatic", Superfluous::automatic},
       {"keep", Superfluous::keep},
       {"remove", Superfluous::remove},
       {"share", Superfluous::share},
       {"stabilise", Superfluous::stabilise}});
    prm.add_parameter("Jump penalty",
                      jump_penalty,
                      "Of stabilised multipliers: compliance of the jump "
                      "between neighbouring cells, in units of h^dim / E.",
                      Patterns::Double(1e-6, 1e3));
    prm.add_parameter("Band width",
                      band_width,
                      "Width delta of the band of an implicit boundary, in "
                      "units of the cell size h.",
                      Patterns::Double(1e-12, 1.));
    prm.add_parameter("Nitsche factor",
                      nitsche_factor,
                      "Penalty of Nitsche's method in units of n.C.n / h; h at "
                      "most the width of the material in the cell. 0: 10, 20, "
                      "45 for functions of degree 1, 2, 3.",
                      Patterns::Double(0));
    prm.add_choice("Nitsche form",
                   nitsche_form,
                   "symmetric: the forces have a potential; non-symmetric: "
                   "bears any factor, but is less accurate and needs an "
                   "unsymmetric solver; incomplete: without the terms that "
                   "weigh the gap by the material's tangent, which jumps "
                   "where material yields. automatic: incomplete if a "
                   "material is plastic, else symmetric.",
                   {{"automatic", NitscheForm::automatic},
                    {"symmetric", NitscheForm::symmetric},
                    {"non-symmetric", NitscheForm::non_symmetric},
                    {"incomplete", NitscheForm::incomplete}});
    prm.add_parameter(
      "Small-cut rule",
      small_cut_rule,
      "Raise small shape values to 0.01 in the penalty (P Eq. "
      "53). It breaks linear reproduction: only to reproduce the "
      "paper.",
      Patterns::Bool());
  }



  /** What is prescribed, and when. */
  void ConditionParameters::declare_motion(EntryHandler &prm)
  {
    prm.declare_entry(
      "Value",
      "",
      Patterns::Anything(),
      "Prescribed displacement [m] since t = 0 (what it is then "
      "is taken off) or velocity [m/s]: expressions of x, y, "
      "(z,) t separated by ';', of the place at the start of "
      "the run; empty: none.");
    prm.add_choice("Value is",
                   value_is_velocity,
                   "What 'Value' means.",
                   {{"displacement", false}, {"velocity", true}});
    prm.declare_entry("Rotation angle",
                      "",
                      Patterns::Anything(),
                      "Angle [rad] by which the boundary has turned at time t, "
                      "an expression of t; empty: none.");
    prm.add_parameter("Rotation centre",
                      rotation_centre,
                      "A point of the axis of rotation [m].",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.add_parameter("Rotation axis",
                      rotation_axis,
                      "3D: direction of the axis of rotation.",
                      Patterns::List(Patterns::Double(), 0, 3));
    prm.add_choice(
      "Moves",
      motion,
      "How the particles move: with the value that they "
      "prescribe, with the material that they hold, or not; "
      "automatic: a traction and a flat slip boundary by 'nitsche' with the "
      "material, others with the value.",
      {{"automatic", Moves::automatic},
       {"with the value", Moves::with_value},
       {"with the material", Moves::with_material},
       {"not", Moves::never}});
    prm.declare_entry("Traction",
                      "",
                      Patterns::Anything(),
                      "Load per area at the start [Pa] of a traction boundary: "
                      "expressions of x, y, (z,) t separated by ';'.");
    prm.add_parameter("Active from",
                      from,
                      "Time from which the boundary acts [s].",
                      Patterns::Double());
    prm.add_parameter("Active until",
                      until,
                      "Time until which the boundary acts [s].",
                      Patterns::Double());
  }



  void ConditionParameters::check(const ParameterFile &file,
                                  const unsigned int   dim,
                                  const bool           conforming) const
  {
    const auto clash = [&](const std::string &entry,
                           const std::string &wrong,
                           const std::string &advice) {
      throw file.error(section + "/" + entry, wrong, advice);
    };
    if (constraint == Constraint::roller && !conforming)
      clash("Constraint",
            "a nonconforming boundary cannot be a 'roller'",
            "Use 'slip', which holds the component along the normal.");
    if (constraint == Constraint::roller && components.empty())
      clash("Components",
            "a roller holds no component",
            "Set Components = x (or y, z).");
    check_unused(file, conforming);
    if (Enforcement::kind(enforcement).traction == TractionFrom::functions &&
        (superfluous == Superfluous::remove ||
         superfluous == Superfluous::stabilise))
      clash("Superfluous constraints",
            "an implicit boundary cannot '" +
              file.value(section + "/Superfluous constraints") +
              "' constraints",
            "Set 'share', 'keep' (the gap of each particle, as in paper I) or "
            "'automatic'.");
    if (until <= from)
      clash("Active until",
            "the boundary ends before it begins",
            "Set 'Active until' later than 'Active from'.");
    if (!rotation_centre.empty() && rotation_centre.size() != dim)
      clash("Rotation centre",
            "the centre has " + std::to_string(rotation_centre.size()) +
              " coordinates in " + std::to_string(dim) + "D",
            "Give " + std::to_string(dim) + " numbers.");
    if (dim == 2 && !rotation_axis.empty())
      clash("Rotation axis",
            "a rotation in 2D has no other axis than z",
            "Remove the entry: it would have no effect.");
    if (dim == 3 && file.is_set(section + "/Rotation angle") &&
        rotation_axis.size() != 3)
      clash("Rotation axis",
            "a rotation in 3D needs an axis",
            "Give its direction, e.g. Rotation axis = 0, 0, 1.");
  }



  /** Refuses entries that the boundary, as it is, would not look at. */
  void ConditionParameters::check_unused(const ParameterFile &file,
                                         const bool           conforming) const
  {
    const bool        traction = constraint == Constraint::traction;
    const bool        turns    = file.is_set(section + "/Rotation angle");
    const std::string kind =
      conforming ?
        "the boundary is conforming" :
        "the constraint is '" + file.value(section + "/Constraint") + "'";
    const auto refuse = [&](const bool                      unused,
                            const std::vector<std::string> &entries,
                            const std::string              &reason) {
      for (const std::string &entry : entries)
        if (unused && file.is_set(section + "/" + entry))
          throw file.error(section + "/" + entry,
                           "'" + entry + "' is set though " + reason,
                           "Remove the entry: it would have no effect.");
    };
    refuse(constraint != Constraint::roller, {"Components"}, kind);
    refuse(!traction, {"Traction"}, kind);
    refuse(traction, {"Value", "Rotation angle"}, kind + ": see 'Traction'");
    refuse(conforming || traction,
           {"Enforcement",
            "Penalty factor",
            "Penalty unit",
            "Superfluous constraints",
            "Jump penalty",
            "Band width",
            "Nitsche factor",
            "Nitsche form",
            "Small-cut rule"},
           kind);
    // What only another enforcement looks at stays: the enforcement of a scene
    // is changed in one line.
    refuse(conforming || traction, {"Releasing"}, kind);
    refuse(constraint != Constraint::slip || conforming,
           {"Friction coefficient"},
           kind);
    const auto from_what = Enforcement::kind(enforcement).traction;
    refuse(from_what == TractionFrom::functions ||
             from_what == TractionFrom::material,
           {"Releasing", "Friction coefficient"},
           "'Enforcement' is '" + enforcement + "', which always holds");
    refuse(superfluous != Superfluous::stabilise,
           {"Jump penalty"},
           "'Superfluous constraints' is not 'stabilise'");
    refuse(constraint != Constraint::slip || conforming, {"Normals"}, kind);
    refuse(conforming, {"Moves", "Rotation angle"}, kind);
    refuse(!turns,
           {"Rotation centre", "Rotation axis"},
           "'Rotation angle' is not");
    refuse(!file.is_set(section + "/Value"), {"Value is"}, "'Value' is not");
  }



  template <int dim>
  PrescribedMotion<dim>::PrescribedMotion(const ParameterFile       &file,
                                          const ConditionParameters &parameters)
    : value(file, parameters.section + "/Value", dim)
    , angle(file, parameters.section + "/Rotation angle", 1)
    , is_velocity(parameters.value_is_velocity)
  {
    for (unsigned int d = 0; d < parameters.rotation_centre.size(); ++d)
      centre[d] = parameters.rotation_centre[d];
    for (unsigned int d = 0; d < parameters.rotation_axis.size(); ++d)
      axis[d] = parameters.rotation_axis[d];
    if (axis.norm() > 0)
      axis /= axis.norm();
    const auto refuse_steady = [&](const Expression<dim> &motion,
                                   const std::string     &entry,
                                   const std::string     &example) {
      if (motion.is_steady() && !motion.is_zero())
        throw file.error(parameters.section + "/" + entry,
                         "'" + entry +
                           "' does not change with the time t: as it counts "
                           "from t = 0, the boundary would not move",
                         "Let it grow, such as '" + example +
                           "', or remove the entry.");
    };
    if (!is_velocity)
      refuse_steady(value, "Value", "0.01 * t");
    refuse_steady(angle, "Rotation angle", "0.1 * t");
  }



  template <int dim>
  Tensor<2, dim> PrescribedMotion<dim>::rotation(const double start,
                                                 const double end) const
  {
    const double turn =
      angle.value(centre, end, 0) - angle.value(centre, start, 0);
    if constexpr (dim == 2)
      return Physics::Transformations::Rotations::rotation_matrix_2d(turn);
    else
      return Physics::Transformations::Rotations::rotation_matrix_3d(
        Point<3>(axis), turn);
  }



  template <int dim>
  Tensor<1, dim> PrescribedMotion<dim>::increment(const Point<dim> &x,
                                                  const Point<dim> &first,
                                                  const double      start,
                                                  const double      end) const
  {
    Tensor<1, dim> result;
    if (is_velocity)
      {
        // Simpson's rule is exact for velocities cubic in time.
        result = (end - start) / 6. *
                 (value.vector(first, start) +
                  4. * value.vector(first, 0.5 * (start + end)) +
                  value.vector(first, end));
      }
    else if (!value.is_zero())
      result = value.vector(first, end) - value.vector(first, start);
    if (rotates())
      result += rotation(start, end) * (x - centre) - (x - centre);
    return result;
  }

  template class PrescribedMotion<2>;
  template class PrescribedMotion<3>;
} // namespace Impoint
