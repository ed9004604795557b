// Whole steps of ours beside those of the straightforward way with deal.II: a
// ParticleHandler sorted each step, FEValues built for each cell's points, sums
// over shape functions of symmetric gradients, distribute_local_to_global()
// into a Trilinos matrix with a new pattern each step, UMFPACK. It is the
// oracle, too: both must move all points alike. Not a test; run by hand:
//   OPENBLAS_NUM_THREADS=1 straightforward
// Exits with 1 if displacements differ or a step is less than 5 times faster.
// As 'straightforward --small' it compares displacements of small blocks only.

#include <impoint/solver/motion.h>
#include <impoint/solver/newton.h>
#include <impoint/terms/body_force.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/particles/particle_handler.h>
#include <deal.II/physics/elasticity/standard_tensors.h>

#include <cstdio>
#include <string>

#include "box.h"

// A block stands on a clamped floor; its weight grows from step to step. Soft
// enough that points change their cells, and not so soft that any come into
// new ones alone: such a cell we stabilise.
constexpr double density = 1000, poisson = 0.3, gravity = 9.81;
template <int dim>
constexpr double young = dim == 2 ? 1e6 : 2.5e5;

template <int dim>
std::vector<std::string> block(const unsigned int cells, const unsigned int n)
{
  // free space on all sides but the floor
  std::string counts, lower, upper, ones, zeros, unit;
  for (unsigned int d = 0; d < dim; ++d)
    {
      const std::string comma = d == 0 ? "" : ", ";
      const bool        up    = d == 1;
      counts += comma + std::to_string(cells + cells / (up ? 4 : 2));
      lower += comma + (up ? "0" : "-0.25");
      upper += comma + "1.25";
      unit += comma + std::to_string(cells);
      zeros += comma + "0";
      ones += comma + "1";
    }
  const std::string body = "Bodies/box/", floor = "Boundaries/floor/";
  return {"Dimension = " + std::to_string(dim),
          "Grid/Generator = subdivided_hyper_rectangle",
          "Grid/Arguments = " + counts + " : " + lower + " : " + upper +
            " : true",
          "Bodies/Names = box",
          body + "Density = " + std::to_string(density),
          body + "Points per direction = " + std::to_string(n),
          body + "Mesh/Generator = subdivided_hyper_rectangle",
          body + "Mesh/Arguments = " + unit + " : " + zeros + " : " + ones,
          body + "Body force = 0; -9.81 * t" + (dim == 3 ? "; 0" : ""),
          body + "Material/Model = linear elastic",
          body + "Material/Young's modulus = " + std::to_string(young<dim>),
          body + "Material/Poisson's ratio = " + std::to_string(poisson),
          "Boundaries/Names = floor",
          floor + "Kind = conforming",
          floor + "Boundary id = 2",
          floor + "Constraint = fixed"};
}

// What Simulation does in a quasi-static step, without output.
template <int dim>
class Ours
{
public:
  Ours(const unsigned int cells, const unsigned int points_per_direction)
    : file("", block<dim>(cells, points_per_direction))
    , scene(file)
    , grid(file, scene.grid, MPI_COMM_WORLD)
    , basis(grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
    , conforming(basis)
    , system(active,
             *points,
             methods,
             conforming,
             scene.linear_solver,
             counters,
             seconds)
    , newton(scene.newton, system, counters)
  {
    conforming.add_boundary(file, scene.conditions[0], scene.boundaries[0]);
    system.add_term(std::make_unique<InternalForce<dim>>(*points));
    body_loads.push_back(
      {Expression<dim>(file, scene.bodies[0].section + "/Body force", dim)});
  }

  void step(const double start, const double end)
  {
    const bool changed = active.reinit(points->cells(), {});
    if (changed)
      system.new_active_set();
    if (changed || moved)
      system.find_starved_cells();
    system.begin_step(start,
                      end,
                      body_force(*points, active, body_loads, end),
                      nullptr);
    u.reinit(active.unknowns());
    u.update_ghost_values();
    newton.solve(u);
    new_places(*points, active, u, places);
    points->find(places, "point");
    update_points<dim>(active, u, nullptr, EndStates<dim>(), *points);
    moved = points->move();
  }

  ParameterFile                          file;
  Scene<dim>                             scene;
  BackgroundGrid<dim>                    grid;
  Basis<dim>                             basis;
  ActiveNodes<dim>                       active;
  std::unique_ptr<MaterialPoints<dim>>   points;
  Enforcement::Conforming<dim>           conforming;
  typename NonlinearSystem<dim>::Methods methods;
  Counters                               counters;
  Seconds                                seconds;
  NonlinearSystem<dim>                   system;
  Newton<dim>                            newton;
  std::vector<BodyLoad<dim>>             body_loads;
  typename NonlinearSystem<dim>::Vector  u;
  std::vector<Point<dim>>                places;
  bool                                   moved = false;
};

template <int dim>
class Straightforward
{
public:
  static constexpr unsigned int n_stress =
    SymmetricTensor<2, dim>::n_independent_components;

