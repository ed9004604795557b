// A scene whose material moves as told instead of by equilibrium, so that every
// measurement has an exact value.
#ifndef tests_measurements_kinematics_h
#define tests_measurements_kinematics_h

#include <impoint/base/parameter_file.h>
#include <impoint/measurements/measurement.h>
#include <impoint/setup.h>

#include <cmath>
#include <functional>
#include <iostream>

using namespace Impoint;

using Entries = std::vector<std::string>;

inline Entries operator+(Entries left, const Entries &right)
{
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

template <int dim>
Entries square(const std::string &cells)
{
  const std::string n    = dim == 2 ? "16, 16" : "8, 8, 8";
  const std::string low  = dim == 2 ? "-4, -4" : "-4, -4, -4";
  const std::string high = dim == 2 ? "4, 4" : "4, 4, 4";
  const std::string m    = dim == 2 ? "4, 4" : "2, 2, 2";
  const std::string one  = dim == 2 ? "1, 1" : "1, 1, 1";
  const std::string zero = dim == 2 ? "-1, -1" : "-1, -1, -1";
  return {"Time/Kind = dynamic",
          "Grid/Generator = subdivided_hyper_rectangle",
          "Grid/Arguments = " + n + " : " + low + " : " + high,
          "Grid/Cells = " + cells,
          "Bodies/Names = block",
          "Bodies/block/Mesh/Generator = subdivided_hyper_rectangle",
          "Bodies/block/Mesh/Arguments = " + m + " : " + zero + " : " + one,
          "Bodies/block/Density = 1000",
          "Bodies/block/Initial velocity = " +
            std::string(dim == 2 ? "3; 4" : "3; 4; 0"),
          "Bodies/block/Material/Model = neo-Hookean",
          "Bodies/block/Material/Young's modulus = 1e3",
          "Bodies/block/Material/Poisson's ratio = 0.3"};
}

inline Entries measure(const std::string &name, const Entries &entries)
{
  Entries paths;
  for (const auto &entry : entries)
    paths.push_back("Measurements/" + name + "/" + entry);
  return paths;
}

template <int dim>
class Kinematics
{
public:
  explicit Kinematics(const Entries &entries)
    : file("", entries)
    , scene(file)
    , grid(file, scene.grid, MPI_COMM_WORLD)
    , basis(grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
    , stiffness(active, *points)
    , methods(place_boundaries(file, scene, basis, *points))
  {
    for (const auto &parameters : scene.measurements)
      measurements.push_back(Measurements::create<dim>(file, parameters));
    for (const auto &measurement : measurements)
      measurement->start(state());
  }

  // One step of 1 s with the displacement @p A x.
  void step(const Tensor<2, dim> &A)
  {
    active.reinit(points->cells(), {});
    Enforcement::Step<dim> step;
    step.start = time;
    step.end   = time + 1;
    stiffness.reinit();
    step.stiffness = &stiffness;
    step.active    = &active;
    for (const auto &method : methods)
      method->begin_step(step);
    if (time == 0)
      for (const auto &measurement : measurements)
        measurement->begin(state());
    time += 1;

    LinearAlgebra::distributed::Vector<double> u(active.unknowns());
    for (unsigned int i = 0; i < active.n_owned_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        u.local_element(dim * i + d) =
          (A * basis.point(active.grid_node(i)))[d];
    u.update_ghost_values();
    for (const auto &measurement : measurements)
      measurement->follow(state(), u);
    move(A);
    if (set_boundary)
      for (const auto &method : methods)
        set_boundary(method->particles());
    for (const auto &measurement : measurements)
      measurement->end_step(state());
  }

  std::vector<Result> results() const
  {
    std::vector<Result> all;
    for (const auto &measurement : measurements)
      measurement->results(all);
    return all;
  }

  std::vector<Measurements::BoundaryForce<dim>> forces;
  std::vector<double>                           residuals;
  VoigtVector<dim>                              stress    = {}; // Kirchhoff
  double                                        stress_zz = 0;

  // what a step leaves in the slots of boundary particles; nobody else does
  std::function<void(BoundaryParticles<dim> &)> set_boundary;

private:
  Measurements::State<dim> state() const
  {
    return {*points,
            methods,
            active,
            time,
            1.,
            forces,
            residuals,
            Measurements::totals(*points)};
  }

  void move(const Tensor<2, dim> &A)
  {
    const auto             &slots = points->slots();
    std::vector<Point<dim>> places;
    for (unsigned int p = 0; p < points->n(); ++p)
      {
        const Tensor<1, dim> du = A * points->position(p);
        const Tensor<2, dim> F  = points->deformation_gradient(p);
        const Tensor<2, dim> dF = A * F;
        places.push_back(points->position(p) + du);
        for (unsigned int i = 0; i < dim; ++i)
          {
            points->data(p)[slots.u + i] += du[i];
            for (unsigned int j = 0; j < dim; ++j)
              points->data(p)[slots.F + i * dim + j] += dF[i][j];
          }
        for (int k = 0; k < Voigt<dim>::n; ++k)
          points->data(p)[slots.stress + k] = stress[k];
        if (dim == 2)
          points->data(p)[slots.stress + Voigt<dim>::n] = stress_zz;
      }
    points->find(places, "material point");
    for (unsigned int p = 0; p < points->n(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        points->data(p)[slots.x + d] = places[p][d];
    points->move();
  }

  ParameterFile                                                file;
  const Scene<dim>                                             scene;
  BackgroundGrid<dim>                                          grid;
  Basis<dim>                                                   basis;
  ActiveNodes<dim>                                             active;
  std::unique_ptr<MaterialPoints<dim>>                         points;
  NearbyStiffness<dim>                                         stiffness;
  typename NonlinearSystem<dim>::Methods                       methods;
  double                                                       time = 0;
  std::vector<std::unique_ptr<Measurements::Measurement<dim>>> measurements;
};

inline bool on_first_rank()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

// Whether all results are their references, or zero.
template <int dim>
void compare(const std::string &title, const Kinematics<dim> &scene)
{
  if (!on_first_rank())
    return;
  std::cout << title << ": " << scene.results().size()
            << " results, errors below bound: ";
  std::string wrong;
  for (auto result : scene.results())
    {
      if (std::isnan(result.reference))
        result.reference = 0;
      if (!(result.error() < 1e-11))
        wrong += " " + result.name + " " + std::to_string(result.error());
    }
  std::cout << (wrong.empty() ? "yes" : "no:" + wrong) << std::endl;
}

template <int dim>
void print(const Kinematics<dim> &scene, const std::string &title = "")
{
  if (on_first_rank())
    for (const auto &result : scene.results())
      std::cout << title << result.name << " "
                << (std::abs(result.value) < 1e-12 ? 0. : result.value)
                << std::endl;
}

#endif
