// Points at the quadrature points of body meshes: every kind of cell and rule,
// one point on faces of the grid, points outside of it.
#include "seeding_scene.h"

// Number of points, volume, centroid; if not 0, polar moment about it.
template <int dim>
void test(const std::string &name,
          const std::string &entries,
          const unsigned int n_points,
          const double       volume,
          const Point<dim>  &centroid,
          const double       moment)
{
  const SeedingScene        scene(entries, dim);
  const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto                points = seed_body(scene.file, scene.body, grid);

  double error = disorder(points, grid);
  error += std::abs(sum_of(points, [](const auto &) { return 1.; }) - n_points);
  error +=
    std::abs(sum_of(points, [](const auto &p) { return p.volume; }) - volume);
  for (unsigned int d = 0; d < dim; ++d)
    error += std::abs(sum_of(points, [&](const auto &p) {
      return p.volume * (p.x[d] - centroid[d]);
    }));
  if (moment > 0)
    error += std::abs(sum_of(points,
                             [&](const auto &p) {
                               return p.volume * (p.x - centroid).norm_square();
                             }) -
                      moment);
  print_bound(name, error, 1e-12);
}

void test_2d()
{
  // A rectangle of 2 x 1 turned about its centre.
  const std::string scene =
    "Grid/Arguments = -1 : 3 & Grid/Refinements = 4 & "
    "b/m/Generator = subdivided_hyper_rectangle & b/m/Arguments = 4, 2 : -1, "
    "-0.5 : 1, 0.5 & b/m/Rotation = 40 & b/m/Shift = 1, 0.5 & ";
  const Point<2> centre(1, 0.5);
  const double   moment = 2. * (4 + 1) / 12;
  test<2>(
    "quadrilaterals, 1", scene + "b/Points per direction = 1", 8, 2, centre, 0);
  test<2>("quadrilaterals, 4 x 4",
          scene + "b/Points per direction = 4 & Grid/Cells = triangles",
          128,
          2,
          centre,
          moment);
  for (const unsigned int n : {3, 6, 7, 12, 16})
    test<2>("triangles, " + std::to_string(n),
            scene +
              "b/m/Cells = triangles & b/m/Distortion = 0.2 & "
              "b/Points per simplex = " +
              std::to_string(n),
            16 * n,
            2,
            centre,
            moment);
  test<2>(
    "on faces",
    "Grid/Generator = subdivided_hyper_cube & Grid/Arguments = 6 : 0 : 3 & "
    "b/m/Generator = subdivided_hyper_cube & b/m/Arguments = 3 : 0 : 3 & "
    "b/Points per direction = 1",
    9,
    9,
    Point<2>(1.5, 1.5),
    0);
}

void test_3d()
{
  const std::string scene =
    "Grid/Arguments = -1 : 1 & Grid/Refinements = 3 & b/m/Rotation = 25 & "
    "b/m/Generator = subdivided_hyper_cube & b/m/Arguments = 2 : -0.5 : 0.5 & "
    "b/m/Axis = 1, 1, 0";
  test<3>("hexahedra", scene, 64, 1, Point<3>(), 0.25);
  for (const unsigned int n : {4, 8, 14, 24})
    test<3>("tetrahedra, " + std::to_string(n),
            scene + " & b/m/Cells = tetrahedra & b/Points per simplex = " +
              std::to_string(n),
            48 * n,
            1,
            Point<3>(),
            0.25);
  test<3>("24 tetrahedra",
          scene + " & b/m/Cells = 24 tetrahedra & Grid/Cells = tetrahedra",
          192 * 4,
          1,
          Point<3>(),
          0.25);
}

// Prints the first line of the message.
void test_error(const std::string &entries)
{
  try
    {
      const SeedingScene      scene(entries, 2);
      const BackgroundGrid<2> grid(scene.file, scene.grid, MPI_COMM_WORLD);
      seed_body(scene.file, scene.body, grid);
      std::cout << "no error" << std::endl;
    }
  catch (const InputError &error)
    {
      const std::string text = error.what();
      if (on_first_rank())
        std::cout << text.substr(0, text.find('\n')) << std::endl;
    }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_2d();
  test_3d();
  const std::string cube      = "b/m/Generator = hyper_cube & b/m/Arguments = ";
  const std::string rectangle = "b/m/Generator = hyper_rectangle & ";
  const std::string clipped   = "b/Points = clipped & b/Outline = ";
  test_error(cube + "0.5 : 1.5");
  test_error(clipped + "0.5 0.5; 1.5 0.5; 0.5 0.9");
  test_error("b/Outline = 0.5 0.5; 1.5 0.5; 0.5 0.9");
  test_error(clipped + "0 0; 1 1; 1 0; 0 1");
  test_error(clipped + "0 0; 1 1; 1 zero");
  test_error(clipped + "0 0; 1 1; 0 1 & " + cube + "0 : 1");
  test_error("b/m/Generator = hyper_rectangel");
  test_error(rectangle + "b/m/Arguments = 0 : 1 : 2");
  test_error("b/m/Generator = hyper_sphere & b/m/Arguments = 0, 0 : 1");
  test_error(cube + "0.2 : 0.6 & b/Points per simplex = 5");
  test_error(cube + "0 : 1 & b/m/Cells = tetrahedra");
  test_error("b/Density = 1");
}
