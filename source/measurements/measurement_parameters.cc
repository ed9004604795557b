#include <impoint/base/parameter_file.h>
#include <impoint/measurements/measurement_parameters.h>
#include <impoint/measurements/named_values.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  namespace
  {
    using EntryNames = std::vector<std::string>;

    const EntryNames field_entries = {"Body",
                                      "Exact",
                                      "Position",
                                      "Norm",
                                      "Component",
                                      "Frame angle",
                                      "Point",
                                      "Scale"};

    /** The entries that each quantity looks at, besides those of all. */
    const std::map<std::string, EntryNames> used_entries = {
      {"probe", {"Point", "Reference"}},
      {"reaction", {"Boundary", "Point", "Reference"}},
      {"impulse", {"Boundary", "Reference"}},
      {"displacement error", field_entries},
      {"velocity error", field_entries},
      {"stress error", field_entries},
      {"path", {"Body", "Direction", "Axis", "Reference"}},
      {"penetration", {"Boundary", "Body"}},
      {"run-out", {"Body", "Direction", "Reference"}},
      {"slope", {"Body", "Direction", "Axis", "Reference"}},
      {"energy", {"Reference"}},
      {"newton", {}}};

    bool is_one_of(const std::string &name, const EntryNames &names)
    {
      return std::find(names.begin(), names.end(), name) != names.end();
    }

    std::string names_of_quantities()
    {
      EntryNames names;
      for (const auto &quantity : used_entries)
        names.push_back(quantity.first);
      return Words::join(names, "|");
    }
  } // namespace



  std::vector<std::string>
  Measurements::field_components(const std::string &quantity,
                                 const unsigned int dim)
  {
    if (quantity != "stress error")
      return dim == 2 ? EntryNames{"x", "y"} : EntryNames{"x", "y", "z"};
    return dim == 2 ? EntryNames{"xx", "yy", "xy", "zz"} :
                      EntryNames{"xx", "yy", "zz", "xy", "xz", "yz"};
  }



  void MeasurementParameters::declare(ParameterFile     &file,
                                      const std::string &measurement)
  {
    name    = measurement;
    section = "Measurements/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Measurements");
    prm.enter_subsection(name);
    prm.add_parameter(
      "Quantity",
      quantity,
      "probe: displacement [m] of a place that rides along with the material; "
      "reaction: force [N] and moment [Nm] of a boundary on the material; "
      "impulse: the force's integral over time [Ns]; displacement, velocity, "
      "stress error: of the material points against exact values; path: way "
      "[m] of the centre of mass along a direction and the body's angle [rad]; "
      "penetration: largest depth of points behind a boundary, in cell sizes; "
      "run-out: furthest coordinate [m] in a direction, of all and of 99 % of "
      "the mass; slope: of the surface along a direction [degrees], as where "
      "sand rests; energy: kinetic, strain, and their sum [J]; newton: "
      "iterations and order of convergence.",
      Patterns::Selection(names_of_quantities()));
    declare_object(file);
    declare_field(file);
    prm.add_parameter("Until",
                      until,
                      "Time [s] after which nothing more is measured.",
                      Patterns::Double());
    prm.leave_subsection();
    prm.leave_subsection();
  }



  void MeasurementParameters::declare_object(ParameterFile &file)
  {
    const Patterns::List numbers(Patterns::Double(), 0, 3);
    auto                &prm = file.handler();
    prm.add_parameter("Body",
                      body,
                      "Body whose points are looked at; empty: all.");
    prm.add_parameter("Boundary",
                      boundary,
                      "Reaction, impulse, penetration: name of the boundary.");
    prm.add_parameter("Point",
                      point,
                      "Probe: place at the start [m]; reaction: point about "
                      "which the moment is; errors: origin of the frame "
                      "('Frame angle'). Empty: the origin.",
                      numbers);
    prm.add_parameter("Direction",
                      direction,
                      "Path, run-out, slope: direction, of any length.",
                      numbers);
    prm.add_parameter("Axis",
                      axis,
                      "Path, slope in 3D: axis of the angle; empty: z.",
                      numbers);
    prm.declare_entry(
      "Reference",
      "",
      Patterns::Anything(),
      "What the results should be, in their order (probe: u_x; u_y; u_z. "
      "reaction: F_x; F_y; F_z; M_x; M_y; M_z, in 2D F_x; F_y; M_z. impulse: I_x; I_y; I_z. path: "
      "path; angle. run-out: furthest; 99 %. slope: the angle. energy: kinetic; strain; total): "
      "expressions of t separated by ';', in the results' units; 'none' or "
      "nothing: no reference.");
  }



  void MeasurementParameters::declare_field(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.declare_entry("Exact",
                      "",
                      Patterns::Anything(),
                      "Errors: exact values [m, m/s, Pa], expressions of x, "
                      "y(, z), t separated by ';'; stresses (Cauchy, tension "
                      "positive) xx; yy; xy or xx; yy; xy; zz in 2D, xx; yy; "
                      "zz; xy; xz; yz in 3D. One expression is enough if "
                      "'Component' chooses one.");
    prm.add_parameter("Position",
                      position,
                      "Errors: which place x, y(, z) in 'Exact' are.",
                      Patterns::Selection("initial|current"));
    prm.add_parameter(
      "Norm",
      norm,
      "Errors: 'volume mean': mean over the volume of each point's relative "
      "error (I Eqs. 29-30), 'L2': root of the squared error's integral over "
      "that of the squared exact value, 'maximum': largest error over the "
      "largest exact value. Volumes are those at the start. A component whose "
      "exact value is zero is divided by the whole vector's or tensor's norm; "
      "where all is zero, the error is absolute.",
      Patterns::Selection("volume mean|L2|maximum"));
    prm.add_parameter("Component",
                      component,
                      "Errors: 'norm' of the vector or tensor, 'all' "
                      "components one by one, or one of them.",
                      Patterns::Selection("norm|all|x|y|z|xx|yy|zz|xy|xz|yz"));
    prm.add_parameter(
      "Frame angle",
      frame_angle,
      "Errors: angle about z [degrees] of the frame in which components, the "
      "exact values and their x, y(, z) are; its origin is 'Point'.",
      Patterns::Double());
    prm.add_parameter("Scale",
                      scale,
                      "Errors: divide by this number [m, m/s, Pa] instead of "
                      "exact values; 0: by exact values.",
                      Patterns::Double(0));
  }



  void MeasurementParameters::check(const ParameterFile &file,
                                    const unsigned int   dim) const
  {
    check_unused(file);
    check_members(file);
    check_places(file, dim);
    if (is_one_of("Exact", used_entries.at(quantity)))
      check_field(file, dim);
  }



  // The parameters of a run, written down to repeat it, set all entries.
  void MeasurementParameters::check_unused(const ParameterFile &file) const
  {
    ParameterFile         untouched;
    MeasurementParameters defaults;
    defaults.declare(untouched, name);
    for (const auto &[other, entries] : used_entries)
      for (const auto &entry : entries)
        {
          const std::string path = section + "/" + entry;
          if (!is_one_of(entry, used_entries.at(quantity)) &&
              file.value(path) != untouched.value(path))
            throw file.error(path,
                             "'" + entry + "' means nothing to the quantity '" +
                               quantity + "'",
                             "Take the entry away, or set another 'Quantity'.");
        }
  }



  void MeasurementParameters::check_members(const ParameterFile &file) const
  {
    const auto require = [&](const std::string &entry,
                             const std::string &value,
                             const EntryNames  &names) {
      if (!is_one_of(value, names))
        throw file.error(section + "/" + entry,
                         "the scene has no " +
                           std::string(entry == "Body" ? "body" : "boundary") +
                           " '" + value + "'",
                         names.empty() ?
                           "Name one in the scene first." :
                           Words::suggestion(value, names, "There are"));
    };
    if (!body.empty())
      require("Body", body, file.names("Bodies/Names"));
    if (quantity == "probe" && name == "centre")
      throw file.error("Measurements/Names",
                       "the probe 'centre' has the name of the centre of mass",
                       "Give it another one: history.csv has columns 'centre "
                       "x' already.");
    if (!is_one_of("Boundary", used_entries.at(quantity)))
      return;
    if (boundary.empty())
      throw file.error(section + "/Boundary",
                       "no boundary is named",
                       "Set 'Boundary' to one of 'Names' in section "
                       "'Boundaries'.");
    require("Boundary", boundary, file.names("Boundaries/Names"));
    if (quantity == "reaction" &&
        is_one_of(name, file.names("Boundaries/Names")))
      throw file.error("Measurements/Names",
                       "the reaction '" + name + "' has a boundary's name",
                       "Give it another one: history.csv has columns '" + name +
                         " F_x' of the boundary already.");
    if (quantity == "penetration" &&
        file.value("Boundaries/" + boundary + "/Kind") == "conforming")
      throw file.error(section + "/Boundary",
                       "'" + boundary +
                         "' is conforming, which no point can "
                         "cross",
                       "Name a nonconforming boundary.");
  }



  void MeasurementParameters::check_places(const ParameterFile &file,
                                           const unsigned int   dim) const
  {
    const auto check_size = [&](const std::string         &entry,
                                const std::vector<double> &numbers,
                                const bool                 required) {
      if (numbers.size() != dim && (required || !numbers.empty()))
        throw file.error(section + "/" + entry,
                         "'" + file.value(section + "/" + entry) +
                           "' is no place or "
                           "direction in " +
                           std::to_string(dim) + "D",
                         "Give " + std::to_string(dim) +
                           " numbers, separated by commas.");
    };
    const bool has_direction =
      is_one_of("Direction", used_entries.at(quantity));
    check_size("Point", point, quantity == "probe");
    check_size("Direction", direction, has_direction);
    if (dim == 2 && !axis.empty())
      throw file.error(section + "/Axis",
                       "an axis is set in 2D",
                       "Take the entry away.");
    check_size("Axis", axis, false);

    const auto check_length = [&](const std::string         &entry,
                                  const std::vector<double> &numbers) {
      if (!numbers.empty() &&
          std::all_of(numbers.begin(), numbers.end(), [](const double number) {
            return number == 0;
          }))
        throw file.error(section + "/" + entry,
                         "all components are zero",
                         "Give a direction, e.g. 1, 0.");
    };
    check_length("Direction", direction);
    check_length("Axis", axis);
    if (dim == 3 && quantity == "slope" &&
        cross_product_3d(Measurements::to_vector<3>(direction),
                         axis.empty() ? Tensor<1, 3>({0, 0, 1}) :
                                        Measurements::to_vector<3>(axis))
            .norm() == 0)
      throw file.error(section + "/Axis",
                       "the direction of a slope is along its axis",
                       "Give the horizontal axis across the direction.");
  }



  void MeasurementParameters::check_field(const ParameterFile &file,
                                          const unsigned int   dim) const
  {
    if (file.value(section + "/Exact").empty())
      throw file.error(section + "/Exact",
                       "an error needs exact values",
                       "Set expressions of x, y(, z), t separated by ';'.");
    const auto components = Measurements::field_components(quantity, dim);
    if (component != "norm" && component != "all" &&
        !is_one_of(component, components))
      throw file.error(section + "/Component",
                       "'" + component + "' is no component of the field",
                       "Set norm, all, or one of " +
                         Words::join(components, ", ") + ".");
  }
} // namespace Impoint
