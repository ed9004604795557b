#ifndef impoint_solver_inertia_h
#define impoint_solver_inertia_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  class ParameterFile;

  /** How time is discretised. */
  struct TimeParameters
  {
    void declare(ParameterFile &file);
    void check(const ParameterFile &file) const;

    std::string kind     = "quasi-static"; // quasi-static|dynamic
    double      end      = 1;
    double      step     = 1;
    double      smallest = 1e-3; // of the given step
    double      beta     = 0.25;
    double      gamma    = 0.5;
    std::string mass     = "lumped";      // lumped|consistent
    std::string initial  = "equilibrium"; // equilibrium|zero|expression
    bool        is_dynamic() const
    {
      return kind == "dynamic";
    }
  };

  /**
   * Mass, velocity and acceleration on the active nodes (P Eqs. 17-21) and
   * Newmark's relation between a step's displacements and accelerations.
   */
  template <int dim>
  class Inertia
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;

    explicit Inertia(const TimeParameters &parameters);

    /** Projects the points' mass, momentum and inertia force. Collective. */
    void project(const ActiveNodes<dim>    &active,
                 const MaterialPoints<dim> &points,
                 const double               time_step);

    bool consistent() const
    {
      return is_consistent;
    }

    /** Factor alpha of the displacements in the acceleration. */
    double alpha() const
    {
      return 1. / (beta * dt * dt);
    }

    /** Acceleration of unknown @p i for a displacement @p u of it. */
    double acceleration(const unsigned int i, const double u) const
    {
      return alpha() * u - velocities.local_element(i) / (beta * dt) -
             (0.5 / beta - 1.) * accelerations.local_element(i);
    }

    /** Velocity at the end of the step of a particle or node. */
    double
    new_velocity(const double v, const double a_old, const double a_new) const
    {
      return v + dt * ((1. - gamma) * a_old + gamma * a_new);
    }

    /** Of active node @p i [kg]. */
    double mass(const unsigned int i) const
    {
      return masses.local_element(i);
    }

  private:
    template <int n_static>
    void project_cell(const MaterialPoints<dim>             &points,
                      const typename PointCloud<dim>::Range &range,
                      const ArrayView<const unsigned int>    nodes);

    double beta, gamma;
    bool   is_consistent;
    double dt = 1;
    Vector masses, velocities, accelerations;
  };
} // namespace Impoint

#endif
