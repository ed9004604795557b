#include <impoint/enforcement/superfluous_constraints.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      /** A constrained cell: its first particle's id, then the global numbers
       * of its vertices (those it has). */
      using ConstrainedCell    = std::array<types::global_dof_index, 9>;
      constexpr auto no_vertex = numbers::invalid_dof_index;

      unsigned int n_vertices(const ConstrainedCell &cell)
      {
        return std::find(cell.begin() + 1, cell.end(), no_vertex) -
               cell.begin() - 1;
      }

      /** Whether vertices @p a and @p b of a cell share an edge: in simplices
       * all do; in hypercubes the numbers differ in one bit. */
      bool
      is_edge(const bool simplex, const unsigned int a, const unsigned int b)
      {
        return simplex || ((a ^ b) & ((a ^ b) - 1)) == 0;
      }

      using Edge = std::pair<unsigned int, unsigned int>;

      /** Edges of @p cell, as numbers of its vertices, that @p other has. */
      std::vector<Edge> shared_edges(const bool             simplex,
                                     const ConstrainedCell &cell,
                                     const ConstrainedCell &other)
      {
        std::vector<unsigned int> shared;
        for (unsigned int v = 0; v < n_vertices(cell); ++v)
          if (std::find(other.begin() + 1, other.end(), cell[v + 1]) !=
              other.end())
            shared.push_back(v);
        std::vector<Edge> edges;
        for (const unsigned int a : shared)
          for (const unsigned int b : shared)
            if (a < b && is_edge(simplex, a, b))
              edges.emplace_back(a, b);
        return edges;
      }

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

      /** For each cell those with which it shares an edge. */
      std::vector<std::vector<unsigned int>>
      edge_neighbors(const bool                          simplex,
                     const std::vector<ConstrainedCell> &cells)
      {
        std::map<types::global_dof_index, std::vector<unsigned int>> at_vertex;
        for (unsigned int i = 0; i < cells.size(); ++i)
          for (unsigned int v = 0; v < n_vertices(cells[i]); ++v)
            at_vertex[cells[i][v + 1]].push_back(i);
        std::vector<std::vector<unsigned int>> neighbors(cells.size());
        for (unsigned int i = 0; i < cells.size(); ++i)
          {
            for (unsigned int v = 0; v < n_vertices(cells[i]); ++v)
              for (const unsigned int j : at_vertex[cells[i][v + 1]])
                if (j != i)
                  neighbors[i].push_back(j);
            auto &list = neighbors[i];
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
            list.erase(std::remove_if(list.begin(),
                                      list.end(),
                                      [&](const unsigned int j) {
                                        return shared_edges(simplex,
                                                            cells[i],
                                                            cells[j])
                                          .empty();
                                      }),
                       list.end());
          }
        return neighbors;
      }

      /** The first cell of each connected piece and its first neighbour. */
      std::vector<char>
      first_pairs(const std::vector<std::vector<unsigned int>> &neighbors)
      {
        std::vector<char> in_pair(neighbors.size(), false),
          seen(neighbors.size(), false);
        for (unsigned int i = 0; i < neighbors.size(); ++i)
          {
            if (seen[i])
              continue;
            in_pair[i] = true;
            if (!neighbors[i].empty())
              in_pair[neighbors[i].front()] = true;
            std::vector<unsigned int> front(1, i);
            seen[i] = true;
            while (!front.empty())
              {
                const unsigned int at = front.back();
                front.pop_back();
                for (const unsigned int j : neighbors[at])
                  if (!seen[j])
                    {
                      seen[j] = true;
                      front.push_back(j);
                    }
              }
          }
        return in_pair;
      }

      std::vector<char> leave_out(const bool                          simplex,
                                  const std::vector<ConstrainedCell> &cells)
      {
        const auto        neighbors = edge_neighbors(simplex, cells);
        const auto        in_pair   = first_pairs(neighbors);
        std::vector<char> out(cells.size(), false);
        for (unsigned int i = 0; i < cells.size(); ++i)
          {
            if (in_pair[i])
              continue;
            std::vector<std::vector<Edge>> lists;
            for (const unsigned int j : neighbors[i])
              if (!out[j])
                lists.push_back(shared_edges(simplex, cells[i], cells[j]));
            // neighbours with one edge have no choice: they come first
            std::stable_sort(lists.begin(),
                             lists.end(),
                             [](const auto &a, const auto &b) {
                               return a.size() < b.size();
                             });
            out[i] = connect(n_vertices(cells[i]), lists);
          }
        return out;
      }
    } // namespace



    template <int dim>
    std::vector<char>
    superfluous_constraints(const BoundaryParticles<dim> &boundary,
                            const ActiveNodes<dim>       &active)
    {
      const auto                  &basis = active.basis();
      std::vector<ConstrainedCell> own;
      std::vector<unsigned int>    range_of;
      for (unsigned int r = 0; r < boundary.ranges().size(); ++r)
        {
          const auto &range = boundary.ranges()[r];
          const auto  nodes = basis.nodes(range.cell);
          // Cells whose unknowns are not their vertices (hanging nodes, smooth
          // or higher functions) keep what they have.
          if (active.position(range.cell) == BackgroundGrid<dim>::nowhere ||
              nodes.size() != basis.grid().vertices(range.cell).size())
            continue;
          ConstrainedCell cell;
          cell.fill(no_vertex);
          cell[0] = boundary.id(range.begin);
          for (unsigned int b = range.begin; b < range.end; ++b)
            cell[0] =
              std::min<types::global_dof_index>(cell[0], boundary.id(b));
          for (unsigned int a = 0; a < nodes.size(); ++a)
            cell[a + 1] = basis.global_index(nodes[a]);
          own.push_back(cell);
          range_of.push_back(r);
        }

      std::vector<ConstrainedCell> all;
      for (const auto &part :
           Utilities::MPI::all_gather(basis.grid().communicator(), own))
        all.insert(all.end(), part.begin(), part.end());
      std::sort(all.begin(), all.end());
      const auto out = leave_out(basis.grid().simplicial(), all);

      std::vector<char> result(boundary.ranges().size(), false);
      for (unsigned int i = 0; i < own.size(); ++i)
        result[range_of[i]] =
          out[std::lower_bound(all.begin(), all.end(), own[i]) - all.begin()];
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
