// Which cell holds a place: vertices, edges, faces, centres and random places
// of all kinds of grids, found with and without a hint; on any number of ranks
// each place belongs to one cell, and to the same one.

#include <cmath>
#include <iostream>
#include <map>
#include <random>

#include "basis_checks.h"

// Places by their rounded coordinates, so that each occurs once and in the same
// order on any number of ranks.
template <int dim>
using Places = std::map<std::array<long, dim>, Point<dim>>;

template <int dim>
Places<dim> all_places(const BackgroundGrid<dim> &grid)
{
  std::vector<Point<dim>> own;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_owned(c))
      {
        const auto &cell = grid.cell(c);
        own.push_back(cell->center());
        for (const Point<dim> &vertex : grid.vertices(c))
          own.push_back(vertex);
        for (unsigned int f = 0; f < cell->n_faces(); ++f)
          own.push_back(cell->face(f)->center());
        for (unsigned int l = 0; l < cell->n_lines(); ++l)
          own.push_back(cell->line(l)->center());
      }
  Places<dim> places;
  const auto  add = [&](const Point<dim> &x) {
    std::array<long, dim> key;
    for (unsigned int d = 0; d < dim; ++d)
      key[d] = std::lround(1e6 * x[d]);
    places.emplace(key, x);
  };
  for (const auto &of_rank : Utilities::MPI::all_gather(MPI_COMM_WORLD, own))
    for (const Point<dim> &x : of_rank)
      add(x);
  std::mt19937                           generator(1);
  std::uniform_real_distribution<double> share(0, 1);
  for (unsigned int i = 0; i < 200; ++i)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = grid.box().lower_bound(d) +
               share(generator) * grid.box().side_length(d);
      Point<dim> xi;
      if (Utilities::MPI::max(int(grid.find(x, xi) != grid.nowhere),
                              MPI_COMM_WORLD))
        add(x);
    }
  return places;
}

// Whether c is a cell that holds x, with the reference place xi.
template <int dim>
bool holds(const BackgroundGrid<dim> &grid,
           const unsigned int         c,
           const Point<dim>          &xi,
           const Point<dim>          &x)
{
  return c != grid.nowhere && grid.is_inside(xi, 1e-8) &&
         grid.to_reference(c, x).distance(xi) < 1e-12;
}

template <int dim>
void test(const std::string &name, const std::vector<std::string> &entries)
{
  const GridScene           scene(entries);
  const BackgroundGrid<dim> grid(scene.file, scene.parameters, MPI_COMM_WORLD);
  const auto                places = all_places(grid);
  unsigned int              start  = 0; // of walks
  while (start < grid.n_cells() && !grid.is_owned(start))
    ++start;
  unsigned int wrong_owners = 0, wrong_find = 0, wrong_walk = 0, i = 0;
  double       centres = 0;
  for (const auto &place : places)
    {
      const Point<dim>  &x = place.second;
      Point<dim>         xi;
      const unsigned int c   = grid.find(x, xi);
      const bool         own = c != grid.nowhere && grid.is_owned(c);
      if (own)
        // weights, lest two places could exchange their cells
        centres += (1 + std::sin(++i)) * coefficient(grid.cell(c)->center());
      wrong_find += c != grid.nowhere && !holds(grid, c, xi, x);
      wrong_owners += Utilities::MPI::sum(int(own), MPI_COMM_WORLD) != 1;
      i = Utilities::MPI::max(i, MPI_COMM_WORLD);
      if (!own)
        continue;
      for (const unsigned int from : {start, c})
        {
          const unsigned int reached = grid.walk(x, from, xi);
          wrong_walk += !holds(grid, reached, xi, x);
        }
    }
  unsigned int     outside_found = 0;
  Point<dim>       xi;
  const auto       corners = grid.box().get_boundary_points();
  const Point<dim> beyond =
    corners.second + 1e-3 * (corners.second - corners.first);
  const unsigned int from = start < grid.n_cells() ? start : 0;
  outside_found += grid.find(beyond, xi) != grid.nowhere;
  outside_found += grid.walk(beyond, from, xi) != grid.nowhere;

  centres       = Utilities::MPI::sum(centres, MPI_COMM_WORLD);
  wrong_find    = Utilities::MPI::sum(wrong_find, MPI_COMM_WORLD);
  wrong_walk    = Utilities::MPI::sum(wrong_walk, MPI_COMM_WORLD);
  outside_found = Utilities::MPI::sum(outside_found, MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << name << ": " << places.size() << " places; not in one cell "
              << wrong_owners << ", found wrongly " << wrong_find
              << ", walked wrongly " << wrong_walk << ", outside but found "
              << outside_found << ", their cells " << centres << std::endl;
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string box    = "Grid/Generator = subdivided_hyper_rectangle";
  const std::string square = "Grid/Arguments = 5, 4 : 0, 0 : 1, 1";
  const std::string cube   = "Grid/Arguments = 3, 4, 2 : 0, 0, 0 : 1, 1, 1";
  const std::string turned = "Grid/Rotation = 30", shifted = "Grid/Shift = ";
  const std::string distorted = "Grid/Distortion = 0.2";
  const std::string refined   = "Grid/Refine where = x - 0.4";
  test<2>("quads", {box, square});
  test<2>("turned", {box, square, turned, shifted + "-0.3, 0.1"});
  test<2>("distorted", {box, square, distorted});
  test<2>("refined", {box, square, refined, "Grid/Refine times = 2"});
  test<2>("triangles", {box, square, "Grid/Cells = triangles"});
  test<2>("distorted triangles",
          {box, square, distorted, "Grid/Cells = triangles"});
  test<3>("hexes", {box, cube});
  test<3>("turned hexes",
          {box, cube, turned, "Grid/Axis = 1, 2, 3", shifted + "-0.3, 0.1, 0"});
  test<3>("refined hexes", {box, cube, refined});
  test<3>("distorted tets", {box, cube, distorted, "Grid/Cells = tetrahedra"});
}
