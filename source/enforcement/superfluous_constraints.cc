#include <impoint/enforcement/constrained_cells.h>
#include <impoint/enforcement/superfluous_constraints.h>

#include <algorithm>
#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      using Edge = std::pair<unsigned int, unsigned int>;

      /** Whether one edge of each list can be chosen so that they connect
       * @p n vertices. */
      bool connect(const unsigned int                    n,
                   const std::vector<std::vector<Edge>> &lists)
      {
        std::vector<unsigned int> part(n);
        std::iota(part.begin(), part.end(), 0);
        unsigned int n_parts = n;
        for (const auto &edges : lists)
          for (const Edge &edge : edges)
            if (part[edge.first] != part[edge.second])
              {
                const unsigned int from = part[edge.second];
                std::replace(part.begin(), part.end(), from, part[edge.first]);
                --n_parts;
                break;
              }
        return n_parts == 1;
      }

      /** The first cell of each connected piece and its first neighbour. */
      std::vector<char>
      first_pairs(const std::vector<unsigned int>              &pieces,
                  const std::vector<std::vector<unsigned int>> &neighbors)
      {
        std::vector<char> in_pair(neighbors.size(), false);
        for (unsigned int i = 0; i < neighbors.size(); ++i)
          if (pieces[i] == i)
            {
              in_pair[i] = true;
              if (!neighbors[i].empty())
                in_pair[neighbors[i].front()] = true;
            }
        return in_pair;
      }

      template <int dim>
      std::vector<char> leave_out(const ConstrainedCells<dim> &constrained)
      {
        const auto neighbors = constrained.edge_neighbors();
        const auto in_pair =
          first_pairs(constrained.pieces(neighbors), neighbors);
        std::vector<char> out(neighbors.size(), false);
        for (unsigned int i = 0; i < neighbors.size(); ++i)
          {
            if (in_pair[i])
              continue;
            std::vector<std::vector<Edge>> lists;
            for (const unsigned int j : neighbors[i])
              if (!out[j])
                lists.push_back(constrained.shared_edges(i, j));
            // neighbours with one edge have no choice: they come first
            std::stable_sort(lists.begin(),
                             lists.end(),
                             [](const auto &a, const auto &b) {
                               return a.size() < b.size();
                             });
            out[i] = connect(constrained.cells()[i].n_vertices, lists);
          }
        return out;
      }
    } // namespace



    template <int dim>
    std::vector<char>
    superfluous_constraints(const BoundaryParticles<dim> &boundary,
                            const ActiveNodes<dim>       &active)
    {
      const ConstrainedCells<dim> constrained(boundary, active);
      const auto                  out = leave_out(constrained);
      std::vector<char>           result(boundary.ranges().size(), false);
      for (unsigned int r = 0; r < result.size(); ++r)
        if (constrained.of_range(r) != BackgroundGrid<dim>::nowhere)
          result[r] = out[constrained.of_range(r)];
      return result;
    }

    template std::vector<char>
    superfluous_constraints(const BoundaryParticles<2> &,
                            const ActiveNodes<2> &);
    template std::vector<char>
    superfluous_constraints(const BoundaryParticles<3> &,
                            const ActiveNodes<3> &);
  } // namespace Enforcement
} // namespace Impoint
