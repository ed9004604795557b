// Ghost penalty: polynomials of the basis' degree have no force, the force is
// the matrix times the values, and a wave costs what the integral says, times
// the factor, or 1 at faces of cells without material (most here).

#include <impoint/terms/ghost_penalty.h>

#include <iostream>

#include "term_scene.h"

template <int dim>
void test(const std::string &cells, const std::string &basis)
{
  TermScene<dim>    scene(cells, "Grid/Basis = " + basis);
  GhostPenalty<dim> ghost(scene.active, *scene.points);
  ghost.set_factor(0.3);
  std::vector<unsigned int> all(scene.grid.n_cells());
  for (unsigned int c = 0; c < all.size(); ++c)
    all[c] = c;
  scene.active.reinit(scene.points->cells(), all, [&]() {
    Links links;
    ghost.find_links(links);
    return links;
  });
  ghost.new_active_set();

  const unsigned int degree = scene.basis.degree();
  double             smooth = 0, linear = 0, energy = 0;
  for (unsigned int l = 0; l < ghost.n_links(); ++l)
    {
      const auto nodes = scene.active.nodes(ghost.group(l));
      for (const bool kinked : {false, true})
        {
          std::vector<double> values(nodes.size() * dim, 0.),
            residual(values.size(), 0.),
            matrix(values.size() * values.size(), 0.);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            {
              const Point<dim> x =
                scene.basis.point(scene.active.grid_node(nodes[a]));
              values[a * dim] = std::pow(0.3 * x[0] + 0.2 * x[1], degree) + 1;
              if (kinked)
                values[a * dim] = std::sin(3 * x[0] + x[dim - 1]);
            }
          CellSystem system{unsigned(nodes.size()),
                            values.data(),
                            residual.data(),
                            matrix.data()};
          ghost.add(l, system);
          // at the grid's ends coefficients of splines are not the values
          bool inside = degree == 1;
          if (!inside)
            {
              inside = true;
              for (const unsigned int node : nodes)
                {
                  const Point<dim> x =
                    scene.basis.point(scene.active.grid_node(node));
                  for (unsigned int d = 0; d < dim; ++d)
                    inside &= std::abs(x[d]) < 2.9;
                }
            }
          for (unsigned int i = 0; i < values.size(); ++i)
            {
              if (!kinked && inside)
                smooth = std::max(smooth, std::abs(residual[i]));
              else
                energy += 0.5 * values[i] * residual[i];
              double difference = residual[i];
              for (unsigned int j = 0; j < values.size(); ++j)
                difference -=
                  values[j] *
                  matrix[((i / dim) * nodes.size() + j / dim) * dim * dim +
                         (i % dim) * dim + j % dim];
              linear = std::max(linear, std::abs(difference));
            }
        }
    }
  std::cout << dim << "D, " << cells << ", " << basis << ": " << ghost.n_links()
            << " faces, polynomials without force: "
            << (smooth < 1e-12 ? "yes" : std::to_string(smooth))
            << ", matrix: " << (linear < 1e-12 ? "yes" : std::to_string(linear))
            << ", energy of a wave " << energy << std::endl;
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string basis : {"linear", "quadratic spline"})
    test<2>("as made", basis);
  test<2>("triangles", "linear");
  test<3>("as made", "linear");
  test<3>("tetrahedra", "linear");
}
