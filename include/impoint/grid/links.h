#ifndef impoint_grid_links_h
#define impoint_grid_links_h

#include <deal.II/base/array_view.h>

#include <vector>

namespace Impoint
{
  using namespace dealii;

  /** Groups of cells whose nodes couple; see ActiveNodes. */
  class Links
  {
  public:
    void add(const std::vector<unsigned int> &cells)
    {
      all_cells.insert(all_cells.end(), cells.begin(), cells.end());
      first.push_back(all_cells.size());
    }

    unsigned int size() const
    {
      return first.size() - 1;
    }

    ArrayView<const unsigned int> cells(const unsigned int l) const
    {
      return ArrayView<const unsigned int>(all_cells.data() + first[l],
                                           first[l + 1] - first[l]);
    }

    bool operator==(const Links &other) const
    {
      return first == other.first && all_cells == other.all_cells;
    }

  private:
    std::vector<std::size_t>  first = {0}; // per link
    std::vector<unsigned int> all_cells;
  };
} // namespace Impoint

#endif
