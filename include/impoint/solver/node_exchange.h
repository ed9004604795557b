#ifndef impoint_solver_node_exchange_h
#define impoint_solver_node_exchange_h

#include <deal.II/base/types.h>

#include <mpi.h>

#include <functional>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  /**
   * The nodes of one rank: those it owns, then ghosts, which others own, by
   * their global number. Brings values of nodes to the ranks where they are
   * ghosts, and back. By default there is one process, which owns all nodes.
   *
   * Values are numbers node by node, the same number of them for each.
   */
  class NodeExchange
  {
  public:
    using Number = types::global_dof_index;

    /** Ghosts of one owner: nodes n_owned + begin ... n_owned + end - 1. */
    struct Segment
    {
      unsigned int rank, begin, end;
    };

    NodeExchange() = default;

    /** Ranks number their nodes one after the other; @p ghosts increase.
     * Collective. */
    NodeExchange(const MPI_Comm             communicator,
                 const unsigned int         n_owned,
                 const std::vector<Number> &ghosts);

    MPI_Comm communicator() const
    {
      return comm;
    }
    bool alone() const
    {
      return !several;
    }
    unsigned int n_ghosts() const
    {
      return ghosts.size();
    }
    Number first_number() const // of the nodes this rank owns
    {
      return first;
    }
    Number global_number(const unsigned int node) const
    {
      return several && node >= n_owned ? ghosts[node - n_owned] : first + node;
    }
    const std::vector<Segment> &owners() const
    {
      return segments;
    }

    /** Ghosts take the values of their owners. Collective, as all below. */
    void update(std::vector<double> &values) const;

    /** Ghosts as their owners mark them. */
    void share(std::vector<char> &marks) const;

    /** Owners add to a node's values those that it has as a ghost, which
     * become 0. */
    void add(std::vector<double> &values) const;

    /** The same, but owners keep the largest. */
    void keep_largest(std::vector<double> &values) const;

    /** Those nodes alone that are marked; ghosts as their owners mark them. */
    NodeExchange select(const std::vector<char> &marks) const;

  private:
    struct Receiver
    {
      unsigned int              rank;
      std::vector<unsigned int> nodes; // its ghosts here
    };

    void collect(const std::function<void(const double, double &)> &combine,
                 std::vector<double> &values) const;

    MPI_Comm              comm    = MPI_COMM_SELF;
    bool                  several = false;
    unsigned int          n_owned = 0; // only if there are several ranks
    Number                first   = 0;
    std::vector<Number>   ghosts;
    std::vector<Segment>  segments;
    std::vector<Receiver> receivers;
  };
} // namespace Impoint

#endif
