#include <impoint/enforcement/constrained_cells.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      /** Whether vertices @p a and @p b of a cell share an edge: in simplices
       * all do; in hypercubes the numbers differ in one bit. */
      bool
      is_edge(const bool simplex, const unsigned int a, const unsigned int b)
      {
        return simplex || ((a ^ b) & ((a ^ b) - 1)) == 0;
      }
    } // namespace



    template <int dim>
    bool ConstrainedCells<dim>::nodes_are_vertices(const Basis<dim>  &basis,
                                                   const unsigned int cell)
    {
      const auto nodes    = basis.nodes(cell);
      const auto vertices = basis.grid().vertices(cell);
      if (nodes.size() != vertices.size())
        return false;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        if (basis.point(nodes[a]).distance(vertices[a]) >
            1e-8 * basis.grid().size(cell))
          return false;
      return true;
    }



    template <int dim>
    typename ConstrainedCells<dim>::Cell
    ConstrainedCells<dim>::describe(const BoundaryParticles<dim> &boundary,
                                    const unsigned int            r,
                                    const Basis<dim>             &basis)
    {
      const auto &range = boundary.ranges()[r];
      const auto  nodes = basis.nodes(range.cell);
      const auto &grid  = basis.grid();
      Cell        cell  = {};
      cell.id           = boundary.id(range.begin);
      cell.n_vertices   = nodes.size();
      cell.vertices.fill(no_vertex);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        cell.vertices[a] = basis.global_index(nodes[a]);
      cell.cell = grid.cell(range.cell)->id().template to_binary<dim>();
      cell.rank = Utilities::MPI::this_mpi_process(grid.communicator());
      cell.size = grid.size(range.cell);
      Tensor<1, dim> centre, normal;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          const double area = boundary.held_area(b);
          cell.area += area;
          centre += area * Tensor<1, dim>(boundary.position(b));
          normal += area * boundary.vector(b, boundary.slots().normal);
        }
      for (unsigned int d = 0; d < dim; ++d)
        {
          cell.centre[d] = centre[d] / cell.area;
          cell.normal[d] = normal[d] / cell.area;
        }
      return cell;
    }



    template <int dim>
    ConstrainedCells<dim>::ConstrainedCells(
      const BoundaryParticles<dim> &boundary,
      const ActiveNodes<dim>       &active,
      const Choice                 &wanted)
      : simplicial(active.basis().grid().simplicial())
      , numbers_of_ranges(boundary.ranges().size(),
                          BackgroundGrid<dim>::nowhere)
    {
      const auto       &basis  = active.basis();
      const auto       &ranges = boundary.ranges();
      std::vector<Cell> own;
      for (unsigned int r = 0; r < ranges.size(); ++r)
        if (active.position(ranges[r].cell) != BackgroundGrid<dim>::nowhere &&
            boundary.held_area_of_range(r) > 0 && (!wanted || wanted(r)) &&
            nodes_are_vertices(basis, ranges[r].cell))
          own.push_back(describe(boundary, r, basis));
      for (const auto &part :
           Utilities::MPI::all_gather(basis.grid().communicator(), own))
        all.insert(all.end(), part.begin(), part.end());
      std::sort(all.begin(), all.end(), [](const Cell &a, const Cell &b) {
        return a.id < b.id;
      });
      for (unsigned int r = 0; r < boundary.ranges().size(); ++r)
        {
          const auto id    = boundary.id(boundary.ranges()[r].begin);
          const auto place = std::lower_bound(
            all.begin(), all.end(), id, [](const Cell &cell, const auto i) {
              return cell.id < i;
            });
          if (place != all.end() && place->id == id)
            numbers_of_ranges[r] = place - all.begin();
        }
    }



    template <int dim>
    bool ConstrainedCells<dim>::share_vertex(const unsigned int i,
                                             const unsigned int j) const
    {
      const auto &a = all[i].vertices, &b = all[j].vertices;
      for (unsigned int v = 0; v < all[i].n_vertices; ++v)
        if (std::find(b.begin(), b.end(), a[v]) != b.end())
          return true;
      return false;
    }



    template <int dim>
    std::vector<typename ConstrainedCells<dim>::Edge>
    ConstrainedCells<dim>::shared_edges(const unsigned int i,
                                        const unsigned int j) const
    {
      const auto               &a = all[i].vertices, &b = all[j].vertices;
      std::vector<unsigned int> shared;
      for (unsigned int v = 0; v < all[i].n_vertices; ++v)
        if (std::find(b.begin(), b.end(), a[v]) != b.end())
          shared.push_back(v);
      std::vector<Edge> edges;
      for (const unsigned int v : shared)
        for (const unsigned int w : shared)
          if (v < w && is_edge(simplicial, v, w))
            edges.emplace_back(v, w);
      return edges;
    }



    template <int dim>
    std::vector<std::vector<unsigned int>>
    ConstrainedCells<dim>::edge_neighbors() const
    {
      std::map<types::global_dof_index, std::vector<unsigned int>> at_vertex;
      for (unsigned int i = 0; i < all.size(); ++i)
        for (unsigned int v = 0; v < all[i].n_vertices; ++v)
          at_vertex[all[i].vertices[v]].push_back(i);
      std::vector<std::vector<unsigned int>> neighbors(all.size());
      for (unsigned int i = 0; i < all.size(); ++i)
        {
          auto &list = neighbors[i];
          for (unsigned int v = 0; v < all[i].n_vertices; ++v)
            for (const unsigned int j : at_vertex[all[i].vertices[v]])
              if (j != i)
                list.push_back(j);
          std::sort(list.begin(), list.end());
          list.erase(std::unique(list.begin(), list.end()), list.end());
          list.erase(std::remove_if(list.begin(),
                                    list.end(),
                                    [&](const unsigned int j) {
                                      return shared_edges(i, j).empty();
                                    }),
                     list.end());
        }
      return neighbors;
    }

    template <int dim>
    std::vector<unsigned int> ConstrainedCells<dim>::pieces(
      const std::vector<std::vector<unsigned int>> &neighbors)
    {
      constexpr auto            none = BackgroundGrid<dim>::nowhere;
      std::vector<unsigned int> first(neighbors.size(), none);
      for (unsigned int i = 0; i < neighbors.size(); ++i)
        {
          if (first[i] != none)
            continue;
          std::vector<unsigned int> front(1, i);
          first[i] = i;
          while (!front.empty())
            {
              const unsigned int at = front.back();
              front.pop_back();
              for (const unsigned int j : neighbors[at])
                if (first[j] == none)
                  {
                    first[j] = i;
                    front.push_back(j);
                  }
            }
        }
      return first;
    }

    template class ConstrainedCells<2>;
    template class ConstrainedCells<3>;
  } // namespace Enforcement
} // namespace Impoint
