#ifndef impoint_solver_shared_places_h
#define impoint_solver_shared_places_h

#include <impoint/solver/node_exchange.h>

#include <array>
#include <vector>

namespace Impoint
{
  /**
   * A numbering of nodes that several ranks know by nothing but their places on
   * a lattice. The lowest of the ranks that claim a place owns it.
   */
  template <int dim>
  struct SharedPlaces
  {
    /** Some rank must claim each place. Collective. */
    SharedPlaces(const MPI_Comm                           communicator,
                 const std::vector<std::array<int, dim>> &places,
                 const std::vector<char>                 &claimed);

    unsigned int                      n_owned = 0;
    std::vector<NodeExchange::Number> ghosts; // increasing
    std::vector<unsigned int>         order;  // owned places, those of ghosts
  };
} // namespace Impoint

#endif
