#include <impoint/base/exceptions.h>
#include <impoint/base/scoped_seconds.h>
#include <impoint/solver/nonlinear_system.h>
#include <impoint/terms/consistent_mass.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    // Forces below this part of E h^(dim-1) are none.
    constexpr double smallest_force = 1e-13;
  } // namespace



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
    , empty_cells(active, points.young())
    , hourglass(active, points.young())
    , solver(parameters, counters, active.basis().grid().communicator())
  {}



  template <int dim>
  void NonlinearSystem<dim>::add_term(std::unique_ptr<Term<dim>> term)
  {
    terms.push_back(std::move(term));
  }



  template <int dim>
  void NonlinearSystem<dim>::new_active_set()
  {
    ScopedSeconds timer(seconds.pattern);
    ++counters.patterns;
    empty_cells.reinit();
    problem.pattern = active.pattern();
    problem.points.resize(active.n_nodes());
    problem.regularisation.assign(active.n_nodes(), 0.);
    const auto &grid    = active.basis().grid();
    const auto &lattice = grid.lattice();
    problem.lattice.assign(lattice.exists ? active.n_nodes() : 0, {});
    for (unsigned int i = 0; i < active.n_nodes(); ++i)
      {
        problem.points[i] = active.basis().point(active.grid_node(i));
        if (lattice.exists)
          {
            const Tensor<1, dim> place =
              transpose(lattice.axes) * (problem.points[i] - lattice.origin);
            for (unsigned int d = 0; d < dim; ++d)
              problem.lattice[i][d] =
                static_cast<int>(std::lround(place[d] / lattice.spacing[d]));
          }
      }
    rest.reinit(active.unknowns());
    full_rest.reinit(active.unknowns());
    new_problem = true;
  }



  template <int dim>
  void NonlinearSystem<dim>::find_starved_cells()
  {
    const unsigned int        n_rigid = dim * (dim + 1) / 2;
    std::vector<unsigned int> starved;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const unsigned int n     = active.nodes(k).size();
        const auto        &range = points.ranges()[k];
        // Simplices see all their modes with one point. Elsewhere as many
        // strains as modes are not enough: points may lie on a line.
        if (n > dim + 1 &&
            (range.end - range.begin) * Voigt<dim>::n <= n * dim - n_rigid)
          starved.push_back(k);
      }
    hourglass.reinit(starved);
    counters.starved_cells =
      Utilities::MPI::sum(starved.size(), active.basis().grid().communicator());
  }



  template <int dim>
  void NonlinearSystem<dim>::begin_step(const double        start,
                                        const double        end,
                                        const Vector       &loads,
                                        const Inertia<dim> *step_inertia)
  {
    external = loads;
    inertia  = step_inertia;
    held     = conforming.held_nodes(active, start, end);
    scale    = 0;
    problem.enforced.assign(active.n_nodes(), false);
    for (const auto &method : methods)
      if (method->is_active() && method->constrains())
        for (const auto &range : method->particles().ranges())
          {
            const unsigned int k = active.position(range.cell);
            if (k != BackgroundGrid<dim>::nowhere)
              for (const unsigned int i : active.nodes(k))
                problem.enforced[i] = true;
          }
  }



  template <int dim>
  bool NonlinearSystem<dim>::is_linear() const
  {
    return points.small_strain() && points.constant_tangent() &&
           !is_augmented();
  }



  template <int dim>
  bool NonlinearSystem<dim>::is_augmented() const
  {
    bool augmented = false;
    for (const auto &method : methods)
      augmented |= method->is_active() && method->augmented();
    return Utilities::MPI::max(int(augmented),
                               active.basis().grid().communicator());
  }



  template <int dim>
  void NonlinearSystem<dim>::gather(const unsigned int   k,
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
  void NonlinearSystem<dim>::scatter(const unsigned int k,
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
  void NonlinearSystem<dim>::scatter_residual(const unsigned int k)
  {
    const auto nodes = active.nodes(k);
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        full_rest.local_element(nodes[a] * dim + d) +=
          cell_residual[a * dim + d];
  }



  namespace
  {
    void prepare_cell(const unsigned int   n_nodes,
                      const unsigned int   dim,
                      const bool           tangent_wanted,
                      std::vector<double> &u,
                      std::vector<double> &residual,
                      std::vector<double> &matrix,
                      CellSystem          &system)
    {
      const unsigned int n = n_nodes * dim;
      residual.assign(n, 0.);
      if (tangent_wanted)
        matrix.assign(n * n, 0.);
      system.n        = n_nodes;
      system.u        = u.data();
      system.residual = residual.data();
      system.matrix   = tangent_wanted ? matrix.data() : nullptr;
    }
  } // namespace



  template <int dim>
  void NonlinearSystem<dim>::assemble_material(const Vector &u,
                                               const bool    tangent_wanted,
                                               const Part    part)
  {
    const ConsistentMass<dim> consistent_mass(points);
    std::vector<double>       accelerations;
    CellSystem                system;
    unsigned int              next_starved = 0;
    for (unsigned int k = part == Part::boundaries ? active.n_material_cells() :
                                                     0;
         k < active.n_cells();
         ++k)
      {
        const auto nodes = active.nodes(k);
        gather(k, u, cell_u);
        prepare_cell(nodes.size(),
                     dim,
                     tangent_wanted,
                     cell_u,
                     cell_residual,
                     cell_matrix,
                     system);
        if (k < active.n_material_cells())
          {
            for (const auto &term : terms)
              term->add(k, system);
            // In dynamics the mass holds what few points cannot see.
            if (inertia == nullptr && next_starved < hourglass.cells().size() &&
                hourglass.cells()[next_starved] == k)
              hourglass.add(next_starved++, system);
            if (inertia != nullptr && inertia->consistent())
              {
                accelerations.resize(nodes.size() * dim);
                for (unsigned int a = 0; a < nodes.size(); ++a)
                  for (unsigned int d = 0; d < dim; ++d)
                    accelerations[a * dim + d] =
                      inertia->acceleration(nodes[a] * dim + d,
                                            cell_u[a * dim + d]);
                consistent_mass.add(k,
                                    accelerations.data(),
                                    inertia->alpha(),
                                    system);
              }
          }
        else
          empty_cells.add(k, system);
        scatter_residual(k);
        if (tangent_wanted)
          scatter(k, problem.matrix);
      }
  }



  template <int dim>
  void NonlinearSystem<dim>::assemble_boundaries(const Vector &u,
                                                 const bool    tangent_wanted)
  {
    CellSystem system;
    for (const auto &method : methods)
      {
        if (!method->is_active())
          continue;
        const auto &ranges = method->particles().ranges();
        for (unsigned int r = 0; r < ranges.size(); ++r)
          {
            const unsigned int k = active.position(ranges[r].cell);
            if (k == BackgroundGrid<dim>::nowhere)
              continue;
            gather(k, u, cell_u);
            const auto begin_cell = [&]() {
              prepare_cell(active.nodes(k).size(),
                           dim,
                           tangent_wanted,
                           cell_u,
                           cell_residual,
                           cell_matrix,
                           system);
            };
            if (tangent_wanted && problem.has_moderate)
              {
                begin_cell();
                method->add(r, Enforcement::Strength::moderate, system);
                scatter(k, problem.moderate);
              }
            begin_cell();
            method->add(r, Enforcement::Strength::exact, system);
            scatter_residual(k);
            if (tangent_wanted)
              scatter(k, problem.matrix);
          }
      }
  }



  /** Lumped mass: a diagonal that each node's owner adds. */
  template <int dim>
  void NonlinearSystem<dim>::add_inertia(const Vector &u,
                                         const bool    tangent_wanted)
  {
    for (unsigned int i = 0; i < active.n_owned_nodes(); ++i)
      {
        const double mass = inertia->mass(i);
        for (unsigned int d = 0; d < dim; ++d)
          full_rest.local_element(i * dim + d) +=
            mass *
            inertia->acceleration(i * dim + d, u.local_element(i * dim + d));
        if (tangent_wanted)
          {
            const auto row   = problem.pattern.columns.begin();
            const auto begin = row + problem.pattern.row_start[i];
            const auto end   = row + problem.pattern.row_start[i + 1];
            double    *block = problem.matrix.values.data() +
                            (std::lower_bound(begin, end, i) - row) * dim * dim;
            for (unsigned int d = 0; d < dim; ++d)
              block[d * dim + d] += inertia->alpha() * mass;
          }
      }
  }



  template <int dim>
  void NonlinearSystem<dim>::assemble(const Vector &u,
                                      const bool    tangent_wanted,
                                      const Part    part)
  {
    full_rest = 0;
    if (tangent_wanted)
      {
        problem.matrix.reinit(problem.pattern);
        problem.has_moderate = false;
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

    if (inertia != nullptr &&
        (part == Part::boundaries || !inertia->consistent()))
      add_inertia(u, tangent_wanted);
    full_rest.compress(VectorOperation::add);
    const double internal = full_rest.l2_norm();
    full_rest.zero_out_ghost_values();

    bool constrained = false;
    for (const auto &method : methods)
      constrained |= method->is_active() && method->constrains();
    if (tangent_wanted && constrained && solver.iterative(active))
      {
        // what the boundaries add to it comes next
        problem.has_moderate = true;
        problem.moderate     = problem.matrix;
      }
    Vector before(full_rest);
    full_rest = 0;
    if (part != Part::material)
      assemble_boundaries(u, tangent_wanted);
    full_rest.compress(VectorOperation::add);
    scale = std::max({internal, full_rest.l2_norm(), external.l2_norm()});
    full_rest += before;
    full_rest -= external;
  }



  template <int dim>
  double NonlinearSystem<dim>::force_scale() const
  {
    const double h = active.basis().grid().smallest_size();
    return std::max(scale,
                    smallest_force * points.young() *
                      Utilities::fixed_power<dim - 1>(h));
  }



  template <int dim>
  double NonlinearSystem<dim>::evaluate(const Vector &u,
                                        const bool    tangent_wanted)
  {
    ScopedSeconds timer(seconds.assembly);
    ++counters.residuals;
    counters.tangents += tangent_wanted;
    assemble(u, tangent_wanted, Part::all);
    full_rest.update_ghost_values();
    rest = full_rest;
    for (const auto &node : held)
      {
        Tensor<1, dim> r;
        for (unsigned int d = 0; d < dim; ++d)
          r[d] = rest.local_element(node.node * dim + d);
        r = node.projector() * r;
        for (unsigned int d = 0; d < dim; ++d)
          rest.local_element(node.node * dim + d) = r[d];
      }
    return rest.l2_norm() / force_scale();
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



  /** P K P + largest (1 - P) with the projector P onto what nodes are free to
   * do: P Eqs. 29, 32, 35 without turning unknowns into other frames, which
   * would hide rigid motions from whoever reads the matrix. */
  template <int dim>
  void NonlinearSystem<dim>::eliminate(BlockMatrix<dim> &matrix) const
  {
    if (held.empty())
      return;
    constexpr unsigned int    none = BackgroundGrid<dim>::nowhere;
    const Tensor<2, dim>      one(unit_symmetric_tensor<dim>());
    const auto               &pattern = problem.pattern;
    double                    largest = 0;
    std::vector<unsigned int> held_at(active.n_nodes(), none);
    for (unsigned int i = 0; i < held.size(); ++i)
      held_at[held[i].node] = i;
    for (const double value : matrix.values)
      largest = std::max(largest, std::abs(value));

    const auto treat = [&](const unsigned int row, const std::size_t q) {
      const unsigned int column = pattern.columns[q];
      const unsigned int i = held_at[row], j = held_at[column];
      if (i == none && j == none)
        return;
      double        *values = matrix.values.data() + q * dim * dim;
      Tensor<2, dim> block;
      for (unsigned int r = 0; r < dim; ++r)
        for (unsigned int s = 0; s < dim; ++s)
          block[r][s] = values[r * dim + s];
      if (i != none)
        block = held[i].projector() * block;
      if (j != none)
        block = block * held[j].projector();
      if (row == column && row < active.n_owned_nodes())
        block += largest * (one - held[i].projector());
      for (unsigned int r = 0; r < dim; ++r)
        for (unsigned int s = 0; s < dim; ++s)
          values[r * dim + s] = block[r][s];
    };
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      for (std::size_t q = pattern.row_start[row];
           q < pattern.row_start[row + 1];
           ++q)
        treat(row, q);
  }



  template <int dim>
  void NonlinearSystem<dim>::correct(const bool first, Vector &delta)
  {
    ScopedSeconds timer(seconds.solve);
    delta.reinit(active.unknowns());
    Vector right(active.unknowns());

    bool prescribed = false;
    if (first)
      for (const auto &node : held)
        {
          const Tensor<1, dim> value = node.prescribed();
          for (unsigned int d = 0; d < dim; ++d)
            delta.local_element(node.node * dim + d) = value[d];
          prescribed |= value.norm_square() > 0;
        }
    if (Utilities::MPI::max(int(prescribed),
                            active.basis().grid().communicator()))
      {
        // the matrix times the prescribed displacements, each rank's part
        problem.matrix.vmult(delta.begin(), right.begin());
        right.compress(VectorOperation::add);
      }
    right += full_rest;
    right *= -1.;
    right.update_ghost_values();

    // What is held is cut out of a vector, and takes its value instead.
    const auto cut = [&](Vector &vector, const bool with_values) {
      for (const auto &node : held)
        {
          Tensor<1, dim> value;
          for (unsigned int d = 0; d < dim; ++d)
            value[d] = vector.local_element(node.node * dim + d);
          value = node.projector() * value;
          if (with_values)
            value += node.prescribed();
          for (unsigned int d = 0; d < dim; ++d)
            vector.local_element(node.node * dim + d) = value[d];
        }
    };
    cut(right, false);
    eliminate(problem.matrix);
    if (problem.has_moderate)
      eliminate(problem.moderate);

    if (new_problem)
      solver.new_pattern(active, problem);
    solver.new_matrix(problem);
    if (new_problem && inertia == nullptr)
      solver.check_rigid_modes(problem);
    new_problem = false;
    solver.solve(problem, right, delta);
    delta.update_ghost_values();
    cut(delta, first);
  }



  template <int dim>
  double NonlinearSystem<dim>::linear_residual(const Vector &delta) const
  {
    // The matrix is without held unknowns; so is the residual.
    Vector product(active.unknowns());
    problem.matrix.vmult(delta.begin(), product.begin());
    product.compress(VectorOperation::add);
    product += rest;
    return product.l2_norm() / force_scale();
  }



  template <int dim>
  void NonlinearSystem<dim>::update_multipliers(const Vector &u)
  {
    for (const auto &method : methods)
      {
        if (!method->is_active() || !method->augmented())
          continue;
        const auto &ranges = method->particles().ranges();
        for (unsigned int r = 0; r < ranges.size(); ++r)
          {
            const unsigned int k = active.position(ranges[r].cell);
            if (k == BackgroundGrid<dim>::nowhere)
              continue;
            gather(k, u, cell_u);
            method->update_multipliers(r, cell_u.data());
          }
      }
  }



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
    const Inertia<dim> *step_inertia = inertia;
    inertia                          = nullptr;
    assemble(zero, false, Part::material);
    inertia = step_inertia;
    const Vector forces(full_rest);
    assemble(zero, true, Part::boundaries);
    full_rest = forces;
    full_rest.update_ghost_values();
    for (auto &node : held)
      node.value = {};
    correct(true, w);
    accelerations = w;
    accelerations *= inertia->alpha();
    accelerations.update_ghost_values();
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
