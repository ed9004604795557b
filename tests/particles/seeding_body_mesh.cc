// Points at the quadrature points of body meshes: every kind of cell and rule,
// one point on faces of the grid, points outside of it.
#include "seeding_scene.h"

const std::string body = "Bodies/body/";

template <int dim>
void test(const std::string              &name,
          const std::vector<std::string> &entries,
          const unsigned int              n_points,
          const double                    volume,
          const Point<dim>               &centroid,
          const double                    second_moment)
{
  Scene                     scene(entries, dim);
  const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto                points = seed_body(scene.file, scene.body, grid);

  double error = in_order(points, grid) ? 0 : 1;
  error +=
    std::abs(sum_of(points, [](const auto &p) { return p.volume; }) - volume);
  for (unsigned int d = 0; d < dim; ++d)
    error += std::abs(sum_of(points, [&](const auto &p) {
      return p.volume * (p.x[d] - centroid[d]);
    }));
  if (second_moment > 0)
    error += std::abs(sum_of(points,
                             [&](const auto &p) {
                               return p.volume * (p.x - centroid).norm_square();
                             }) -
                      second_moment);
  error += std::abs(sum_of(points, [](const auto &) { return 1.; }) - n_points);
  print_bound(name, error, 1e-12);
}

void test_2d()
{
  // A rectangle of 2 x 1 with its centre at (1, 0.5), turned about it by 40
  // degrees; its polar moment is 2 (4 + 1) / 12.
  const std::vector<std::string> grid      = {"Grid/Arguments = -1 : 3",
                                              "Grid/Refinements = 4"};
  const std::vector<std::string> rectangle = {
    body + "Mesh/Generator = subdivided_hyper_rectangle",
    body + "Mesh/Arguments = 4, 2 : -1, -0.5 : 1, 0.5",
    body + "Mesh/Rotation = 40",
    body + "Mesh/Shift = 1, 0.5"};
  const Point<2> centre(1, 0.5);
  const double   moment = 10. / 12;
  test<2>("quadrilaterals, 1",
          grid + rectangle +
            std::vector<std::string>{body + "Points per direction = 1"},
          8,
          2,
          centre,
          0);
  test<2>("quadrilaterals, 4x4",
          grid + rectangle +
            std::vector<std::string>{body + "Points per direction = 4",
                                     "Grid/Cells = triangles"},
          128,
          2,
          centre,
          moment);
  for (const unsigned int n : {3, 6, 7, 12, 16})
    test<2>("triangles, " + std::to_string(n),
            grid + rectangle +
              std::vector<std::string>{body + "Points per simplex = " +
                                         std::to_string(n),
                                       body + "Mesh/Cells = triangles",
                                       body + "Mesh/Distortion = 0.2"},
            16 * n,
            2,
            centre,
            moment);
  test<2>("on faces",
          {"Grid/Generator = subdivided_hyper_cube",
           "Grid/Arguments = 6 : 0 : 3",
           body + "Mesh/Generator = subdivided_hyper_cube",
           body + "Mesh/Arguments = 3 : 0 : 3",
           body + "Points per direction = 1"},
          9,
          9,
          Point<2>(1.5, 1.5),
          0);
}

void test_3d()
{
  const std::vector<std::string> entries = {
    "Grid/Arguments = -1 : 1",
    "Grid/Refinements = 3",
    body + "Mesh/Generator = subdivided_hyper_cube",
    body + "Mesh/Arguments = 2 : -0.5 : 0.5",
    body + "Mesh/Rotation = 25",
    body + "Mesh/Axis = 1, 1, 0"};
  test<3>("hexahedra", entries, 64, 1, Point<3>(), 0.25);
  for (const unsigned int n : {4, 8, 14, 24})
    test<3>("tetrahedra, " + std::to_string(n),
            entries +
              std::vector<std::string>{body + "Points per simplex = " +
                                         std::to_string(n),
                                       body + "Mesh/Cells = tetrahedra"},
            48 * n,
            1,
            Point<3>(),
            0.25);
  test<3>("24 tetrahedra",
          entries +
            std::vector<std::string>{body + "Mesh/Cells = 24 tetrahedra",
                                     "Grid/Cells = tetrahedra"},
          192 * 4,
          1,
          Point<3>(),
          0.25);
}

void test_errors()
{
  const std::vector<std::vector<std::string>> scenes = {
    {body + "Mesh/Generator = hyper_cube", body + "Mesh/Arguments = 0.5 : 1.5"},
    {body + "Outline = 0.5 0.5; 1.5 0.5; 0.5 0.9", body + "Points = clipped"},
    {body + "Outline = 0.5 0.5; 1.5 0.5; 0.5 0.9"},
    {body + "Outline = 0 0; 1 1; 1 0; 0 1", body + "Points = clipped"},
    {body + "Outline = 0 0; 1 1; 1 zero", body + "Points = clipped"},
    {body + "Mesh/Generator = hyper_rectangel"},
    {body + "Mesh/Generator = hyper_rectangle",
     body + "Mesh/Arguments = 0 : 1 : 2"},
    {body + "Mesh/Generator = hyper_sphere",
     body + "Mesh/Arguments = 0, 0 : 1"},
    {body + "Mesh/Generator = hyper_cube",
     body + "Mesh/Arguments = 0.2 : 0.6",
     body + "Points per simplex = 5"},
    {body + "Mesh/Generator = hyper_cube",
     body + "Mesh/Arguments = 0 : 1",
     body + "Mesh/Cells = tetrahedra"}};
  for (const auto &entries : scenes)
    try
      {
        Scene                   scene(entries, 2);
        const BackgroundGrid<2> grid(scene.file, scene.grid, MPI_COMM_WORLD);
        seed_body(scene.file, scene.body, grid);
        if (on_first_rank())
          std::cout << "no error" << std::endl;
      }
    catch (const InputError &error)
      {
        if (on_first_rank())
          std::cout << error.what() << std::endl;
      }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_2d();
  test_3d();
  test_errors();
}
