// A block in a grid of active cells, and the values of a linear field at the
// nodes of one of them.
#ifndef tests_terms_term_scene_h
#define tests_terms_term_scene_h

#include <impoint/base/parameter_file.h>
#include <impoint/setup.h>
#include <impoint/terms/term.h>

#include <cmath>
#include <string>
#include <vector>

using namespace Impoint;

template <int dim>
struct TermScene
{
  TermScene(const std::string &cells, const std::string &settings)
    : file("",
           {"Grid/Generator = subdivided_hyper_rectangle",
            std::string("Grid/Arguments = ") +
              (dim == 2 ? "6, 6 : -3, -3 : 3, 3" :
                          "6, 6, 6 : -3, -3, -3 : 3, 3, 3"),
            "Grid/Cells = " + cells,
            settings,
            "Bodies/Names = block",
            "Bodies/block/Mesh/Generator = subdivided_hyper_rectangle",
            std::string("Bodies/block/Mesh/Arguments = ") +
              (dim == 2 ? "3, 3 : -1, -1 : 0.7, 0.6" :
                          "3, 3, 3 : -1, -1, -1 : 0.7, 0.6, 0.4"),
            "Bodies/block/Density = 7",
            "Bodies/block/Material/Young's modulus = 5",
            "Time/Kind = dynamic"})
    , scene(file)
    , grid(file, scene.grid, MPI_COMM_WORLD)
    , basis(grid, file, scene.grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
  {
    std::vector<unsigned int> all(grid.n_cells());
    for (unsigned int c = 0; c < all.size(); ++c)
      all[c] = c;
    active.reinit(points->cells(), all);
  }

  ParameterFile                        file;
  const Scene<dim>                     scene;
  BackgroundGrid<dim>                  grid;
  Basis<dim>                           basis;
  ActiveNodes<dim>                     active;
  std::unique_ptr<MaterialPoints<dim>> points;
};

// A system of active cell k with the values A x + a at its nodes.
template <int dim>
struct LinearCell
{
  LinearCell(const TermScene<dim> &scene,
             const unsigned int    k,
             const Tensor<2, dim> &A,
             const Tensor<1, dim> &a)
  {
    const auto nodes = scene.active.nodes(k);
    for (const unsigned int node : nodes)
      {
        const Tensor<1, dim> value =
          A * scene.basis.point(scene.active.grid_node(node)) + a;
        values.insert(values.end(), value.begin_raw(), value.end_raw());
      }
    residual.assign(values.size(), 0.);
    matrix.assign(values.size() * values.size(), 0.);
    system = {unsigned(nodes.size()),
              values.data(),
              residual.data(),
              matrix.data()};
  }

  // largest entry of factor * matrix * values - residual
  double linearity_error(const double factor) const
  {
    double worst = 0;
    for (unsigned int i = 0; i < values.size(); ++i)
      {
        double sum = -residual[i];
        for (unsigned int j = 0; j < values.size(); ++j)
          sum += factor * values[j] *
                 matrix[((i / dim) * system.n + j / dim) * dim * dim +
                        (i % dim) * dim + j % dim];
        worst = std::max(worst, std::abs(sum));
      }
    return worst;
  }

  std::vector<double> values, residual, matrix;
  CellSystem          system;
};

#endif
