#include <impoint/solver/nonlinear_system.h>

namespace Impoint
{
  /**
   * With w = beta dt^2 a the balance at the start reads alpha M w + P w = f: a
   * linear step with inertia and boundaries but without the stiffness of the
   * material.
   */
  template <int dim>
  void NonlinearSystem<dim>::initial_acceleration(Vector &accelerations)
  {
    Vector zero(active.unknowns()), w(active.unknowns());
    zero.update_ghost_values();
    // Forces at rest, initial stress included: without M a(0) of Newmark's
    // relation, which holds the velocities, and without walls that move.
    Vector     forces;
    const auto assemble = [&](const typename Assembly<dim>::Part part,
                              const bool                         tangent_wanted,
                              const Inertia<dim>                *with_inertia,
                              Vector                            &residual) {
      assembly.assemble(zero,
                        part,
                        tangent_wanted,
                        tangent_wanted && moderate_wanted(),
                        external,
                        with_inertia,
                        problem,
                        residual);
    };
    assemble(Assembly<dim>::Part::loads, false, nullptr, forces);
    assemble(Assembly<dim>::Part::constraints, true, inertia, full_rest);
    new_matrix = true;
    full_rest  = forces;
    full_rest.update_ghost_values();
    rest = full_rest;
    for (auto &node : held)
      node.value = {};
    correct(true, zero, w);
    accelerations = w;
    accelerations *= inertia->alpha();
    accelerations.update_ghost_values();
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
