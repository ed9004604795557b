#ifndef impoint_solver_owned_rows_h
#define impoint_solver_owned_rows_h

#include <impoint/solver/block_matrix.h>
#include <impoint/solver/node_exchange.h>

#include <vector>

namespace Impoint
{
  /**
   * Makes of a matrix that is the sum of all ranks' parts one that is spread by
   * rows: each rank gets those of the nodes it owns, whole. Their columns reach
   * further than the nodes of the rank's own cells, so the ghosts are others.
   */
  template <int dim>
  class OwnedRows
  {
  public:
    /** @p part has rows of all nodes of @p part_nodes. Collective. */
    void new_pattern(const BlockPattern &part, const NodeExchange &part_nodes);

    /** Sends each row to its owner, which adds it up. Collective. */
    void add_up(const BlockMatrix<dim> &part, BlockMatrix<dim> &rows) const;

    const BlockPattern &pattern() const
    {
      return row_pattern;
    }
    const NodeExchange &nodes() const
    {
      return row_nodes;
    }

  private:
    /** Blocks that go to or come from a rank. */
    struct Sent
    {
      unsigned int rank;
      std::size_t  begin, end; // in the part
    };
    struct Received
    {
      unsigned int             rank;
      std::vector<std::size_t> places; // in the rows
    };

    NodeExchange             row_nodes;
    BlockPattern             row_pattern;
    std::vector<std::size_t> places; // of the part's blocks in own rows
    std::vector<Sent>        sent;
    std::vector<Received>    received;
  };
} // namespace Impoint

#endif
