#ifndef impoint_base_block_pattern_h
#define impoint_base_block_pattern_h

#include <cstddef>
#include <vector>

namespace Impoint
{
  /** Which nodes couple with which: rows of sorted columns, the diagonal
   * included, symmetric. */
  struct BlockPattern
  {
    std::vector<std::size_t>  row_start; // n_rows + 1
    std::vector<unsigned int> columns;

    unsigned int n_rows() const
    {
      return row_start.empty() ? 0 : row_start.size() - 1;
    }
  };
} // namespace Impoint

#endif
