// A scene of a grid, a body and a boundary from a list of entries, and what the
// tests of seeding print of the particles made from it.
#ifndef tests_particles_seeding_scene_h
#define tests_particles_seeding_scene_h

#include <impoint/base/parameter_file.h>
#include <impoint/particles/seeding.h>

#include <cmath>
#include <iostream>

using namespace Impoint;

struct Scene
{
  Scene(const std::vector<std::string> &entries, const unsigned int dim)
    : file("", entries)
  {
    grid.declare(file);
    body.declare(file, "body");
    boundary.declare(file, "wall");
    file.apply();
    grid.check(file, dim);
    if (file.is_set("Bodies/body/Outline") ||
        file.is_set("Bodies/body/Mesh/Generator"))
      body.check(file, dim);
    if (file.is_set("Boundaries/wall/Polyline") ||
        file.is_set("Boundaries/wall/Mesh/Generator"))
      boundary.check(file, dim);
  }

  ParameterFile      file;
  GridParameters     grid;
  BodyParameters     body;
  BoundaryParameters boundary;
};

inline std::vector<std::string> operator+(std::vector<std::string>        left,
                                          const std::vector<std::string> &right)
{
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

// Sum over the points of all ranks.
template <typename Particle, typename Function>
double sum_of(const std::vector<Particle> &particles, const Function &function)
{
  double sum = 0;
  for (const auto &particle : particles)
    sum += function(particle);
  return Utilities::MPI::sum(sum, MPI_COMM_WORLD);
}

inline bool on_first_rank()
{
  return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
}

inline void
print_bound(const std::string &what, const double error, const double bound)
{
  if (on_first_rank())
    {
      std::cout << what << " below bound: ";
      if (std::abs(error) < bound)
        std::cout << "yes" << std::endl;
      else
        std::cout << "no, " << error << std::endl;
    }
}

// Whether the particles' numbers are 0, 1, ... and their cells hold them.
template <typename Particle, int dim>
bool in_order(const std::vector<Particle> &particles,
              const BackgroundGrid<dim>   &grid)
{
  const std::size_t n = Utilities::MPI::sum(particles.size(), MPI_COMM_WORLD);
  std::vector<unsigned int> seen(n, 0);
  bool                      good = true;
  for (const auto &particle : particles)
    {
      good = good && particle.number < n && grid.is_owned(particle.cell) &&
             grid.is_inside(grid.to_reference(particle.cell, particle.x), 1e-8);
      if (particle.number < n)
        ++seen[particle.number];
    }
  Utilities::MPI::sum(seen, MPI_COMM_WORLD, seen);
  for (const unsigned int times : seen)
    good = good && times == 1;
  return Utilities::MPI::min(int(good), MPI_COMM_WORLD) == 1;
}

#endif
