// Particles that move from cell to cell and from rank to rank: each arrives in
// the cell that holds it, once, with its state; none of them if one leaves the
// grid.
#include <impoint/base/exceptions.h>
#include <impoint/particles/point_cloud.h>

#include "seeding_scene.h"

// Seeds of the body, with a mark that tells which particle it is.
template <int dim>
std::vector<typename PointCloud<dim>::NewParticle>
marked_particles(const SeedingScene &scene, const BackgroundGrid<dim> &grid)
{
  std::vector<typename PointCloud<dim>::NewParticle> particles;
  for (const auto &seed : seed_body(scene.file, scene.body, grid))
    {
      std::vector<double> state;
      for (unsigned int d = 0; d < dim; ++d)
        state.push_back(seed.x[d]);
      state.push_back(std::sqrt(1. + seed.number));
      particles.push_back(
        {seed.cell, types::particle_index(seed.number), std::move(state)});
    }
  return particles;
}

// 0 if cells, order, states and supports are what they must be, else 1.
template <int dim>
double disorder_of(const PointCloud<dim>     &cloud,
                   const BackgroundGrid<dim> &grid)
{
  bool   good = true;
  double sum  = 0;
  for (unsigned int r = 0; r < cloud.ranges().size(); ++r)
    {
      const auto &range = cloud.ranges()[r];
      good              = good && range.begin < range.end &&
             range.begin == (r > 0 ? cloud.ranges()[r - 1].end : 0) &&
             (r == 0 || cloud.ranges()[r - 1].cell < range.cell) &&
             grid.is_owned(range.cell);
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          double unity = -1;
          for (unsigned int a = 0; a < grid.cell(range.cell)->n_vertices(); ++a)
            unity += cloud.support(p)[a];
          sum += cloud.id(p);
          good =
            good && std::abs(unity) < 1e-12 &&
            (p == range.begin || cloud.id(p - 1) < cloud.id(p)) &&
            cloud.data(p)[dim] == std::sqrt(1. + cloud.id(p)) &&
            grid.is_inside(grid.to_reference(range.cell, cloud.position(p)),
                           1e-10);
        }
    }
  const double n = cloud.n_global();
  good = good && Utilities::MPI::sum(cloud.n(), MPI_COMM_WORLD) == n &&
         Utilities::MPI::sum(sum, MPI_COMM_WORLD) == n * (n - 1) / 2;
  return Utilities::MPI::min(int(good), MPI_COMM_WORLD) == 1 ? 0 : 1;
}

// The particles go round the middle of the grid by an eighth of a turn a step.
template <int dim>
std::vector<Point<dim>> turned(const PointCloud<dim> &cloud,
                               const double           stretch)
{
  std::vector<Point<dim>> places;
  for (unsigned int p = 0; p < cloud.n(); ++p)
    {
      const Point<dim> x = cloud.position(p);
      const double     c = stretch * std::sqrt(0.5);
      Point<dim>       y = x;
      y[0]               = 0.5 + c * (x[0] - 0.5) - c * (x[1] - 0.5);
      y[1]               = 0.5 + c * (x[0] - 0.5) + c * (x[1] - 0.5);
      places.push_back(y);
    }
  return places;
}

template <int dim>
void test(const std::string &name, const std::string &entries)
{
  const SeedingScene        scene(entries, dim);
  const BackgroundGrid<dim> grid(scene.file, scene.grid, MPI_COMM_WORLD);
  const Basis<dim>          basis(grid, scene.file, scene.grid);
  PropertyLayout            layout;
  layout.add("position", dim);
  layout.add("mark", 1);
  PointCloud<dim> cloud(basis, layout);
  cloud.insert(marked_particles(scene, grid));
  const auto n     = cloud.n_global();
  double     error = disorder_of(cloud, grid);
  for (unsigned int step = 0; step < 9; ++step)
    {
      const auto places = turned(cloud, 1);
      cloud.find(places, "point");
      for (unsigned int p = 0; p < cloud.n(); ++p)
        for (unsigned int d = 0; d < dim; ++d)
          cloud.data(p)[d] = places[p][d];
      error += cloud.move() ? 0 : 1;
      error += disorder_of(cloud, grid);
    }
  bool left = false;
  try
    {
      cloud.find(turned(cloud, 3), "point");
    }
  catch (const StepFailed &)
    {
      left = true;
    }
  error += left && cloud.n_global() == n ? 0 : 1;
  print_bound(name, error + disorder_of(cloud, grid), 0.5);
}

int main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string body  = " & b/Points per direction = 3 & b/m/Generator = "
                            "subdivided_hyper_rectangle & b/m/Arguments = ";
  const std::string plane = body + "6, 6 : 0.2, 0.2 : 0.8, 0.8";
  const std::string space = body + "4, 4, 2 : 0.2, 0.2, 0.2 : 0.8, 0.8, 0.8";
  const std::string grid  = "Grid/Generator = subdivided_hyper_rectangle & "
                            "Grid/Arguments = ";
  test<2>("quadrilaterals", grid + "11, 13 : 0, 0 : 1, 1" + plane);
  test<2>("triangles",
          grid + "11, 13 : 0, 0 : 1, 1 & Grid/Cells = triangles" + plane);
  test<3>("hexahedra", grid + "5, 7, 3 : 0, 0, 0 : 1, 1, 1" + space);
  test<3>("tetrahedra",
          grid + "5, 7, 3 : 0, 0, 0 : 1, 1, 1 & Grid/Cells = tetrahedra" +
            space);
}
