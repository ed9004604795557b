#include <impoint/solver/nonlinear_system.h>

namespace Impoint
{
  /** Initial stress included; boundaries that constrain have no force yet. */
  template <int dim>
  void NonlinearSystem<dim>::balance_at_rest()
  {
    Vector zero(active.unknowns());
    zero.update_ghost_values();
    assembly.assemble(zero,
                      Assembly<dim>::Part::loads,
                      false,
                      false,
                      external,
                      nullptr,
                      problem,
                      full_rest);
    full_rest.update_ghost_values();
  }



  /**
   * With w = beta dt^2 a the balance at the start reads alpha M w + P w = f: a
   * linear step with inertia and boundaries but without the stiffness of the
   * material.
   */
  template <int dim>
  void NonlinearSystem<dim>::initial_acceleration(Vector &accelerations,
                                                  Vector &w)
  {
    Vector zero(active.unknowns()), unused;
    zero.update_ghost_values();
    assembly.assemble(zero,
                      Assembly<dim>::Part::constraints,
                      true,
                      moderate_wanted(),
                      external,
                      inertia,
                      problem,
                      unused);
    new_matrix = true;
    // Without M a(0) of Newmark's relation, which holds the velocities, and
    // without walls that move.
    balance_at_rest();
    rest = full_rest;
    for (auto &node : held)
      node.value = {};
    const BlockMatrix<dim> whole = problem.matrix; // correct() cuts held nodes
    correct(true, zero, w);
    accelerations = w;
    accelerations *= inertia->alpha();
    accelerations.update_ghost_values();

    Vector reactions(active.unknowns());
    whole.vmult(w.begin(), reactions.begin());
    reactions.compress(VectorOperation::add);
    reactions += full_rest;
    reactions += multiplier_forces;
    full_rest = reactions;
    full_rest.update_ghost_values();
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
