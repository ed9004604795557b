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

    /** Adds them up, the points of one cell after the other: best while their
     * state is in the cache. What needs velocities is zero if the points carry
     * none. */
    template <int dim>
    class TotalsSum
    {
    public:
      explicit TotalsSum(const MaterialPoints<dim> &points);

      void add(const typename PointCloud<dim>::Range &range);

      /** Collective. */
      Totals<dim> of_all_ranks(const MPI_Comm communicator) const;

    private:
      void   add_motion(const unsigned int p);
      double strain_energy(const unsigned int p);

      const MaterialPoints<dim>  &points;
      Totals<dim>                 sums; // centre: times the mass
      Materials::Deformation<dim> deformation;
      Materials::Response<dim>    response;
    };

    /** The same of all points. Collective. */
    template <int dim>
    Totals<dim> totals(const MaterialPoints<dim> &points,
                       const MPI_Comm communicator = MPI_COMM_WORLD);

    /** @p arm x @p force; in 2D its z component only. */
    template <int dim>
    Tensor<1, 3> moment(const Tensor<1, dim> &arm, const Tensor<1, dim> &force);
  } // namespace Measurements
} // namespace Impoint

#endif
