#ifndef impoint_particles_stored_particles_h
#define impoint_particles_stored_particles_h

#include <impoint/base/stored_pieces.h>
#include <impoint/particles/point_cloud.h>

#include <deal.II/grid/cell_id.h>

#include <map>
#include <vector>

namespace Impoint
{
  /** This rank's own cells by the name that they have on any number of ranks.
   */
  using OwnCells = std::map<CellId, unsigned int>;

  template <int dim>
  OwnCells own_cells(const BackgroundGrid<dim> &grid);

  /** Cells in an archive, by their names. */
  class StoredCells
  {
  public:
    template <int dim>
    void add(const BackgroundGrid<dim> &grid, const unsigned int c)
    {
      const auto name = grid.cell(c)->id().template to_binary<dim>();
      numbers.insert(numbers.end(), name.begin(), name.end());
    }

    /** The one that was added as number @p i, or cells.end(). */
    OwnCells::const_iterator find(const std::size_t i,
                                  const OwnCells   &cells) const;

    void save_or_load(StateArchive &archive)
    {
      archive &numbers;
    }

  private:
    std::vector<unsigned int> numbers;
  };

  /** Appends this rank's particles of @p cloud to @p archive, in their order.
   */
  template <int dim>
  void store_particles(const PointCloud<dim>     &cloud,
                       const BackgroundGrid<dim> &grid,
                       StateArchive              &archive);

  /**
   * Reads what each rank stored, from @p pieces, and inserts the particles in
   * own cells into the empty @p cloud. Those of a cell get the order that they
   * had. Collective; throws InputError, on all ranks, if they do not fit the
   * cloud or the grid.
   */
  template <int dim>
  void restore_particles(StoredPieces    &pieces,
                         const OwnCells  &cells,
                         const MPI_Comm   communicator,
                         PointCloud<dim> &cloud);
} // namespace Impoint

#endif