  explicit Straightforward(const Ours<dim> &ours)
    : fe(FE_Q<dim>(1), dim)
    , dofs(ours.grid.triangulation())
    , particles(ours.grid.triangulation(),
                ours.grid.mapping(),
                1 + n_stress + dim)
    , mapping(ours.grid.mapping())
    , C(2 * mu * Physics::Elasticity::StandardTensors<dim>::S +
        lambda * Physics::Elasticity::StandardTensors<dim>::IxI)
  {
    dofs.distribute_dofs(fe);
    DoFTools::make_zero_boundary_constraints(dofs, 2, clamp);
    const auto &points = *ours.points;
    for (const auto &range : points.ranges())
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          std::vector<double> properties(1 + n_stress + dim, 0.);
          properties[0] = points.data(p)[points.slots().volume];
          particles.insert_particle(
            points.position(p),
            mapping.transform_real_to_unit_cell(ours.grid.cell(range.cell),
                                                points.position(p)),
            points.id(p),
            ours.grid.cell(range.cell),
            properties);
        }
    particles.update_cached_numbers();
  }

  void step(const double time)
  {
    particles.sort_particles_into_subdomains_and_cells();
    set_up();
    for (const auto &cell : dofs.active_cell_iterators())
      if (particles.n_particles_in_cell(cell) > 0)
        assemble(cell, time);
    matrix.compress(VectorOperation::add);

    SparsityPattern pattern;
    pattern.copy_from(sparsity);
    SparseMatrix<double> serial(pattern);
    serial.copy_from(matrix);
    for (const auto &line : constraints.get_lines())
      serial.diag_element(line.index) = 1; // no cell contributed to most
    SparseDirectUMFPACK umfpack;
    umfpack.initialize(serial);
    umfpack.vmult(u, right);
    constraints.distribute(u);
    for (const auto &cell : dofs.active_cell_iterators())
      if (particles.n_particles_in_cell(cell) > 0)
        update(cell);
  }

  /** Largest difference to ours, relative to the largest displacement. */
  double difference(const MaterialPoints<dim> &points) const
  {
    std::vector<Tensor<1, dim>> displacements(points.n());
    for (const auto &particle : particles)
      for (unsigned int d = 0; d < dim; ++d)
        displacements[particle.get_id()][d] =
          particle.get_properties()[1 + n_stress + d];
    double worst = 0, largest = 0;
    for (unsigned int p = 0; p < points.n(); ++p)
      {
        const auto &expected = displacements[points.id(p)];
        worst =
          std::max(worst,
                   (points.vector(p, points.slots().u) - expected).norm());
        largest = std::max(largest, expected.norm());
      }
    return particles.n_global_particles() == points.n_global() ?
             worst / largest :
             std::numeric_limits<double>::max();
  }

private:
  using Cell = typename DoFHandler<dim>::active_cell_iterator;

  static constexpr double mu     = young<dim> / (2 * (1 + poisson));
  static constexpr double lambda = 2 * mu * poisson / (1 - 2 * poisson);

  /** Unknowns without material are held at zero. */
  void set_up()
  {
    std::vector<bool>                    used(dofs.n_dofs(), false);
    std::vector<types::global_dof_index> indices(fe.n_dofs_per_cell());
    for (const auto &cell : dofs.active_cell_iterators())
      if (particles.n_particles_in_cell(cell) > 0)
        {
          cell->get_dof_indices(indices);
          for (const auto i : indices)
            used[i] = true;
        }
    constraints.clear();
    constraints.merge(clamp);
    for (types::global_dof_index i = 0; i < dofs.n_dofs(); ++i)
      if (!used[i] && !constraints.is_constrained(i))
        constraints.add_line(i);
    constraints.close();
    sparsity.reinit(dofs.n_dofs(), dofs.n_dofs());
    DoFTools::make_sparsity_pattern(dofs, sparsity, constraints, true);
    matrix.reinit(complete_index_set(dofs.n_dofs()), sparsity, MPI_COMM_WORLD);
    right.reinit(dofs.n_dofs());
    u.reinit(dofs.n_dofs());
  }

