#ifndef impoint_solver_nodal_mass_h
#define impoint_solver_nodal_mass_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>
#include <impoint/terms/ghost_penalty.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /**
   * The consistent mass M_IJ = sum_p m_p N_I N_J of the active nodes, and that
   * of the ghost penalty: without it functions that see a sliver only would get
   * any velocity, which the equation of motion, where it is, would have to
   * carry on.
   */
  template <int dim>
  class ConsistentNodalMass
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    ConsistentNodalMass(const ActiveNodes<dim>    &active,
                        const MaterialPoints<dim> &points,
                        const GhostPenalty<dim>   &ghost_penalty);

    /**
     * Solves M x = b: the velocities whose momenta are @p momenta, which they
     * replace. What next to no mass sees of them, and there is much of it where
     * cells have few points, stays as @p first_guess says. Collective.
     */
    void divide(Vector &momenta, const Vector &first_guess) const;

  private:
    void   multiply(const Vector &x, Vector &result) const;
    Vector inverse_diagonal() const;
    template <typename Function>
    void for_points(const Function &function) const;

    const ActiveNodes<dim>    &active;
    const MaterialPoints<dim> &points;
    const GhostPenalty<dim>   &ghost_penalty;
  };
} // namespace Impoint

#endif
