#include <impoint/measurements/body_path.h>
#include <impoint/measurements/condition.h>
#include <impoint/measurements/convergence.h>
#include <impoint/measurements/energy.h>
#include <impoint/measurements/field_error.h>
#include <impoint/measurements/impulse.h>
#include <impoint/measurements/momentum.h>
#include <impoint/measurements/penetration.h>
#include <impoint/measurements/probe.h>
#include <impoint/measurements/quantities.h>
#include <impoint/measurements/reaction.h>
#include <impoint/measurements/run_out.h>
#include <impoint/measurements/surface_slope.h>

#include <algorithm>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      template <typename Class, int dim>
      QuantityFunctions<dim> functions_of()
      {
        return {&Class::check,
                [](const ParameterFile         &file,
                   const MeasurementParameters &parameters)
                  -> std::unique_ptr<Measurement<dim>> {
                  return std::make_unique<Class>(file, parameters);
                }};
      }



      /** The row of a class. */
      template <template <int> class Class>
      Quantity row(const std::string              &name,
                   const std::string              &help,
                   const std::vector<std::string> &entries,
                   const std::string              &reference = "")
      {
        return {name,
                help,
                entries,
                reference,
                {functions_of<Class<2>, 2>(), functions_of<Class<3>, 3>()}};
      }
    } // namespace



    bool Quantity::uses(const std::string &entry) const
    {
      return std::find(entries.begin(), entries.end(), entry) != entries.end();
    }



    const std::vector<Quantity> &quantities()
    {
      static const std::vector<std::string> of_errors = {"Body",
                                                         "Exact",
                                                         "Position",
                                                         "Norm",
                                                         "Component",
                                                         "Frame angle",
                                                         "Point",
                                                         "Scale"};
      static const std::vector<Quantity>    table     = {
               row<Probe>("probe",
                   "displacement [m] of a place that rides along with the "
                          "material",
                   {"Point", "Reference"},
                   "u_x; u_y; u_z"),
               row<Reaction>("reaction",
                      "force [N] and moment [Nm] of a boundary on the material",
                      {"Boundary", "Point", "Reference"},
                      "F_x; F_y; F_z; M_x; M_y; M_z, in 2D F_x; F_y; M_z"),
               row<Impulse>("impulse",
                     "a boundary's force on the material, integrated over time "
                            "[Ns]",
                     {"Boundary", "Reference"},
                     "I_x; I_y; I_z"),
               row<Momentum>("momentum",
                      "of all material points [kg m/s], and angular momentum "
                             "[kg m2/s]",
                      {"Point", "Reference"},
                      "p_x; p_y; p_z; L_x; L_y; L_z, in 2D p_x; p_y; L_z"),
               row<FieldError>("displacement error",
                        "of the material points against exact values",
                        of_errors),
               row<FieldError>("velocity error", "the same", of_errors),
               row<FieldError>("stress error", "the same", of_errors),
               row<BodyPath>("path",
                      "way [m] of the centre of mass along a direction and the "
                             "body's angle [rad]",
                      {"Body", "Direction", "Axis", "Reference"},
                      "path; angle"),
               row<Penetration>("penetration",
                         "largest depth of points behind a boundary, in cell "
                                "sizes",
                         {"Boundary", "Body"}),
               row<RunOut>(
          "run-out",
          "furthest coordinate [m] in a direction, of all and of 99 % "
                 "of the mass",
          {"Body", "Direction", "Reference"},
          "furthest; 99 %"),
               row<SurfaceSlope>(
          "slope",
          "of the surface along a direction [degrees], as where "
                 "sand rests",
          {"Body", "Direction", "Axis", "Reference"},
          "the angle"),
               row<Energy>("energy",
                    "kinetic, strain, and their sum [J]",
                    {"Reference"},
                    "kinetic; strain; total"),
               row<Convergence>("newton", "iterations and order of convergence", {}),
               row<Condition>(
          "condition",
          "number of the matrix that was solved with, and with its "
                 "diagonal scaled to one; costs tens of solves a step",
          {"Reference"},
          "the number; scaled")};
      return table;
    }



    const Quantity &quantity(const std::string &name)
    {
      for (const Quantity &row : quantities())
        if (row.name == name)
          return row;
      AssertThrow(false, ExcMessage("No quantity is called '" + name + "'"));
      return quantities().front();
    }
  } // namespace Measurements
} // namespace Impoint
