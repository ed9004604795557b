#include <impoint/enforcement/constraint_groups.h>
#include <impoint/enforcement/gap_patch.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // What differs by less is alike: ranks round differently.
      constexpr double resolution = 1e-6;

      long rounded(const double value)
      {
        return std::lround(value / resolution);
      }
    } // namespace



    template <int dim>
    ConstraintGroups<dim>::ConstraintGroups(
      const ConstrainedCells<dim> &constrained,
      const bool                   simplicial,
      const double                 thickness)
      : constrained(constrained)
      , thickness(thickness)
    {
      for (const auto &cell : constrained.cells())
        {
          group_of.push_back(sums.size());
          sums.push_back({{group_of.back()}, cell.area, {}, {}});
          for (unsigned int d = 0; d < dim; ++d)
            {
              sums.back().centre[d] = cell.area * cell.centre[d];
              sums.back().normal[d] = cell.area * cell.normal[d];
            }
        }
      join_neighbors(simplicial ? 1. : 0.4);
      for (auto &sum : sums)
        if (!sum.cells.empty())
          {
            std::sort(sum.cells.begin(), sum.cells.end());
            members.push_back(sum.cells);
          }
    }



    template <int dim>
    unsigned int
    ConstraintGroups<dim>::hub(const std::vector<unsigned int> &group) const
    {
      for (const unsigned int i : group)
        if (std::all_of(group.begin(), group.end(), [&](const unsigned int j) {
              return constrained.share_vertex(i, j);
            }))
          return i;
      return BackgroundGrid<dim>::nowhere;
    }



    template <int dim>
    bool ConstraintGroups<dim>::may_join(const unsigned int a,
                                         const unsigned int b) const
    {
      const Tensor<1, dim> &m = sums[a].normal, &n = sums[b].normal;
      if (m * n < one_wall_cosine * m.norm() * n.norm())
        return false;
      std::vector<unsigned int> all(sums[a].cells);
      all.insert(all.end(), sums[b].cells.begin(), sums[b].cells.end());
      std::set<types::global_dof_index> vertices;
      for (const unsigned int i : all)
        for (unsigned int v = 0; v < constrained.cells()[i].n_vertices; ++v)
          vertices.insert(constrained.cells()[i].vertices[v]);
      return vertices.size() <= largest_support &&
             hub(all) != BackgroundGrid<dim>::nowhere;
    }



    /** The group that group @p a should join. */
    template <int dim>
    unsigned int ConstraintGroups<dim>::nearest(
      const unsigned int                            a,
      const std::vector<std::vector<unsigned int>> &neighbors) const
    {
      const double                            h = constrained.cells()[a].size;
      std::set<std::pair<long, unsigned int>> candidates;
      for (const unsigned int i : sums[a].cells)
        for (const unsigned int j : neighbors[i])
          if (group_of[j] != a)
            {
              const Sum &other = sums[group_of[j]];
              candidates.emplace(rounded((other.centre / other.area -
                                          sums[a].centre / sums[a].area)
                                           .norm() /
                                         h),
                                 group_of[j]);
            }
      for (const auto &candidate : candidates)
        if (may_join(a, candidate.second))
          return candidate.second;
      return BackgroundGrid<dim>::nowhere;
    }



    /** Moves group @p a into group @p b. */
    template <int dim>
    void ConstraintGroups<dim>::join(const unsigned int a, const unsigned int b)
    {
      for (const unsigned int i : sums[a].cells)
        group_of[i] = b;
      sums[b].cells.insert(sums[b].cells.end(),
                           sums[a].cells.begin(),
                           sums[a].cells.end());
      sums[b].area += sums[a].area;
      sums[b].centre += sums[a].centre;
      sums[b].normal += sums[a].normal;
      sums[a].cells.clear();
    }



    template <int dim>
    void ConstraintGroups<dim>::join_neighbors(const double smallest)
    {
      const auto                neighbors = constrained.edge_neighbors();
      const auto                piece     = constrained.pieces(neighbors);
      std::vector<unsigned int> n_groups(neighbors.size(), 0);
      for (const unsigned int i : piece)
        ++n_groups[i];

      // area in units of h^(dim-1), and group
      std::set<std::pair<long, unsigned int>> small;
      const auto                              part = [&](const unsigned int a) {
        return rounded(
          sums[a].area / thickness /
          Utilities::fixed_power<dim - 1>(constrained.cells()[a].size));
      };
      const auto insert = [&](const unsigned int a) {
        if (part(a) < rounded(smallest))
          small.emplace(part(a), a);
      };
      for (unsigned int a = 0; a < sums.size(); ++a)
        insert(a);
      while (!small.empty())
        {
          const unsigned int a = small.begin()->second;
          small.erase(small.begin());
          if (n_groups[piece[a]] <= dim)
            continue;
          const unsigned int b = nearest(a, neighbors);
          if (b == BackgroundGrid<dim>::nowhere)
            continue;
          --n_groups[piece[a]];
          small.erase({part(b), b});
          join(a, b);
          insert(b);
        }
    }

    template class ConstraintGroups<2>;
    template class ConstraintGroups<3>;
  } // namespace Enforcement
} // namespace Impoint
