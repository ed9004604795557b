// Particles on surfaces in 3D: areas and normals, on faces of the grid, of
// meshes of quadrilaterals and triangles.
#include "seeding_scene.h"

const std::string box = "Grid/Generator = subdivided_hyper_rectangle & "
                        "Grid/Arguments = 4, 4, 4 : 0, 0, 0 : 1, 1, 1 & ";

// Area, and sum of x . n A, which is 3 times the volume of a closed surface.
std::pair<double, double> sums_of(const std::string &entries, double &error)
{
  const SeedingScene      scene(box + entries, 3);
  const BackgroundGrid<3> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto particles = seed_boundary(scene.file, scene.boundary, grid);
  error += disorder(particles, grid);
  error += std::abs(
    sum_of(particles, [](const auto &p) { return p.normal.norm() - 1; }));
  return {sum_of(particles, [](const auto &p) { return p.area; }),
          sum_of(particles,
                 [](const auto &p) { return p.area * (p.x * p.normal); })};
}

void test(const std::string               &name,
          const std::string               &entries,
          const std::pair<double, double> &expected,
          const double                     bound)
{
  double error = 0;
  for (const std::string rule : {"equal", "gauss", "cut"})
    {
      const auto sums =
        sums_of(entries + " & w/Particles per segment = 3 & w/Rule = " + rule,
                error);
      error += std::abs(sums.first - expected.first) +
               std::abs(sums.second - expected.second);
    }
  print_bound(name, error, bound);
}

void test_sphere(const std::string &cells)
{
  const std::string sphere =
    "w/m/Generator = hyper_sphere & w/m/Arguments = 0.5, 0.5, 0.5 : 0.4 & "
    "w/m/Refinements = 2 & w/m/Cells = " +
    cells;
  double     error = 0;
  const auto fine =
    sums_of(sphere + " & w/Rule = gauss & w/Particles per segment = 7", error);
  print_bound("volume of a sphere of " + cells,
              fine.second / (4 * numbers::PI * 0.064) - 1 + error,
              0.07);
  // Cutting makes warped quadrilaterals triangles, equal parts are no exact
  // rule.
  test("sphere of " + cells, sphere, fine, cells == "triangles" ? 1e-12 : 2e-3);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string face = "w/Polyline = 0 0 0.5; 1 0 0.5; 1 1 0.5; 0 1 0.5";
  test("on faces of the grid", face, {1, 0.5}, 1e-12);
  test("the same, divided, tetrahedra",
       face + " & w/Segment length = 0.3 & Grid/Cells = tetrahedra",
       {1, 0.5},
       1e-12);
  test("flipped", face + " & w/Flip normal = true", {1, -0.5}, 1e-12);
  test(
    "tilted L",
    "w/Polyline = 0.1 0.1 0.1; 0.9 0.1 0.1; 0.9 0.5 0.5; 0.5 0.5 0.5; 0.5 0.9 "
    "0.9; 0.1 0.9 0.9 & w/Segment length = 0.23",
    {0.48 * std::sqrt(2.), 0},
    1e-12);
  test("two walls",
       "w/Polyline = 0 0 0; 1 0 0; 1 1 0; 0 1 0 | 0 0 0; 0 1 0; 0 1 1; 0 0 1",
       {2, 0},
       1e-12);
  test("half outside",
       "w/Polyline = 0.4 -1 0; 0.4 1 0; 0.4 1 1; 0.4 -1 1 & "
       "w/Segment length = 0.1",
       {1, 0.4},
       1e-12);
  test_sphere("as made");
  test_sphere("triangles");
}
