// Boundary particles: lengths and areas, normals, on faces of the grid, and
// that a rule on pieces cut by the grid's cells integrates shape functions.
#include <random>

#include "seeding_scene.h"

const std::string wall = "Boundaries/wall/";

template <int dim>
std::vector<SeededBoundaryParticle<dim>>
seeded(const std::vector<std::string> &entries, bool &good)
{
  Scene                     scene(entries, dim);
  const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const auto particles = seed_boundary(scene.file, scene.boundary, grid);
  good                 = in_order(particles, grid);
  return particles;
}

// Area, and |sum of x . n A| (dim times the volume, of a closed surface).
template <int dim>
void test(const std::string              &name,
          const std::vector<std::string> &entries,
          const double                    area,
          const double                    flux,
          const double                    bound = 1e-12)
{
  for (const std::string rule : {"equal", "gauss", "cut"})
    {
      bool       good      = false;
      const auto particles = seeded<dim>(
        entries + std::vector<std::string>{wall + "Rule = " + rule,
                                           wall + "Particles per segment = 3"},
        good);
      const double a = sum_of(particles, [](const auto &p) { return p.area; });
      const double f = sum_of(particles, [](const auto &p) {
        return p.area * (p.x * p.normal);
      });
      const double length =
        sum_of(particles, [](const auto &p) { return p.normal.norm() - 1; });
      print_bound(name + ", " + rule,
                  std::abs(a - area) + std::abs(f - flux) + std::abs(length) +
                    (good ? 0 : 1),
                  bound);
    }
}

const std::string grid = "Grid/Generator = subdivided_hyper_rectangle";

void test_lines()
{
  const std::vector<std::string> square = {
    grid, "Grid/Arguments = 4, 4 : 0, 0 : 1, 1"};
  const std::string line = wall + "Polyline = ";
  test<2>("on grid lines",
          square +
            std::vector<std::string>{
              line + "0.25 0.25; 0.75 0.25; 0.75 0.75; 0.25 0.75; 0.25 0.25"},
          2,
          0.5);
  test<2>("on the border",
          square + std::vector<std::string>{line + "0 0; 1 0; 1 1; 0 1; 0 0",
                                            wall + "Segment length = 0.3"},
          4,
          2);
  test<2>("on the border, inward",
          square + std::vector<std::string>{line + "0 0; 1 0; 1 1; 0 1; 0 0",
                                            wall + "Flip normal = true"},
          4,
          -2);
  test<2>("diagonal",
          square + std::vector<std::string>{line + "0 0; 1 1",
                                            "Grid/Cells = triangles"},
          std::sqrt(2.),
          0);
  test<2>("partly outside",
          square + std::vector<std::string>{line + "0.5 -1; 0.5 2",
                                            wall + "Segment length = 0.1"},
          1,
          0.5);

  std::mt19937 random(2);
  for (unsigned int i = 0; i < 4; ++i)
    {
      const Point<2> from(0.2 + 0.1 * (random() % 10),
                          0.2 + 0.1 * (random() % 10));
      const Point<2> to(2 + 0.1 * (random() % 10), 2 + 0.1 * (random() % 10));
      std::ostringstream text;
      text.precision(17);
      text << line << from << "; " << to;
      test<2>("random",
              {grid,
               "Grid/Arguments = 20, 20 : 0, -3 : 6, 3",
               "Grid/Rotation = 30",
               text.str(),
               i % 2 ? "Grid/Cells = triangles" : "Grid/Cells = as made"},
              from.distance(to),
              cross_product_2d(to - from) * from);
    }
}

void test_surfaces()
{
  const std::vector<std::string> box = {
    grid, "Grid/Arguments = 4, 4, 4 : 0, 0, 0 : 1, 1, 1"};
  test<3>("face of the grid",
          box +
            std::vector<std::string>{
              wall + "Polyline = 0 0 0.5; 1 0 0.5; 1 1 0.5; 0 1 0.5"},
          1,
          0.5);
  test<3>("the same, lattice, tetrahedra",
          box +
            std::vector<std::string>{
              wall + "Polyline = 0 0 0.5; 1 0 0.5; 1 1 0.5; 0 1 0.5",
              wall + "Segment length = 0.3",
              "Grid/Cells = tetrahedra"},
          1,
          0.5);
  test<3>(
    "tilted L",
    box +
      std::vector<std::string>{
        wall + "Polyline = 0.1 0.1 0.1; 0.9 0.1 0.1; 0.9 0.5 0.5; 0.5 0.5 0.5; "
               "0.5 0.9 0.9; 0.1 0.9 0.9",
        wall + "Segment length = 0.23"},
    0.48 * std::sqrt(2.),
    0);
  for (const std::string cells : {"as made", "triangles"})
    {
      // The surface itself, from its own facets, is what is compared with.
      const std::vector<std::string> sphere = {
        wall + "Mesh/Generator = hyper_sphere",
        wall + "Mesh/Arguments = 0.5, 0.5, 0.5 : 0.4",
        wall + "Mesh/Refinements = 2",
        wall + "Mesh/Cells = " + cells};
      bool       good = false;
      const auto fine =
        seeded<3>(box + sphere +
                    std::vector<std::string>{wall + "Rule = gauss",
                                             wall +
                                               "Particles per segment = 7"},
                  good);
      const double area = sum_of(fine, [](const auto &p) { return p.area; });
      const double flux =
        sum_of(fine, [](const auto &p) { return p.area * (p.x * p.normal); });
      print_bound("sphere of " + cells + ", volume",
                  flux / (4 * numbers::PI * 0.064) - 1,
                  0.07);
      test<3>("sphere of " + cells,
              box + sphere,
              area,
              flux,
              cells == "triangles" ? 1e-12 : 1e-3);
    }
}

// With pieces that end where cells do, n Gauss points integrate a polynomial of
// each cell: the mean of a hat function along a line through a face's middle.
void test_exactness()
{
  bool         good      = false;
  const auto   particles = seeded<2>({grid,
                                      "Grid/Arguments = 4, 4 : 0, 0 : 1, 1",
                                      wall + "Polyline = 0.03 0.5; 0.97 0.6",
                                      wall + "Rule = cut",
                                      wall + "Particles per segment = 1"},
                                   good);
  const double integral  = sum_of(particles, [](const auto &p) {
    return p.area * std::max(0., 1 - std::abs(p.x[0] - 0.5) / 0.25);
  });
  print_bound("hat function on pieces",
              integral - 0.25 * std::sqrt(0.94 * 0.94 + 0.01) / 0.94,
              1e-14);
}

void test_inner_side()
{
  for (const std::string rule : {"equal", "cut"})
    for (const std::string flip : {"false", "true"})
      {
        Scene                   scene({grid,
                                       "Grid/Arguments = 4, 4 : 0, 0 : 1, 1",
                                       wall + "Polyline = 0.5 0.1; 0.5 0.9",
                                       wall + "Rule = " + rule,
                                       wall + "Flip normal = " + flip},
                    2);
        const BackgroundGrid<2> background(scene.file,
                                           scene.grid,
                                           MPI_COMM_WORLD);
        const auto              particles =
          seed_boundary(scene.file, scene.boundary, background);
        const double outside = sum_of(particles, [&](const auto &p) {
          const auto center = background.cell(p.cell)->center();
          return (center - p.x) * p.normal > 0 ? 1. : 0.;
        });
        print_bound("cells on the inner side, " + rule, outside, 0.5);
      }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_lines();
  test_surfaces();
  test_exactness();
  test_inner_side();
}
