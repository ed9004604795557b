#ifndef impoint_measurements_penetration_h
#define impoint_measurements_penetration_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * How deep material points lie behind a nonconforming boundary while it
     * acts: along the normal of the nearest boundary particle, at any depth
     * right behind that particle's part of the boundary; elsewhere, beyond an
     * end or a corner, if it is within one cell size h of the point.
     *
     * Results: "NAME depth": largest of all steps, in units of h, zero if no
     * point was ever behind. The history has that of each step.
     */
    template <int dim>
    class Penetration : public NamedValues<dim>
    {
    public:
      Penetration(const ParameterFile         &file,
                  const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      void end_step(const State<dim> &state) override;
      void results(std::vector<Result> &results) const override;
      void save_or_load(StateArchive &archive) override;

    private:
      double depth(const State<dim>             &state,
                   const BoundaryParticles<dim> &wall) const;

      const std::string  boundary;
      const unsigned int body;
      double             largest = 0;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
