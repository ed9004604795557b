// Bodies clipped by the cells of the grid: area, centroid and, with Gauss
// rules, second moments of random outlines, of tetrahedra and of warped
// hexahedra.
#include <impoint/particles/outline.h>

#include <random>

#include "seeding_moments.h"
#include "seeding_scene.h"

template <int dim>
void test(const std::string &name,
          const std::string &entries,
          const Moments     &exact)
{
  double error = 0;
  for (const std::string rule : {"1 & b/Piece = centroid",
                                 "3 & b/Piece = centroid",
                                 "2 & b/Piece = gauss"})
    {
      const SeedingScene scene(
        entries + " & b/Points = clipped & b/Points per direction = " + rule,
        dim);
      const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
      const auto         points = seed_body(scene.file, scene.body, grid);
      const Moments      m      = moments_of<dim>(points);
      const bool         gauss  = scene.body.gauss_pieces;
      const unsigned int n_moments =
        1 + dim + (gauss ? dim * (dim + 1) / 2 : 0);
      error += disorder(points, grid);
      for (unsigned int i = 0; i < n_moments; ++i)
        error = std::max(error, std::abs(m[i] - exact[i]) / exact[0]);
    }
  print_bound(name, error, 1e-12);
}

// A star around (1, 1) with corners at random radii between 0.3 and 0.7.
std::vector<Point<2>> star(std::mt19937 &random, const unsigned int n)
{
  std::vector<Point<2>> corners;
  for (unsigned int i = 0; i < n; ++i)
    {
      const double radius = 0.3 + 0.4 * (random() % 1000) / 1000.;
      const double angle  = 2 * numbers::PI * (i + 0.3) / n;
      corners.emplace_back(1 + radius * std::cos(angle),
                           1 + radius * std::sin(angle));
    }
  return corners;
}

const std::string box = "Grid/Generator = subdivided_hyper_rectangle & ";

void test_outlines()
{
  const std::vector<std::string> grids = {
    "Grid/Arguments = 9, 7 : -1, -1 : 3, 3.5",
    "Grid/Arguments = 11, 11 : -1, -3 : 5, 3 & Grid/Rotation = 30",
    "Grid/Arguments = 9, 7 : -1, -1 : 3, 3.5 & Grid/Cells = triangles & "
    "Grid/Distortion = 0.2",
    "Grid/Arguments = 2, 1 : 0, -3 : 6, 3 & Grid/Rotation = 20 & "
    "Grid/Refinements = 2 & Grid/Refine where = 1 - x"};
  std::mt19937 random(1);
  for (unsigned int g = 0; g < grids.size(); ++g)
    for (const unsigned int n : {3, 5, 12})
      {
        const auto         corners = star(random, n);
        Moments            exact   = {};
        std::ostringstream text;
        text.precision(17);
        for (unsigned int i = 0; i < n; ++i)
          {
            add_exact<2>({{Point<2>(1, 1), corners[i], corners[(i + 1) % n]}},
                         exact);
            text << (i > 0 ? "; " : "") << corners[i];
          }
        test<2>("grid " + std::to_string(g) + ", star of " + std::to_string(n),
                box + grids[g] + " & b/Outline = " + text.str(),
                exact);
      }
  Moments exact = {};
  exact[0] = 1 - 0.25, exact[1] = exact[2] = 0.375;
  exact[3] = exact[5] = 1. / 3 - 0.25 * (0.25 + 1. / 48);
  exact[4]            = 0.25 - 0.25 * 0.25;
  test<2>("square with a hole, on faces",
          box +
            "Grid/Arguments = 4, 4 : 0, 0 : 1, 1 & b/Outline = 0 0; 1 0; 1 1; "
            "0 1 | 0.25 0.25; 0.25 0.75; 0.75 0.75; 0.75 0.25",
          exact);
}

template <int dim>
void test_mesh(const std::string &name,
               const std::string &grid,
               const std::string &body)
{
  const SeedingScene scene(body, dim);
  Moments            exact = {};
  for (const auto &part : body_parts<dim>(scene.file, scene.body))
    for (const auto &simplex : part.simplices())
      add_exact<dim>(simplex, exact);
  test<dim>(name, box + grid + " & " + body, exact);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_outlines();
  const std::string grid = "Grid/Arguments = 5, 4, 5 : -1, -1, -1 : 1, 1.2, 1";
  const std::string tilt = " & b/m/Rotation = 35 & b/m/Axis = 1, 2, 3";
  test_mesh<3>("cube",
               grid,
               "b/m/Generator = hyper_cube & b/m/Arguments = -0.4 : 0.4" +
                 tilt);
  test_mesh<3>(
    "tetrahedra in hexahedra",
    grid,
    "b/m/Generator = subdivided_hyper_cube & b/m/Arguments = 2 : -0.4 "
    ": 0.4 & b/m/Cells = tetrahedra & b/m/Distortion = 0.2" +
      tilt);
  test_mesh<3>("warped hexahedra in tetrahedra",
               grid + " & Grid/Cells = tetrahedra",
               "b/m/Generator = hyper_ball & b/m/Arguments = 0, 0, 0 : 0.9 & "
               "b/m/Refinements = 1");
}
