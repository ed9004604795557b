// Bodies clipped by the cells of the grid: area, centroid and, with Gauss
// rules, second moments of random outlines, of tetrahedra and of warped
// hexahedra.
#include <impoint/particles/outline.h>

#include <deal.II/grid/grid_tools.h>

#include <array>
#include <random>

#include "seeding_scene.h"

// Areas, first moments and second moments xx, xy, yy (3D: volume, first).
using Moments = std::array<double, 10>;

template <int dim>
Moments moments_of(const std::vector<SeededPoint<dim>> &points)
{
  Moments m;
  m[0] = sum_of(points, [](const auto &p) { return p.volume; });
  for (unsigned int i = 0, k = 1 + dim; i < dim; ++i)
    {
      m[1 + i] =
        sum_of(points, [&](const auto &p) { return p.volume * p.x[i]; });
      for (unsigned int j = i; j < dim; ++j, ++k)
        m[k] = sum_of(points, [&](const auto &p) {
          return p.volume * p.x[i] * p.x[j];
        });
    }
  return m;
}

// Of a triangle or tetrahedron: the mean of x y is that of the corners'
// products with themselves and with the sums over all corners.
template <int dim>
void add_exact(const std::array<Point<dim>, dim + 1> &simplex, Moments &m)
{
  const double   volume = std::abs(simplex_volume<dim>(simplex));
  Tensor<1, dim> sum;
  for (const auto &corner : simplex)
    sum += corner;
  m[0] += volume;
  for (unsigned int i = 0, k = 1 + dim; i < dim; ++i)
    {
      m[1 + i] += volume * sum[i] / (dim + 1);
      for (unsigned int j = i; j < dim; ++j, ++k)
        {
          double products = sum[i] * sum[j];
          for (const auto &corner : simplex)
            products += corner[i] * corner[j];
          m[k] += volume * products / ((dim + 1) * (dim + 2));
        }
    }
}

template <int dim>
void test(const std::string              &name,
          const std::vector<std::string> &entries,
          const Moments                  &exact)
{
  const std::vector<std::string> b = {"Bodies/body/Points = clipped"};
  for (const std::string rule : {"1", "3", "gauss"})
    {
      const auto                points = rule == "gauss" ? "2" : rule;
      Scene                     scene(entries + b +
                    std::vector<std::string>{
                                          "Bodies/body/Points per direction = " + points,
                                          std::string("Bodies/body/Piece = ") +
                                            (rule == "gauss" ? "gauss" : "centroid")},
                  dim);
      const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
      const auto         seeded = seed_body(scene.file, scene.body, grid);
      const Moments      m      = moments_of<dim>(seeded);
      double             error  = in_order(seeded, grid) ? 0 : 1;
      const unsigned int n =
        rule != "gauss" ? 1 + dim : 1 + dim + dim * (dim + 1) / 2;
      for (unsigned int i = 0; i < n; ++i)
        error = std::max(error, std::abs(m[i] - exact[i]) / exact[0]);
      print_bound(name + ", " + rule, error, 1e-12);
    }
}

std::string text_of(const std::vector<Point<2>> &corners)
{
  std::ostringstream text;
  text.precision(17);
  for (const auto &corner : corners)
    text << (text.str().empty() ? "" : "; ") << corner[0] << " " << corner[1];
  return text.str();
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

const std::string grid = "Grid/Generator = subdivided_hyper_rectangle";

void test_outlines()
{
  const std::vector<std::vector<std::string>> grids = {
    {grid, "Grid/Arguments = 9, 7 : -1, -1 : 3, 3.5"},
    {grid, "Grid/Arguments = 11, 11 : -1, -3 : 5, 3", "Grid/Rotation = 30"},
    {grid,
     "Grid/Arguments = 9, 7 : -1, -1 : 3, 3.5",
     "Grid/Cells = triangles",
     "Grid/Distortion = 0.2"},
    {grid,
     "Grid/Arguments = 2, 1 : 0, -3 : 6, 3",
     "Grid/Rotation = 20",
     "Grid/Refinements = 2",
     "Grid/Refine where = 1 - x"}};
  std::mt19937 random(1);
  for (unsigned int g = 0; g < grids.size(); ++g)
    for (const unsigned int n : {3, 5, 12})
      {
        const auto corners = star(random, n);
        Moments    exact   = {};
        for (unsigned int i = 0; i < n; ++i)
          add_exact<2>({{Point<2>(1, 1), corners[i], corners[(i + 1) % n]}},
                       exact);
        test<2>("grid " + std::to_string(g) + ", star of " + std::to_string(n),
                grids[g] + std::vector<std::string>{"Bodies/body/Outline = " +
                                                    text_of(corners)},
                exact);
      }
}

template <int dim>
void test_mesh(const std::string              &name,
               const std::vector<std::string> &grid_entries,
               const std::vector<std::string> &body_entries)
{
  Scene   scene(body_entries, dim);
  Moments exact = {};
  for (const auto &part : body_parts<dim>(scene.file, scene.body))
    for (const auto &simplex : part.simplices())
      add_exact<dim>(simplex, exact);
  test<dim>(name, grid_entries + body_entries, exact);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                      body = "Bodies/body/Mesh/";
  const std::vector<std::string>         box  = {
             grid, "Grid/Arguments = 5, 4, 5 : -1, -1, -1 : 1, 1.2, 1"};
  const std::vector<std::string> tilted = {body + "Rotation = 35",
                                           body + "Axis = 1, 2, 3"};
  test_outlines();
  test_mesh<3>("cube",
               box,
               tilted +
                 std::vector<std::string>{body + "Generator = hyper_cube",
                                          body + "Arguments = -0.4 : 0.4"});
  test_mesh<3>("tetrahedra in hexahedra",
               box,
               tilted +
                 std::vector<std::string>{body +
                                            "Generator = subdivided_hyper_cube",
                                          body + "Arguments = 2 : -0.4 : 0.4",
                                          body + "Cells = tetrahedra",
                                          body + "Distortion = 0.2"});
  test_mesh<3>("warped hexahedra in tetrahedra",
               box + std::vector<std::string>{"Grid/Cells = tetrahedra"},
               {body + "Generator = hyper_ball",
                body + "Arguments = 0, 0, 0 : 0.9",
                body + "Refinements = 1"});
}