  std::unique_ptr<FEValues<dim>> values_at_points(const Cell &cell)
  {
    std::vector<Point<dim>> places;
    for (const auto &particle : particles.particles_in_cell(cell))
      places.push_back(particle.get_reference_location());
    auto values = std::make_unique<FEValues<dim>>(
      mapping, fe, Quadrature<dim>(places), update_values | update_gradients);
    values->reinit(cell);
    return values;
  }

  void assemble(const Cell &cell, const double time)
  {
    const auto                       values = values_at_points(cell);
    const FEValuesExtractors::Vector displacement(0);
    const unsigned int               n = fe.n_dofs_per_cell();
    FullMatrix<double>               K(n, n);
    Vector<double>                   f(n);
    unsigned int                     q = 0;
    for (const auto &particle : particles.particles_in_cell(cell))
      {
        const auto              properties = particle.get_properties();
        const double            volume     = properties[0];
        SymmetricTensor<2, dim> stress;
        for (unsigned int k = 0; k < n_stress; ++k)
          stress.access_raw_entry(k) = properties[1 + k];
        for (unsigned int i = 0; i < n; ++i)
          {
            const SymmetricTensor<2, dim> eps_i =
              (*values)[displacement].symmetric_gradient(i, q);
            for (unsigned int j = 0; j < n; ++j)
              K(i, j) += eps_i * C *
                         (*values)[displacement].symmetric_gradient(j, q) *
                         volume;
            f(i) -= volume * (eps_i * stress);
            f(i) -= volume * density * gravity * time *
                    (*values)[displacement].value(i, q)[1];
          }
        ++q;
      }
    std::vector<types::global_dof_index> indices(n);
    cell->get_dof_indices(indices);
    constraints.distribute_local_to_global(K, indices, matrix);
    constraints.distribute_local_to_global(f, indices, right);
  }

  void update(const Cell &cell)
  {
    const auto                           values = values_at_points(cell);
    const FEValuesExtractors::Vector     displacement(0);
    std::vector<Tensor<1, dim>>          moved(values->n_quadrature_points);
    std::vector<SymmetricTensor<2, dim>> strains(values->n_quadrature_points);
    (*values)[displacement].get_function_values(u, moved);
    (*values)[displacement].get_function_symmetric_gradients(u, strains);
    unsigned int q = 0;
    for (auto &particle : particles.particles_in_cell(cell))
      {
        auto       properties = particle.get_properties();
        const auto stress     = C * strains[q];
        for (unsigned int k = 0; k < n_stress; ++k)
          properties[1 + k] += stress.access_raw_entry(k);
        for (unsigned int d = 0; d < dim; ++d)
          properties[1 + n_stress + d] += moved[q][d];
        particle.set_location(particle.get_location() + moved[q]);
        ++q;
      }
  }

  FESystem<dim>                   fe;
  DoFHandler<dim>                 dofs;
  Particles::ParticleHandler<dim> particles;
  const Mapping<dim>             &mapping;
  const SymmetricTensor<4, dim>   C;
  AffineConstraints<double>       clamp, constraints;
  DynamicSparsityPattern          sparsity;
  TrilinosWrappers::SparseMatrix  matrix;
  Vector<double>                  right, u;
};

template <int dim>
bool compare(const unsigned int cells,
             const unsigned int points_per_direction,
             const bool         time_counts)
{
  Ours<dim>            ours(cells, points_per_direction);
  Straightforward<dim> theirs(ours);
  std::printf("%dD, %u points\n", dim, ours.points->n());
  bool passed = true;
  for (const unsigned int step : {1, 2})
    {
      const double t_ours   = seconds_of([&] { ours.step(step - 1., step); });
      const double t_theirs = seconds_of([&] { theirs.step(step); });
      const double unlike   = theirs.difference(*ours.points);
      std::printf(
        "  step %u, %u unknowns: ours %.3f s, straightforward %.3f s, "
        "%.1f times faster; displacements differ by %.1e, points "
        "change cells: %s\n",
        step,
        static_cast<unsigned int>(ours.active.unknowns()->size()),
        t_ours,
        t_theirs,
        t_theirs / t_ours,
        unlike,
        ours.moved ? "yes" : "no");
      passed &= (t_theirs >= 5 * t_ours || !time_counts) && unlike < 1e-10;
    }
  return passed;
}

int main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc > 1 && std::string(argv[1]) == "--small")
    return compare<2>(16, 2, false) && compare<3>(4, 3, false) ? 0 : 1;
  const bool plane = compare<2>(160, 2, true);
  const bool space = compare<3>(16, 3, true);
  return plane && space ? 0 : 1;
}
