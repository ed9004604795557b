// A scene of a grid, a body and a boundary from a list of entries, and what the
// tests of seeding print of the particles made from it.
#ifndef tests_particles_seeding_scene_h
#define tests_particles_seeding_scene_h

#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/seeding.h>

#include <cmath>
#include <iostream>

using namespace Impoint;

// Entries "Grid/Arguments = ... & ...", with b/, w/ and m/ for the body, the
// boundary ("wall") and the mesh of either.
inline std::vector<std::string> entries_of(const std::string &text)
{
  std::vector<std::string> entries;
  for (std::string entry : Words::split(text, '&'))
    {
      for (const auto &[letter, section] :
           {std::pair<std::string, std::string>("b/", "Bodies/body/"),
            {"w/", "Boundaries/wall/"}})
        if (entry.rfind(letter, 0) == 0)
          entry = section + entry.substr(2);
      const auto mesh = entry.find("/m/");
      if (mesh != std::string::npos)
        entry.replace(mesh, 3, "/Mesh/");
      entries.push_back(entry);
    }
  return entries;
}

struct SeedingScene
{
  SeedingScene(const std::string &entries, const unsigned int dim)
    : file("", entries_of(entries))
  {
    grid.declare(file);
    body.declare(file, "body");
    boundary.declare(file, "wall");
    file.apply();
    body.complete(1);
    boundary.complete(1);
    grid.check(file, dim);
    if (entries.find("b/") != std::string::npos)
      body.check(file, dim);
    if (entries.find("w/") != std::string::npos)
      boundary.check(file, dim);
  }

  ParameterFile      file;
  GridParameters     grid;
  BodyParameters     body;
  BoundaryParameters boundary;
};

// The mesh of "Mesh/..." entries.
struct MeshScene
{
  MeshScene(const std::string &entries, const unsigned int dim)
    : file("", entries_of(entries))
  {
    parameters.declare(file, "Mesh", "", "");
    file.apply();
    parameters.check(file, dim);
  }

  ParameterFile  file;
  MeshParameters parameters;
};

template <int dim>
void make(const std::string &entries, Triangulation<dim> &mesh)
{
  const MeshScene scene(entries, dim);
  make_mesh(scene.file, scene.parameters, mesh);
}

// Sum over the particles of all ranks.
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
  if (!on_first_rank())
    return;
  std::cout << what << " below bound: ";
  if (std::abs(error) < bound)
    std::cout << "yes" << std::endl;
  else
    std::cout << "no, " << error << std::endl;
}

// 0 if the particles' numbers are 0, 1, ... and their cells hold them, else 1.
template <typename Particle, int dim>
double disorder(const std::vector<Particle> &particles,
                const BackgroundGrid<dim>   &grid)
{
  const std::size_t n = Utilities::MPI::sum(particles.size(), MPI_COMM_WORLD);
  std::vector<unsigned int> seen(n, 0);
  bool                      good = n > 0;
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
  return Utilities::MPI::min(int(good), MPI_COMM_WORLD) == 1 ? 0 : 1;
}

#endif
