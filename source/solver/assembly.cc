#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/assembly.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  template <int dim>
  Assembly<dim>::Assembly(const ActiveNodes<dim>    &active,
                          const MaterialPoints<dim> &points,
                          Methods                   &methods)
    : active(active)
    , points(points)
    , methods(methods)
    , nearby_stiffness(active, points)
    , empty_cells(active,
                  points.small_strain() ||
                    (points.carried().dynamic && !points.carried().keeps_grid))
    , hourglass(active, points)
    , consistent_mass(points)
    , ghost_penalty(active, points)
  {}



  template <int dim>
  void Assembly<dim>::new_active_set()
  {
    empty_cells.reinit();
    ghost_penalty.new_active_set();
  }



  template <int dim>
  void Assembly<dim>::add_term(std::unique_ptr<Term<dim>> term)
  {
    terms.push_back(std::move(term));
  }



  template <int dim>
  std::size_t Assembly<dim>::find_starved_cells()
  {
    hourglass.reinit();
    nearby_stiffness.reinit();
    return Utilities::MPI::sum(hourglass.cells().size(),
                               active.basis().grid().communicator());
  }



  /** In dynamics the mass holds what few points cannot see. Next to none of it
   * is not enough where contact opens and closes. */
  template <int dim>
  void Assembly<dim>::begin_step(const Vector *displacement_before)
  {
    kept_u = displacement_before;
    in_contact.assign(active.n_cells(), false);
    for (const auto &method : methods)
      if (method->is_active() && !method->is_linear())
        Enforcement::for_active_ranges(
          *method, active, [&](const unsigned int, const unsigned int k) {
            in_contact[k] = true;
          });
  }



  template <int dim>
  void Assembly<dim>::gather(const unsigned int   k,
                             const Vector        &u,
                             std::vector<double> &values) const
  {
    const auto nodes = active.nodes(k);
    values.resize(nodes.size() * dim);
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        values[a * dim + d] = u.local_element(nodes[a] * dim + d);
  }



  template <int dim>
  void Assembly<dim>::scatter(const unsigned int k,
                              BlockMatrix<dim>  &matrix) const
  {
    const unsigned int  n    = active.nodes(k).size();
    const unsigned int *to   = active.scatter(k);
    const double       *from = cell_matrix.data();
    for (unsigned int ab = 0; ab < n * n; ++ab, from += dim * dim)
      {
        double *block = matrix.values.data() + std::size_t(to[ab]) * dim * dim;
        for (unsigned int e = 0; e < dim * dim; ++e)
          block[e] += from[e];
      }
  }



  template <int dim>
  void Assembly<dim>::scatter_residual(const unsigned int k)
  {
    const auto nodes = active.nodes(k);
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        rest.local_element(nodes[a] * dim + d) += cell_residual[a * dim + d];
  }



  /** Makes @p system the empty one of group k, at its cell_u. */
  template <int dim>
  void Assembly<dim>::begin_cell(const unsigned int k,
                                 const bool         tangent_wanted,
                                 CellSystem        &system)
  {
    system.n             = active.nodes(k).size();
    const unsigned int n = system.n * dim;
    cell_residual.assign(n, 0.);
    if (tangent_wanted)
      cell_matrix.assign(n * n, 0.);
    system.u        = cell_u.data();
    system.residual = cell_residual.data();
    system.matrix   = tangent_wanted ? cell_matrix.data() : nullptr;
  }



  /** @p system of group k for what is stiff in the grid's shape, not in that at
   * the start of the step. */
  template <int dim>
  CellSystem Assembly<dim>::since_start(const unsigned int k,
                                        const CellSystem  &system)
  {
    CellSystem result = system;
    if (kept_u != nullptr)
      {
        gather(k, *kept_u, whole_u);
        for (unsigned int i = 0; i < whole_u.size(); ++i)
          whole_u[i] += cell_u[i];
        result.u = whole_u.data();
      }
    return result;
  }



  template <int dim>
  void Assembly<dim>::assemble_material(const Vector &u,
                                        const bool    tangent_wanted,
                                        const Part    part)
  {
    CellSystem         system;
    unsigned int       next_starved = 0;
    const bool         with_mass    = has_mass_matrix(part);
    const unsigned int first =
      part == Part::constraints && !with_mass ? active.n_material_cells() : 0;
    for (unsigned int k = first; k < active.n_cells(); ++k)
      {
        gather(k, u, cell_u);
        begin_cell(k, tangent_wanted, system);
        if (k < active.n_material_cells())
          {
            if (part != Part::constraints)
              for (const auto &term : terms)
                term->add(k, system);
            if (part != Part::constraints &&
                next_starved < hourglass.cells().size() &&
                hourglass.cells()[next_starved] == k)
              {
                if (inertia == nullptr || in_contact[k])
                  {
                    CellSystem whole = since_start(k, system);
                    hourglass.add(next_starved, whole);
                  }
                ++next_starved;
              }
            if (with_mass)
              {
                accelerations_of(k);
                consistent_mass.add(k,
                                    cell_accelerations.data(),
                                    inertia->alpha(),
                                    system);
              }
          }
        else if (!ghost_penalty.holds(k))
          {
            CellSystem whole = since_start(k, system);
            empty_cells.add(k,
                            nearby_stiffness.young(active.cell(k)) *
                              points.carried().thickness,
                            whole);
            if (tangent_wanted && inertia != nullptr && in_contact[k])
              empty_cells.anchor(system);
          }
        scatter_residual(k);
        if (tangent_wanted)
          scatter(k, problem->matrix);
      }
  }



  /** Adds contribute(strength, system) to group k. */
  template <int dim>
  template <typename Function>
  void Assembly<dim>::add_boundary(const unsigned int k,
                                   const Vector      &u,
                                   const bool         tangent_wanted,
                                   const Part         part,
                                   const Function    &contribute)
  {
    CellSystem system;
    gather(k, u, cell_u);
    if (tangent_wanted && problem->has_moderate)
      {
        begin_cell(k, true, system);
        contribute(Enforcement::Strength::moderate, system);
        scatter(k, problem->moderate);
      }
    begin_cell(k, tangent_wanted, system);
    contribute(part == Part::constraints ? Enforcement::Strength::constraint :
                                           Enforcement::Strength::exact,
               system);
    scatter_residual(k);
    if (tangent_wanted)
      scatter(k, problem->matrix);
  }



  template <int dim>
  void Assembly<dim>::assemble_boundaries(const Vector &u,
                                          const bool    tangent_wanted,
                                          const Part    part)
  {
    using Enforcement::Strength;
    for (const auto &method : methods)
      {
        if (!method->is_active() ||
            (part == Part::loads && method->constrains()) ||
            (part == Part::constraints && !method->constrains()))
          continue;
        Enforcement::for_active_ranges(
          *method, active, [&](const unsigned int r, const unsigned int k) {
            add_boundary(k,
                         u,
                         tangent_wanted,
                         part,
                         [&](const Strength strength, CellSystem &system) {
                           method->add(r, strength, system);
                         });
          });
        Enforcement::for_links(
          *method, active, [&](const unsigned int l, const unsigned int k) {
            add_boundary(k,
                         u,
                         tangent_wanted,
                         part,
                         [&](const Strength strength, CellSystem &system) {
                           method->add_link(l, strength, system);
                         });
          });
      }
  }



  template <int dim>
  double Assembly<dim>::assemble(const Vector       &u,
                                 const Part          part,
                                 const bool          tangent_wanted,
                                 const bool          moderate_wanted,
                                 const Vector       &external,
                                 const Inertia<dim> *step_inertia,
                                 LinearProblem<dim> &linear_problem,
                                 Vector             &residual)
  {
    problem = &linear_problem;
    inertia = step_inertia;
    rest.reinit(active.unknowns());
    if (tangent_wanted)
      {
        problem->matrix.reinit(problem->pattern);
        problem->has_moderate = false;
      }
    std::string failure;
    try
      {
        assemble_material(u, tangent_wanted, part);
      }
    catch (const StepFailed &step_failure)
      {
        failure = step_failure.what();
      }
    for (const auto &message :
         Utilities::MPI::all_gather(active.basis().grid().communicator(),
                                    failure))
      if (!message.empty())
        throw StepFailed(message);

    assemble_ghost_penalty(u, tangent_wanted, part);
    double scale = external.l2_norm();
    if (inertia != nullptr)
      scale = std::max(scale, inertia_norm(u));
    if (inertia != nullptr && !has_mass_matrix(part))
      add_inertia(u, tangent_wanted);
    rest.compress(VectorOperation::add);
    scale = std::max(scale, rest.l2_norm());
    rest.zero_out_ghost_values();

    bool constrained = false;
    for (const auto &method : methods)
      constrained |= method->is_active() && method->constrains();
    if (tangent_wanted && constrained && moderate_wanted)
      {
        // what the boundaries add to it comes next
        problem->has_moderate = true;
        problem->moderate     = problem->matrix;
      }
    Vector before(rest);
    rest = 0;
    on_all_ranks(active.basis().grid().communicator(),
                 [&]() { assemble_boundaries(u, tangent_wanted, part); });
    rest.compress(VectorOperation::add);
    scale = std::max(scale, rest.l2_norm());
    rest += before;
    rest -= external;
    residual = rest;
    return scale;
  }

  template class Assembly<2>;
  template class Assembly<3>;
} // namespace Impoint
