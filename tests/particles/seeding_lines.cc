// Particles on lines: lengths, normals, on faces of the grid, and that a rule
// on pieces cut by the grid's cells integrates shape functions.
#include <random>

#include "seeding_scene.h"

const std::string box    = "Grid/Generator = subdivided_hyper_rectangle & ";
const std::string square = box + "Grid/Arguments = 4, 4 : 0, 0 : 1, 1 & ";

// Length, and sum of x . n A, which is twice the area of a closed line.
void test(const std::string &name,
          const std::string &entries,
          const double       length,
          const double       flux)
{
  double error = 0;
  for (const std::string rule : {"equal", "gauss", "cut"})
    {
      const SeedingScene scene(
        entries + " & w/Particles per segment = 3 & w/Rule = " + rule, 2);
      const BackgroundGrid<2> grid(scene.file, scene.grid, MPI_COMM_WORLD);
      const auto particles = seed_boundary(scene.file, scene.boundary, grid);
      error += disorder(particles, grid);
      error += std::abs(
        sum_of(particles, [](const auto &p) { return p.area; }) - length);
      error += std::abs(
        sum_of(particles,
               [](const auto &p) { return p.area * (p.x * p.normal); }) -
        flux);
      error += std::abs(
        sum_of(particles, [](const auto &p) { return p.normal.norm() - 1; }));
    }
  print_bound(name, error, 1e-12);
}

void test_random()
{
  std::mt19937 random(2);
  const auto   number = [&]() { return 0.2 + 0.1 * (random() % 10); };
  for (const std::string cells : {"as made", "triangles"})
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Point<2>     from(number(), number());
        const Point<2>     to(2 + number(), 2 + number());
        std::ostringstream line;
        line.precision(17);
        line << from << "; " << to;
        test("random line, " + cells,
             box +
               "Grid/Arguments = 20, 20 : 0, -3 : 6, 3 & Grid/Rotation = 30 & "
               "Grid/Cells = " +
               cells + " & w/Polyline = " + line.str(),
             from.distance(to),
             cross_product_2d(to - from) * from);
      }
}

// With pieces that end where cells do, the midpoint integrates a function that
// is linear in each cell: the hat of the column of nodes at x = 0.5.
void test_exactness()
{
  const SeedingScene      scene(square +
                             "w/Polyline = 0.03 0.5; 0.97 0.6 & w/Rule = "
                                  "cut & w/Particles per segment = 1",
                           2);
  const BackgroundGrid<2> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto   particles = seed_boundary(scene.file, scene.boundary, grid);
  const double integral  = sum_of(particles, [](const auto &p) {
    return p.area * std::max(0., 1 - std::abs(p.x[0] - 0.5) / 0.25);
  });
  print_bound("hat function on pieces",
              integral - 0.25 * std::sqrt(0.94 * 0.94 + 0.01) / 0.94,
              1e-14);
}

void test_inner_side(const std::string &entries)
{
  const SeedingScene      scene(square + "w/Polyline = 0.5 0.1; 0.5 0.9 & " +
                             entries,
                           2);
  const BackgroundGrid<2> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto   particles = seed_boundary(scene.file, scene.boundary, grid);
  const double outside   = sum_of(particles, [&](const auto &p) {
    return (grid.cell(p.cell)->center() - p.x) * p.normal > 0 ? 1. : 0.;
  });
  print_bound("cells on the outer side, " + entries, outside, 0.5);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string border = square + "w/Polyline = 0 0; 1 0; 1 1; 0 1; 0 0 & ";
  test("on grid lines",
       square +
         "w/Polyline = 0.25 0.25; 0.75 0.25; 0.75 0.75; 0.25 0.75; 0.25 0.25",
       2,
       0.5);
  test("on the border", border + "w/Segment length = 0.3", 4, 2);
  test("on the border, inward", border + "w/Flip normal = true", 4, -2);
  test("on diagonals of triangles",
       square + "w/Polyline = 0 0; 1 1 & Grid/Cells = triangles",
       std::sqrt(2.),
       0);
  test("partly outside",
       square + "w/Polyline = 0.5 -1; 0.5 2 & w/Segment length = 0.1",
       1,
       0.5);
  test("circle",
       square + "w/m/Generator = hyper_sphere & w/m/Arguments = 0.5, "
                "0.5 : 0.4 & w/m/Refinements = 3",
       32 * 0.8 * std::sin(numbers::PI / 32),
       32 * 0.16 * std::sin(numbers::PI / 16));
  test_random();
  test_exactness();
  for (const std::string rule : {"equal", "cut"})
    for (const std::string flip : {"false", "true"})
      test_inner_side("w/Rule = " + rule + " & w/Flip normal = " + flip);
}
