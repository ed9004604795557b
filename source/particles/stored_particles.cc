#include <impoint/base/on_all_ranks.h>
#include <impoint/particles/stored_particles.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <string>

namespace Impoint
{
  namespace
  {
    /** The particles of one rank: by cell, and one after the other. */
    struct PackedParticles
    {
      StoredCells                        cells;
      std::vector<std::uint64_t>         numbers_in_cell;
      std::vector<types::particle_index> ids;
      std::vector<double>                properties;

      void save_or_load(StateArchive &archive)
      {
        cells.save_or_load(archive);
        archive &numbers_in_cell &ids &properties;
      }
    };

    void tag_layout(const PropertyLayout &layout, StateArchive &archive)
    {
      for (const auto &field : layout.fields())
        archive.tag(field.name + " " + std::to_string(field.size));
    }
  } // namespace



  OwnCells::const_iterator StoredCells::find(const std::size_t i,
                                             const OwnCells   &cells) const
  {
    CellId::binary_type name;
    std::copy_n(numbers.begin() + i * name.size(), name.size(), name.begin());
    return cells.find(CellId(name));
  }



  template <int dim>
  OwnCells own_cells(const BackgroundGrid<dim> &grid)
  {
    OwnCells cells;
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      if (grid.is_owned(c))
        cells.emplace(grid.cell(c)->id(), c);
    return cells;
  }



  template <int dim>
  void store_particles(const PointCloud<dim>     &cloud,
                       const BackgroundGrid<dim> &grid,
                       StateArchive              &archive)
  {
    PackedParticles    packed;
    const unsigned int n_doubles = cloud.layout().n_doubles();
    for (const auto &range : cloud.ranges())
      {
        packed.cells.add(grid, range.cell);
        packed.numbers_in_cell.push_back(range.end - range.begin);
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            packed.ids.push_back(cloud.id(p));
            packed.properties.insert(packed.properties.end(),
                                     cloud.data(p),
                                     cloud.data(p) + n_doubles);
          }
      }
    tag_layout(cloud.layout(), archive);
    packed.save_or_load(archive);
  }



  template <int dim>
  void restore_particles(StoredPieces    &pieces,
                         const OwnCells  &cells,
                         const MPI_Comm   communicator,
                         PointCloud<dim> &cloud)
  {
    const unsigned int n_doubles = cloud.layout().n_doubles();
    std::size_t        n_stored  = 0;
    std::vector<typename PointCloud<dim>::NewParticle> mine;
    on_all_ranks(communicator, [&]() {
      pieces.for_each([&](StateArchive &archive) {
        PackedParticles packed;
        tag_layout(cloud.layout(), archive);
        packed.save_or_load(archive);
        std::size_t p = 0;
        for (std::size_t i = 0; i < packed.numbers_in_cell.size(); ++i)
          {
            const auto found = packed.cells.find(i, cells);
            for (std::size_t k = 0; k < packed.numbers_in_cell[i]; ++k, ++p)
              if (found != cells.end())
                {
                  const auto begin = packed.properties.begin() + p * n_doubles;
                  mine.push_back(
                    {found->second,
                     packed.ids[p],
                     std::vector<double>(begin, begin + n_doubles)});
                }
          }
        n_stored += p;
      });
    });
    if (Utilities::MPI::sum(mine.size(), communicator) != n_stored)
      throw StateArchive::does_not_fit(
        "some of its particles lie in cells that the grid does not have");
    cloud.insert(mine);
  }

#define IMPOINT_INSTANTIATE(dim)                                 \
  template OwnCells own_cells(const BackgroundGrid<dim> &);      \
  template void     store_particles(const PointCloud<dim> &,     \
                                    const BackgroundGrid<dim> &, \
                                    StateArchive &);             \
  template void     restore_particles(StoredPieces &,            \
                                      const OwnCells &,          \
                                      const MPI_Comm,            \
                                      PointCloud<dim> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
