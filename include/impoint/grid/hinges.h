#ifndef impoint_grid_hinges_h
#define impoint_grid_hinges_h

#include <impoint/grid/background_grid.h>

#include <cstdint>
#include <map>
#include <vector>

namespace Impoint
{
  /**
   * Vertices about which material turns freely: cells with material hang on
   * others by them (in 3D: or by edges) only, because the points are too far
   * from each other to fill the cells between. In statics nothing else holds
   * such cells.
   */
  template <int dim>
  class Hinges
  {
  public:
    explicit Hinges(const BackgroundGrid<dim> &grid);

    /** Own cells without material around hinges, increasing. @p
     * material_cells: own cells with material, increasing. Collective. */
    const std::vector<unsigned int> &
    cells_between(const std::vector<unsigned int> &material_cells);

  private:
    using Label = std::uint64_t; // increases with a cell's rank and number

    void                      label_pieces();
    void                      label(const unsigned int c, const Label value);
    void                      find_borders();
    void                      exchange();
    bool                      spread();
    std::vector<unsigned int> vertices_between_pieces() const;
    void                      find_cells_between();

    const BackgroundGrid<dim> &grid;
    std::vector<unsigned int>  material, between; // of the last call
    bool                       fresh = true;

    // The cells with material that this rank knows, and the lowest label of the
    // piece that they make up with those beyond their faces; per cell of the
    // grid its place among these, or nowhere.
    std::vector<unsigned int> cells;
    std::vector<Label>        labels;
    std::vector<unsigned int> places;

    // For each other rank: own cells that share vertices with its cells, and
    // the reverse, in the same order on both.
    std::map<unsigned int, std::vector<unsigned int>> told, heard;
  };
} // namespace Impoint

#endif
