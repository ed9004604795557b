#include <impoint/base/exceptions.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/solver/held_nodes.h>
#include <impoint/solver/nonlinear_system.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  template <int dim>
  NonlinearSystem<dim>::NonlinearSystem(
    const ActiveNodes<dim>             &active,
    const MaterialPoints<dim>          &points,
    Methods                            &methods,
    const Enforcement::Conforming<dim> &conforming,
    const LinearSolverParameters       &parameters,
    Counters                           &counters,
    Seconds                            &seconds)
    : active(active)
    , points(points)
    , methods(methods)
    , conforming(conforming)
    , counters(counters)
    , seconds(seconds)
    , assembly(active, points, methods)
    , solver(parameters, counters, active.basis().grid().communicator())
    , multipliers(assembly,
                  methods,
                  [this](const Vector &right,
                         const double  looser,
                         const double  further,
                         Vector       &x) {
                    Vector free(right);
                    cut(held, false, free);
                    solver.solve(problem, free, x, looser, further);
                    x.update_ghost_values();
                    cut(held, false, x);
                  })
  {}



  template <int dim>
  void NonlinearSystem<dim>::add_term(std::unique_ptr<Term<dim>> term)
  {
    assembly.add_term(std::move(term));
  }



  template <int dim>
  void NonlinearSystem<dim>::find_starved_cells()
  {
    counters.starved_cells = assembly.find_starved_cells();
  }



  template <int dim>
  void NonlinearSystem<dim>::gather(const unsigned int   k,
                                    const Vector        &u,
                                    std::vector<double> &cell_u) const
  {
    assembly.gather(k, u, cell_u);
  }



  template <int dim>
  void NonlinearSystem<dim>::new_active_set()
  {
    ScopedSeconds timer(seconds.pattern);
    ++counters.patterns;
    assembly.new_active_set();
    problem.pattern   = active.pattern();
    problem.symmetric = points.symmetric_tangent();
    // On several ranks nothing can factorise where iterating fails.
    problem.serves_long =
      points.carried().dynamic ||
      (points.small_strain() && points.constant_tangent()) ||
      Utilities::MPI::n_mpi_processes(active.basis().grid().communicator()) > 1;
    for (const auto &method : methods)
      problem.symmetric &= method->is_symmetric();
    problem.points.resize(active.n_nodes());
    const auto &basis = active.basis();
    problem.lines     = basis.lines();
    problem.lattice.clear();
    for (unsigned int i = 0; i < active.n_nodes(); ++i)
      {
        problem.points[i] = basis.point(active.grid_node(i));
        if (!problem.lines.empty())
          problem.lattice.push_back(basis.lattice_place(active.grid_node(i)));
      }
    rest.reinit(active.unknowns());
    full_rest.reinit(active.unknowns());
    new_problem = true;
  }



  template <int dim>
  void NonlinearSystem<dim>::begin_step(const double        start,
                                        const double        end,
                                        const Vector       &loads,
                                        const Inertia<dim> *step_inertia,
                                        const Vector       *displacement_before)
  {
    external = loads;
    inertia  = step_inertia;
    held     = conforming.held_nodes(active, start, end);
    scale    = 0;
    assembly.begin_step(displacement_before);
    multipliers.begin_step();
    problem.enforced.assign(active.n_nodes(), false);
    for (const auto &method : methods)
      if (method->is_active() && method->constrains())
        Enforcement::for_active_ranges(
          *method, active, [&](const unsigned int, const unsigned int k) {
            for (const unsigned int i : active.nodes(k))
              problem.enforced[i] = true;
          });
  }



  template <int dim>
  double NonlinearSystem<dim>::evaluate(const Vector &u,
                                        const bool    tangent_wanted)
  {
    ScopedSeconds timer(seconds.assembly);
    ++counters.residuals;
    counters.tangents += tangent_wanted;
    if (tangent_wanted && indefinite)
      {
        // The new one may well be definite.
        problem.symmetric = new_problem = true;
        indefinite                      = false;
      }
    new_matrix |= tangent_wanted;
    scale = assembly.assemble(u,
                              Assembly<dim>::Part::all,
                              tangent_wanted,
                              tangent_wanted && moderate_wanted(),
                              external,
                              inertia,
                              problem,
                              full_rest);
    full_rest.update_ghost_values();
    rest = full_rest;
    cut(held, false, rest);
    norm = rest.l2_norm();
    return norm / force_scale();
  }



  template <int dim>
  bool NonlinearSystem<dim>::has_held_nodes() const
  {
    return Utilities::MPI::max(int(!held.empty()),
                               active.basis().grid().communicator());
  }



  template <int dim>
  Tensor<1, dim>
  NonlinearSystem<dim>::reaction(const Enforcement::HeldNode<dim> &node,
                                 const unsigned int                k) const
  {
    double force = 0;
    for (unsigned int d = 0; d < dim; ++d)
      force +=
        full_rest.local_element(node.node * dim + d) * node.direction[k][d];
    return force * node.direction[k];
  }



  /** The displacements that conforming boundaries prescribe, in the first
   * correction of a step. */
  template <int dim>
  void NonlinearSystem<dim>::prescribe(const bool first, Vector &delta)
  {
    delta.reinit(active.unknowns());
    prescribed = false;
    if (first)
      for (const auto &node : held)
        {
          const Tensor<1, dim> value = node.prescribed();
          for (unsigned int d = 0; d < dim; ++d)
            delta.local_element(node.node * dim + d) = value[d];
          prescribed |= value.norm_square() > 0;
        }
    prescribed = Utilities::MPI::max(int(prescribed),
                                     active.basis().grid().communicator());
  }



  /** Hands the solver the last tangent without what conforming boundaries
   * hold. */
  template <int dim>
  void NonlinearSystem<dim>::prepare_solver()
  {
    const MPI_Comm comm      = active.basis().grid().communicator();
    const auto     cut_nodes = [&](BlockMatrix<dim> &matrix) {
      // the same on all ranks: a node's owner may have none of its cells
      eliminate(held,
                active.n_owned_nodes(),
                Utilities::MPI::max(matrix.largest_entry(), comm),
                matrix);
    };
    if (!new_matrix)
      return;
    new_matrix = false;
    if (has_held_nodes())
      {
        cut_nodes(problem.matrix);
        if (problem.has_moderate)
          cut_nodes(problem.moderate);
      }
    if (new_problem)
      solver.new_pattern(active, problem);
    solver.new_matrix(problem);
    if (new_problem && inertia == nullptr)
      solver.check_rigid_modes(problem);
    new_problem = false;
  }



  /** In dynamics masses hold what stresses would make buckle, but for nodes
   * with next to none: then the tangent is as good as before, but not positive
   * definite, and pivots have to be chosen. */
  template <int dim>
  void NonlinearSystem<dim>::solve(const Vector &right,
                                   const double  looser,
                                   Vector       &delta)
  {
    const auto attempt = [&]() {
      solver.solve(problem,
                   right,
                   delta,
                   std::max(looser, correction_looser()));
    };
    try
      {
        attempt();
      }
    catch (const StepFailed &)
      {
        if (inertia == nullptr || !problem.symmetric)
          throw;
        indefinite        = true;
        problem.symmetric = false;
        solver.new_pattern(active, problem);
        solver.new_matrix(problem);
        attempt();
      }
  }



  /** Newton's iteration takes back what is left of a linear system, if there
   * is another one. */
  template <int dim>
  double NonlinearSystem<dim>::correction_looser() const
  {
    constexpr double looser = 1e5;
    return problem.symmetric || is_augmented() || is_linear() ? 1. : looser;
  }



  template <int dim>
  void NonlinearSystem<dim>::correct(const bool    first,
                                     const Vector &u,
                                     Vector       &delta,
                                     const double  looser)
  {
    ScopedSeconds timer(seconds.solve);
    Vector        right(active.unknowns());
    prescribe(first, delta);
    if (prescribed)
      {
        // the matrix times the prescribed displacements, each rank's part
        problem.matrix.vmult(delta.begin(), right.begin());
        right.compress(VectorOperation::add);
      }
    right += full_rest;
    right *= -1.;
    right.update_ghost_values();
    cut(held, false, right);
    prepare_solver();
    for (const auto &method : methods)
      if (method->is_active() && method->contact_states())
        method->contact_states()->begin_correction();
    solve(right, looser, delta);
    delta.update_ghost_values();
    cut(held, first, delta);

    multiplier_forces.reinit(active.unknowns());
    if (is_augmented())
      multiplier_forces = multipliers.find(u,
                                           external.l2_norm(),
                                           right.l2_norm(),
                                           round_off_of_forces(u, delta),
                                           is_linear(),
                                           delta);
  }



  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
