// The functions of each basis on each kind of grid: partition of unity, linear
// fields from the nodes' places, gradients against difference quotients,
// continuity over faces, nodes that hold a side; the same on any number of
// ranks.

#include <iostream>

#include "basis_checks.h"

// Whether the functions of the nodes that hold side 0 are 1 in sum there.
template <int dim>
void check_side(const Basis<dim> &basis, Errors &errors, double &n_held)
{
  std::vector<char> held(basis.n_nodes(), false);
  for (const auto &node : basis.boundary_nodes(0))
    held[node.first] = true;
  for (unsigned int node = 0; node < basis.n_nodes(); ++node)
    n_held += held[node] && basis.owner(node) ==
                              Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  for (unsigned int c = 0; c < basis.grid().n_cells(); ++c)
    for (unsigned int f = 0; f < basis.grid().cell(c)->n_faces(); ++f)
      {
        const auto face = basis.grid().cell(c)->face(f);
        if (!basis.grid().is_owned(c) || !face->at_boundary() ||
            face->boundary_id() != 0)
          continue;
        std::vector<double> support(basis.support_size(c));
        basis.evaluate(c,
                       basis.grid().to_reference(c, face->center()),
                       support.data());
        double sum = 0;
        for (unsigned int a = 0; a < basis.n_nodes_of(c); ++a)
          sum += held[basis.nodes(c)[a]] ? support[a] : 0.;
        errors.side = std::max(errors.side, std::abs(sum - 1));
      }
}

template <int dim>
void test(const std::string &name, std::vector<std::string> entries)
{
  const MPI_Comm            comm = MPI_COMM_WORLD;
  const GridScene           scene(entries);
  const BackgroundGrid<dim> grid(scene.file, scene.parameters, comm);
  const Basis<dim>          basis(grid, scene.file, scene.parameters);
  Errors                    errors;
  double n_own = 0, index_sum = 0, n_held = 0, n_in_cells = 0;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_owned(c))
      {
        check_cell(basis, c, errors);
        n_in_cells += basis.n_nodes_of(c);
      }
  for (unsigned int node = 0; node < basis.n_nodes(); ++node)
    if (basis.owner(node) == Utilities::MPI::this_mpi_process(comm))
      {
        ++n_own;
        index_sum += coefficient(basis.point(node));
      }
  check_side(basis, errors, n_held);

  const auto root  = Utilities::MPI::this_mpi_process(comm) == 0;
  const auto bound = [&](const char *what, double error, const double limit) {
    error = Utilities::MPI::max(error, comm);
    if (root)
      std::cout << what << (error < limit ? " yes" : " no");
  };
  for (double *sum : {&n_own, &index_sum, &n_held, &n_in_cells})
    *sum = Utilities::MPI::sum(*sum, comm);
  if (root)
    std::cout << name << ", " << basis.name() << ": " << n_own << " nodes ("
              << n_held << " on a side), " << n_in_cells << " in cells, sum "
              << index_sum;
  bound("; unity", errors.one, 1e-12);
  bound(" linear", errors.linear, 1e-12);
  bound(" gradient", errors.gradient, 1e-5);
  bound(" continuous", errors.jump, 1e-12);
  bound(" smooth", errors.kink, 1e-11);
  if (basis.can_hold(0))
    bound(" held", errors.side, 1e-12);
  if (root)
    std::cout << std::endl;
}

int main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string box2  = "Grid/Generator = subdivided_hyper_rectangle";
  const std::string size2 = "Grid/Arguments = 5, 4 : 0, 0 : 1.5, 1 : true";
  const std::string size3 =
    "Grid/Arguments = 4, 3, 2 : 0,0,0 : 1.2, 1, 1 : true";
  for (const std::string kind :
       {"linear", "quadratic", "quadratic spline", "cubic spline"})
    {
      const std::string b = "Grid/Basis = " + kind;
      test<2>("rotated",
              {b, box2, size2, "Grid/Rotation = 30", "Grid/Shift = 1, -2"});
      test<2>("L",
              {b,
               "Grid/Generator = hyper_L",
               "Grid/Arguments = -1 : 1 : false",
               "Grid/Refinements = 2"});
      test<2>("one cell", {b, "Grid/Arguments = 0 : 1 : true"});
      test<3>("box",
              {b, box2, size3, "Grid/Rotation = 40", "Grid/Axis = 1, 2, 3"});
    }
  for (const std::string kind : {"linear", "quadratic"})
    {
      const std::string b = "Grid/Basis = " + kind;
      test<2>("distorted", {b, box2, size2, "Grid/Distortion = 0.2"});
      test<2>("refined", {b, box2, size2, "Grid/Refine where = x - 0.7"});
      test<2>("triangles", {b, box2, size2, "Grid/Cells = triangles"});
      test<3>("refined box", {b, box2, size3, "Grid/Refine where = x - 0.7"});
      test<3>("tetrahedra", {b, box2, size3, "Grid/Cells = tetrahedra"});
    }
}
