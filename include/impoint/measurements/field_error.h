#ifndef impoint_measurements_field_error_h
#define impoint_measurements_field_error_h

#include <impoint/base/exceptions.h>
#include <impoint/measurements/error_norm.h>
#include <impoint/measurements/named_values.h>

#include <array>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Error of displacement, velocity or Cauchy stress at the material points
     * against exact values given as expressions of place and time, in the norms
     * of ErrorNorm with the points' volumes at the start. The norm of a stress
     * is that of the tensor, in 2D without zz if 'Exact' has none.
     *
     * Results: "NAME" for 'Component = norm' or a single component; for 'all'
     * "NAME x", ... or "NAME xx", ... in the order of 'Exact'.
     */
    template <int dim>
    class FieldError : public NamedValues<dim>
    {
    public:
      FieldError(const ParameterFile         &file,
                 const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      /** Throws InputError if the velocity is wanted of points without. */
      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;

    private:
      /** A vector, or a symmetric tensor. */
      using Values = std::array<double, 6>;

      /** What 'Exact' has, and whose error is wanted. */
      struct Selection
      {
        Selection(const ParameterFile         &file,
                  const MeasurementParameters &parameters);

        std::vector<unsigned int> given;   // components of the field
        std::vector<double>       weights; // of their squares in the norm
        std::vector<unsigned int> wanted;  // among the given
        std::vector<std::string>  names;   // of the wanted
      };

      FieldError(const ParameterFile         &file,
                 const MeasurementParameters &parameters,
                 const Selection             &selection);

      ErrorNorm  all_errors(const State<dim> &state) const;
      Values     values(const MaterialPoints<dim> &points,
                        const unsigned int         p) const;
      Point<dim> place(const MaterialPoints<dim> &points,
                       const unsigned int         p) const;

      const MeasurementParameters parameters;
      const Selection             selection;
      const InputError            no_velocity;
      const unsigned int          body;
      Expression<dim>             exact;
      Tensor<2, dim>              frame; // rows: axes
      const Point<dim>            origin;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
