#include <impoint/base/parameter_file.h>
#include <impoint/measurements/quantities.h>

#include <algorithm>
#include <cctype>

namespace Impoint
{
  namespace
  {
    using Names = std::vector<std::string>;
    using Measurements::Quantity;

    /** What @p text makes of each quantity, joined; empty parts left out. */
    template <typename Text>
    std::string join(const std::string &separator, const Text &text)
    {
      Names parts;
      for (const Quantity &quantity : Measurements::quantities())
        if (const std::string part = text(quantity); !part.empty())
          parts.push_back(part);
      return Words::join(parts, separator);
    }



    /** The quantities that look at @p entry: "Path, run-out". */
    std::string users_of(const std::string &entry)
    {
      std::string names = join(", ", [&](const Quantity &quantity) {
        return quantity.uses(entry) ? quantity.name : "";
      });
      names[0]          = std::toupper(names[0]);
      return names;
    }
  } // namespace



  void MeasurementParameters::declare(ParameterFile     &file,
                                      const std::string &measurement)
  {
    name    = measurement;
    section = "Measurements/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Measurements");
    prm.enter_subsection(name);
    prm.add_parameter("Quantity",
                      quantity,
                      join("; ",
                           [](const Quantity &row) {
                             return row.name + ": " + row.help;
                           }) +
                        ".",
                      Patterns::Selection(join("|", [](const Quantity &row) {
                        return row.name;
                      })));
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
                      users_of("Boundary") + ": name of the boundary.");
    prm.add_parameter(
      "Point",
      point,
      "Probe: place at the start [m]; reaction and "
      "momentum: point about which the moment is; errors: origin of the frame "
      "('Frame angle'). Empty: the origin.",
      numbers);
    prm.add_parameter("Direction",
                      direction,
                      users_of("Direction") + ": direction, of any length.",
                      numbers);
    prm.add_parameter("Axis",
                      axis,
                      users_of("Axis") + " in 3D: axis of the angle; empty: z.",
                      numbers);
    prm.declare_entry(
      "Reference",
      "",
      Patterns::Anything(),
      "What the results should be, in their order (" +
        join(". ",
             [](const Quantity &row) {
               return row.reference.empty() ? "" :
                                              row.name + ": " + row.reference;
             }) +
        "): expressions of t separated by ';', in the results' units; 'none' "
        "or nothing: no reference.");
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
    const Quantity &chosen = Measurements::quantity(quantity);
    if (dim == 2)
      chosen.functions<2>().check(file, *this);
    else
      chosen.functions<3>().check(file, *this);
  }



  // The parameters of a run, written down to repeat it, set all entries.
  void MeasurementParameters::check_unused(const ParameterFile &file) const
  {
    ParameterFile         untouched;
    MeasurementParameters defaults;
    defaults.declare(untouched, name);
    const Quantity &chosen = Measurements::quantity(quantity);
    for (const Quantity &other : Measurements::quantities())
      for (const auto &entry : other.entries)
        {
          const std::string path = section + "/" + entry;
          if (!chosen.uses(entry) && file.value(path) != untouched.value(path))
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
                             const Names       &names) {
      if (std::count(names.begin(), names.end(), value) == 0)
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
    if (!Measurements::quantity(quantity).uses("Boundary"))
      return;
    if (boundary.empty())
      throw file.error(section + "/Boundary",
                       "no boundary is named",
                       "Set 'Boundary' to one of 'Names' in section "
                       "'Boundaries'.");
    require("Boundary", boundary, file.names("Boundaries/Names"));
  }



  void MeasurementParameters::require_boundary_particles(
    const ParameterFile &file) const
  {
    if (file.value("Boundaries/" + boundary + "/Kind") == "conforming")
      throw file.error(section + "/Boundary",
                       "'" + boundary +
                         "' is conforming and has no boundary particles",
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
    check_size("Point", point, false);
    check_size("Direction",
               direction,
               Measurements::quantity(quantity).uses("Direction"));
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
  }
} // namespace Impoint
