#include <impoint/particles/numbering.h>

#include <deal.II/base/mpi.templates.h>

#include <algorithm>
#include <map>
#include <utility>

namespace Impoint
{
  std::vector<std::size_t>
  first_numbers(const std::vector<ParticleGroup> &groups,
                const MPI_Comm                    communicator)
  {
    std::vector<CellId::binary_type>         cells;
    std::vector<std::array<unsigned int, 2>> parts_and_counts;
    for (const auto &group : groups)
      {
        // three bits a level hold the children of either dimension
        cells.push_back(group.cell.to_binary<3>());
        parts_and_counts.push_back({{group.part, group.n_particles}});
      }
    const auto all_cells = Utilities::MPI::all_gather(communicator, cells);
    const auto all_parts =
      Utilities::MPI::all_gather(communicator, parts_and_counts);

    std::map<std::pair<unsigned int, CellId>, std::size_t> numbers;
    for (unsigned int rank = 0; rank < all_cells.size(); ++rank)
      for (std::size_t i = 0; i < all_cells[rank].size(); ++i)
        numbers[{all_parts[rank][i][0], CellId(all_cells[rank][i])}] =
          all_parts[rank][i][1];
    std::size_t next = 0;
    for (auto &entry : numbers)
      next += std::exchange(entry.second, next);

    std::vector<std::size_t> first;
    for (const auto &group : groups)
      first.push_back(numbers.at({group.part, group.cell}));
    return first;
  }
} // namespace Impoint
