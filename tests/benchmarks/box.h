// A box full of material points that the benchmarks assemble on.
#ifndef tests_benchmarks_box_h
#define tests_benchmarks_box_h

#include <impoint/base/parameter_file.h>
#include <impoint/scene.h>
#include <impoint/setup.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

using namespace Impoint;

// Processor seconds that f takes: other programs may share the machine.
template <typename Function>
double seconds_of(const Function &f)
{
  const std::clock_t start = std::clock();
  f();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

// The least of what a repeated measurement gave: what other programs on the
// machine disturb least.
struct Least
{
  template <typename Function>
  void time(const Function &f)
  {
    seconds = std::min(seconds, seconds_of(f));
  }

  double seconds = std::numeric_limits<double>::max();
};

// A unit box of cells^dim cells with 2^dim points each, moved off their places
// by up to a tenth of a cell. Dynamic, for points of the usual size.
template <int dim>
struct Box
{
  using Vector = LinearAlgebra::distributed::Vector<double>;

  Box(const unsigned int cells, const std::string &model)
    : file("", entries(cells, model))
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
  {
    scatter_points(0.1 / cells);
    active.reinit(points->cells(), {});
    system.add_term(std::make_unique<InternalForce<dim>>(*points));
    system.new_active_set();
    u.reinit(active.unknowns());
    system.begin_step(0, 1, u, nullptr);
    // small strains of all kinds, different everywhere
    for (unsigned int i = 0; i < active.n_nodes(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Point<dim> x = basis.point(active.grid_node(i));
          u.local_element(i * dim + d) =
            1e-3 * std::sin((d + 1) * x[0] + 2 * x[1] + 3 * x[dim - 1]);
        }
  }

  static std::vector<std::string> entries(const unsigned int cells,
                                          const std::string &model)
  {
    const std::string n    = std::to_string(cells);
    const std::string box  = dim == 2 ?
                               n + ", " + n + " : 0, 0 : 1, 1" :
                               n + ", " + n + ", " + n + " : 0, 0, 0 : 1, 1, 1";
    const std::string body = "Bodies/box/";
    return {"Dimension = " + std::to_string(dim),
            "Grid/Generator = subdivided_hyper_rectangle",
            "Grid/Arguments = " + box,
            "Bodies/Names = box",
            body + "Density = 1000",
            body + "Points per direction = 2",
            body + "Mesh/Generator = subdivided_hyper_rectangle",
            body + "Mesh/Arguments = " + box,
            body + "Material/Model = " + model,
            body + "Material/Young's modulus = 1e6",
            body + "Material/Poisson's ratio = 0.3",
            "Time/Kind = dynamic"};
  }

  void scatter_points(const double distance)
  {
    std::vector<Point<dim>> places(points->n());
    for (unsigned int p = 0; p < points->n(); ++p)
      {
        places[p] = points->position(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            places[p][d] += distance * std::sin(12.9898 * p + 78.233 * d);
            points->data(p)[points->slots().x + d] = places[p][d];
          }
      }
    points->find(places, "point");
    points->move();
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
  Vector                                 u;
};

#endif
