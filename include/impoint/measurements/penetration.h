#ifndef impoint_measurements_penetration_h
#define impoint_measurements_penetration_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * How deep material points lie behind a nonconforming boundary while it
     * acts: along the normal of the nearest boundary particle, if that is
     * within one cell size h of the point, and at any depth if the point has
     * passed the boundary. What is behind at the start or has gone round an end
     * has not.
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

      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;
      void results(std::vector<Result> &results) const override;
      void save_or_load(StateArchive &archive) override;

    private:
      /** Where a point is, seen from the boundary. */
      enum Side : signed char
      {
        elsewhere, // also behind, but not from the front
        front,
        passed
      };

      double depth(const State<dim>             &state,
                   const BoundaryParticles<dim> &wall,
                   const bool                    acts);

      const std::string        boundary;
      const unsigned int       body;
      double                   largest = 0;
      std::vector<signed char> sides; // by the number of the point
    };
  } // namespace Measurements
} // namespace Impoint

#endif
