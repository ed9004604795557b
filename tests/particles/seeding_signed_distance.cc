// Bodies from a signed distance: area (volume) and second moment of a disk and
// a ball, cut from grids of any offset and rotation; their rates.

#include "seeding_scene.h"

template <int dim>
double error_of(const std::string &grid_entries, const std::string &rule)
{
  const double       radius = 0.7;
  const SeedingScene scene(
    "Grid/Generator = subdivided_hyper_rectangle & " + grid_entries +
      " & b/Points = clipped & b/Piece = gauss & b/Points per direction = " +
      rule + " & b/Signed distance = sqrt((x - 1)^2 + (y - 1)^2" +
      (dim == 3 ? " + (z - 1)^2" : "") + ") - 0.7",
    dim);
  const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto                points = seed_body(scene.file, scene.body, grid);
  const double              volume =
    sum_of(points, [](const auto &point) { return point.volume; });
  Point<dim> centre;
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = 1;
  const double moment = sum_of(points, [&](const auto &point) {
    return point.volume * (point.x - centre).norm_square();
  });
  // of a ball of radius 1: its surface over dim and dim + 2
  const double surface = dim == 2 ? 2 * numbers::PI : 4 * numbers::PI;
  return disorder(points, grid) +
         std::abs(volume * dim / (surface * std::pow(radius, dim)) - 1) +
         std::abs(moment * (dim + 2) / (surface * std::pow(radius, dim + 2)) -
                  1);
}

template <int dim>
void test(const std::string &name, const std::string &cells)
{
  const std::string grid   = "Grid/Arguments = " + cells;
  const std::string finer  = " & Grid/Refinements = ";
  const double      coarse = error_of<dim>(grid, "3"),
               fine = error_of<dim>(grid + finer + (dim == 2 ? "2" : "1"), "3");
  print_bound(name + ", coarse", coarse, 2e-3);
  print_bound(name + ", fine", fine, 2e-5);
  print_bound(name + ", 1 over the ratio", fine / coarse, 0.15);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>("disk", "9, 9 : -0.03, 0.01 : 2.2, 2.1");
  test<2>("disk, rotated", "12, 12 : 0, -1 : 3, 2 & Grid/Rotation = 20");
  test<2>("disk, triangles",
          "9, 9 : -0.03, 0.01 : 2.2, 2.1 & Grid/Cells = triangles");
  test<2>("disk, distorted",
          "9, 9 : -0.03, 0.01 : 2.2, 2.1 & Grid/Distortion = 0.2");
  test<3>("ball", "7, 7, 7 : -0.03, 0.01, 0.05 : 2.2, 2.1, 2.1");
  test<3>("ball, tetrahedra",
          "5, 5, 5 : -0.03, 0.01, 0.05 : 2.2, 2.1, 2.1 & "
          "Grid/Cells = tetrahedra");
}
