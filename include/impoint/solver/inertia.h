#ifndef impoint_solver_inertia_h
#define impoint_solver_inertia_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>
#include <impoint/solver/time_parameters.h>
#include <impoint/terms/ghost_penalty.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <array>

namespace Impoint
{
  /**
   * Mass, velocity and acceleration on the active nodes (P Eqs. 17-21) and
   * Newmark's relation between a step's displacements and accelerations, in
   * Bossak's variant: inertia is that of (1 - b) a_new + b a_old, b <= 0.
   */
  template <int dim>
  class Inertia
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    explicit Inertia(const TimeParameters &parameters);

    /** Projects the points' mass, momentum and inertia force; a consistent
     * projection asks for the mass of @p ghost_penalty, too. Collective. */
    void project(const ActiveNodes<dim>    &active,
                 const MaterialPoints<dim> &points,
                 const GhostPenalty<dim>   &ghost_penalty,
                 const double               time_step);

    /** Projects before the first step of a kept grid only: later ones find
     * velocity and acceleration on the nodes. Returns whether it did.
     * Collective. */
    bool begin_step(const ActiveNodes<dim>    &active,
                    const MaterialPoints<dim> &points,
                    const GhostPenalty<dim>   &ghost_penalty,
                    const double               time_step);

    /** Velocity and acceleration of the nodes after a step with displacements
     * @p u; of a kept grid. */
    void end_step(const Vector &u);

    /** What the nodes of a kept grid carry from step to step. */
    std::array<Vector *, 2> carried()
    {
      return {{&velocities, &accelerations}};
    }
    /** Takes what carried() holds now in place of projected values. */
    void set_carried()
    {
      has_carried = true;
    }

    /** The same with @p new_accelerations. */
    void carry(const Vector &new_accelerations)
    {
      accelerations = new_accelerations;
      has_carried   = true;
    }

    bool consistent() const
    {
      return is_consistent;
    }

    /** Factor alpha of the displacements in inertia. */
    double alpha() const
    {
      return (1. - bossak) / (beta * dt * dt);
    }

    /** Acceleration at the end of the step of unknown @p i for a displacement
     * @p u of it. */
    double acceleration(const unsigned int i, const double u) const
    {
      return (u / dt - velocities.local_element(i)) / (beta * dt) -
             (0.5 / beta - 1.) * accelerations.local_element(i);
    }

    /** The acceleration that takes part in the balance of forces. */
    double balanced_acceleration(const unsigned int i, const double u) const
    {
      return (1. - bossak) * acceleration(i, u) +
             bossak * accelerations.local_element(i);
    }

    /** Velocity at the end of the step of a particle or node. */
    double
    new_velocity(const double v, const double a_old, const double a_new) const
    {
      return v + dt * ((1. - gamma) * a_old + gamma * a_new);
    }

    /** What the filter has to know of earlier steps: the largest kinetic energy
     * of the points at the start of any step [J]. */
    double &largest_energy()
    {
      return largest;
    }

    /** Part of a point's unseen velocity that the step takes away; 0: there is
     * no filter. */
    double filtered_part() const;

    /** Velocity of unknown @p i at the start of the step that the points'
     * velocities are compared with to find what the grid doesn't see of them;
     * if there is a filter. */
    double seen_velocity(const unsigned int i) const
    {
      return seen_velocities.local_element(i);
    }

    /** Of active node @p i [kg]. */
    double mass(const unsigned int i) const
    {
      return masses.local_element(i);
    }
    /** Whether a diagonal of the nodes' masses, the sums of m_p N_I, gives even
     * forces per mass even accelerations. */
    bool can_lump() const
    {
      return !weighted;
    }

    /** The nodes' sums of m_p N_I, if that is what their masses are. */
    const Vector *sums_of_mass() const
    {
      return weighted ? nullptr : &masses;
    }

  private:
    template <int n_static>
    void project_cell(const MaterialPoints<dim>             &points,
                      const typename PointCloud<dim>::Range &range,
                      const ArrayView<const unsigned int>    nodes);

    void find_seen_velocities(const ActiveNodes<dim>    &active,
                              const MaterialPoints<dim> &points);
    void divide_by_mass(Vector &momenta) const;
    void look_for_rest(const ActiveNodes<dim>    &active,
                       const MaterialPoints<dim> &points);

    double beta, gamma, bossak, filter, filter_at_rest;
    double largest = 0; // kinetic energy [J]
    bool   at_rest = false;
    bool   is_consistent, projects_consistently;
    bool   has_carried = false; // from the last step of a kept grid
    bool   weighted    = false; // by mean_weights(): functions may be negative
    double dt          = 1;
    Vector masses, velocities, accelerations, seen_velocities;
  };
} // namespace Impoint

#endif
