#ifndef impoint_measurements_reaction_h
#define impoint_measurements_reaction_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * Force and moment of a boundary on the material at the end of the step.
     *
     * Results: "NAME F_x", "NAME F_y"(, "NAME F_z") [N]; about 'Point' "NAME
     * M_z" in 2D, "NAME M_x", "NAME M_y", "NAME M_z" in 3D [Nm].
     */
    template <int dim>
    class Reaction : public NamedValues<dim>
    {
    public:
      Reaction(const ParameterFile         &file,
               const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      void end_step(const State<dim> &state) override;

    private:
      const std::string boundary;
      Tensor<1, dim>    centre;
    };



    /** The entry of @p boundary among the state's forces. */
    template <int dim>
    const BoundaryForce<dim> &force_of(const State<dim>  &state,
                                       const std::string &boundary);
  } // namespace Measurements
} // namespace Impoint

#endif
