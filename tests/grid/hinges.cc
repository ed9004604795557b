// Cells without material around vertices by which alone pieces of it hang
// together: the same on any number of ranks.

#include <impoint/grid/hinges.h>

#include <functional>
#include <iostream>

#include "basis_checks.h"

template <int dim>
using Region = std::function<bool(const Point<dim> &)>;

template <int dim>
void print(const std::string         &title,
           const BackgroundGrid<dim> &grid,
           const Region<dim>         &has_material)
{
  std::vector<unsigned int> material;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_owned(c) && has_material(grid.cell(c)->center()))
      material.push_back(c);
  Hinges<dim>    hinges(grid);
  Tensor<1, dim> sum;
  unsigned int   n_with = 0;
  for (const unsigned int c : hinges.cells_between(material))
    {
      sum += grid.cell(c)->center();
      n_with += has_material(grid.cell(c)->center()) ? 1 : 0;
    }
  const MPI_Comm comm = grid.communicator();
  const auto     n =
    Utilities::MPI::sum(hinges.cells_between(material).size(), comm);
  n_with = Utilities::MPI::sum(n_with, comm);
  sum    = Utilities::MPI::sum(sum, comm);
  if (Utilities::MPI::this_mpi_process(comm) != 0)
    return;
  std::cout << "  " << title << ": " << n << " cells between";
  if (n > 0)
    std::cout << " about (" << sum / double(n) << ")";
  std::cout << (n_with == 0 ? "" : ", with material") << std::endl;
}

// [lower, lower + size] in each direction, moved by @p shift
template <int dim>
Region<dim> box(const double               lower,
                const double               size,
                const std::vector<double> &shift = {})
{
  return [=](const Point<dim> &x) {
    bool inside = true;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double y = x[d] - lower - (d < shift.size() ? shift[d] : 0.);
        inside &= y > 0 && y < size;
      }
    return inside;
  };
}

template <int dim>
Region<dim> both(const Region<dim> &a, const Region<dim> &b)
{
  return [=](const Point<dim> &x) { return a(x) || b(x); };
}

template <int dim>
void test(const std::string &title, const std::vector<std::string> &entries)
{
  const GridScene           scene(entries);
  const BackgroundGrid<dim> grid(scene.file, scene.parameters, MPI_COMM_WORLD);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::cout << title << std::endl;
  const Region<dim> low = box<dim>(0, 0.5);
  print<dim>("one", grid, low);
  print<dim>("two at a vertex", grid, both(low, box<dim>(0.5, 0.5)));
  print<dim>("two at a face", grid, both(low, box<dim>(0, 0.5, {0.5})));
  if (dim == 3)
    print<dim>("two at an edge", grid, both(low, box<dim>(0, 0.5, {0.5, 0.5})));
  print<dim>("two apart", grid, both(box<dim>(0, 0.3), box<dim>(0.7, 0.3)));
  print<dim>("three at vertices",
             grid,
             both(both(box<dim>(0, 0.25), box<dim>(0.25, 0.5)),
                  box<dim>(0.75, 0.25)));
  print<dim>("none", grid, [](const Point<dim> &) { return false; });
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::vector<std::string>
    square        = {"Grid/Generator = subdivided_hyper_rectangle",
                     "Grid/Arguments = 8, 8 : 0, 0 : 1, 1"},
    cube          = {"Grid/Generator = subdivided_hyper_rectangle",
                     "Grid/Arguments = 4, 4, 4 : 0, 0, 0 : 1, 1, 1"};
  const auto with = [](std::vector<std::string> entries,
                       const std::string       &further) {
    entries.push_back(further);
    return entries;
  };
  test<2>("quadrilaterals", square);
  test<2>("triangles", with(square, "Grid/Cells = triangles"));
  test<2>("hanging nodes",
          with(square, "Grid/Refine where = if(x > 0.5, 1, 0)"));
  test<3>("hexahedra", cube);
  test<3>("tetrahedra", with(cube, "Grid/Cells = tetrahedra"));
}
