#ifndef impoint_particles_numbering_h
#define impoint_particles_numbering_h

#include <deal.II/base/mpi.h>
#include <deal.II/grid/cell_id.h>

#include <vector>

namespace Impoint
{
  using namespace dealii;

  /** Some particles that are made together: of a part of a shape (0 if it has
   * none) in a cell. */
  struct ParticleGroup
  {
    unsigned int part = 0;
    CellId       cell;
    unsigned int n_particles = 0;
  };

  /**
   * The number of the first particle of each of this rank's @p groups, when the
   * particles of all ranks are counted by part and cell: the same on any number
   * of ranks. Collective.
   */
  std::vector<std::size_t>
  first_numbers(const std::vector<ParticleGroup> &groups,
                const MPI_Comm                    communicator);

  /** Sets the numbers of @p particles, which stand in the order of the groups.
   * Collective. */
  template <typename Particle>
  void number_particles(const std::vector<ParticleGroup> &groups,
                        const MPI_Comm                    communicator,
                        std::vector<Particle>            &particles)
  {
    const auto  first = first_numbers(groups, communicator);
    std::size_t p     = 0;
    for (unsigned int g = 0; g < groups.size(); ++g)
      for (unsigned int i = 0; i < groups[g].n_particles; ++i, ++p)
        particles[p].number = first[g] + i;
  }
} // namespace Impoint

#endif
