#ifndef impoint_measurements_totals_h
#define impoint_measurements_totals_h

#include <impoint/particles/material_points.h>

namespace Impoint
{
  namespace Measurements
  {
    /** Sums over all material points of all ranks. */
    template <int dim>
    struct Totals
    {
      double         mass = 0;   // [kg]
      Point<dim>     centre;     // of mass [m]
      Tensor<1, dim> momentum;   // [kg m/s]
      Tensor<1, 3>   spin;       // angular momentum about the origin
                                 // [kg m2/s]; 2D: z only
      double kinetic_energy = 0; // [J]
      double strain_energy  = 0; // [J]; NaN where a material has none
    };

    /** The sums; what needs velocities is zero if the points carry none.
     * Collective. */
    template <int dim>
    Totals<dim> totals(const MaterialPoints<dim> &points,
                       const MPI_Comm communicator = MPI_COMM_WORLD);

    /** @p arm x @p force; in 2D its z component only. */
    template <int dim>
    Tensor<1, 3> moment(const Tensor<1, dim> &arm, const Tensor<1, dim> &force);
  } // namespace Measurements
} // namespace Impoint

#endif
