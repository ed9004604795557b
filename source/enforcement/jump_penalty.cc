#include <impoint/enforcement/constrained_cells.h>
#include <impoint/enforcement/jump_penalty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      template <std::size_t dim>
      double dot(const std::array<double, dim> &a,
                 const std::array<double, dim> &b)
      {
        double sum = 0;
        for (unsigned int d = 0; d < dim; ++d)
          sum += a[d] * b[d];
        return sum;
      }

      /** For each cell those beyond its faces, increasing. */
      template <int dim>
      std::vector<std::vector<unsigned int>>
      face_neighbors(const ConstrainedCells<dim> &constrained)
      {
        constexpr unsigned int n_edges   = dim == 2 ? 1 : 3; // at least
        auto                   neighbors = constrained.edge_neighbors();
        for (unsigned int i = 0; i < neighbors.size(); ++i)
          {
            const auto no_neighbor = [&](const unsigned int j) {
              const auto &m = constrained.cells()[i].normal,
                         &n = constrained.cells()[j].normal;
              return constrained.shared_edges(i, j).size() < n_edges ||
                     dot(m, n) <
                       one_wall_cosine * std::sqrt(dot(m, m) * dot(n, n));
            };
            auto &list = neighbors[i];
            list.erase(std::remove_if(list.begin(), list.end(), no_neighbor),
                       list.end());
          }
        return neighbors;
      }
    } // namespace



    template <int dim>
    void JumpPenalty<dim>::clear()
    {
      on = false;
      parts.clear();
      told.clear();
    }



    template <int dim>
    void JumpPenalty<dim>::reinit(const BoundaryParticles<dim> &boundary,
                                  const ActiveNodes<dim>       &active,
                                  const double                  factor,
                                  const double                  young)
    {
      clear();
      on                    = true;
      communicator          = active.basis().grid().communicator();
      const unsigned int me = Utilities::MPI::this_mpi_process(communicator);
      const ConstrainedCells<dim> constrained(boundary, active);
      const auto                 &cells     = constrained.cells();
      const auto                  neighbors = face_neighbors(constrained);
      std::map<unsigned int, unsigned int> range_of; // cells of this rank
      for (unsigned int r = 0; r < boundary.ranges().size(); ++r)
        if (constrained.of_range(r) != BackgroundGrid<dim>::nowhere)
          range_of[constrained.of_range(r)] = r;

      // Both sides list the cells that one tells the other in the same order.
      std::map<unsigned int, std::set<unsigned int>> to, from;
      for (const auto &own : range_of)
        for (const unsigned int j : neighbors[own.first])
          if (cells[j].rank != me)
            {
              to[cells[j].rank].insert(own.first);
              from[cells[j].rank].insert(j);
            }
      for (const auto &message : to)
        for (const unsigned int i : message.second)
          told[message.first].push_back(range_of.at(i));

      parts.resize(boundary.ranges().size());
      for (const auto &own : range_of)
        for (const unsigned int j : neighbors[own.first])
          {
            const auto  &i = cells[own.first];
            const double h = 0.5 * (i.size + cells[j].size),
                         w = factor * Utilities::fixed_power<dim>(h) *
                             boundary.thickness() / young;
            const auto        &others = from[cells[j].rank];
            const unsigned int place =
              cells[j].rank == me ?
                range_of.at(j) :
                std::distance(others.begin(), others.find(j));
            Part &part = parts[own.second];
            part.neighbors.push_back({cells[j].rank, place, w / i.area});
            part.compliance += w / i.area;
          }
    }



    template <int dim>
    void
    JumpPenalty<dim>::exchange(const std::vector<Tensor<1, dim>> &multipliers)
    {
      const unsigned int me = Utilities::MPI::this_mpi_process(communicator);
      std::map<unsigned int, std::vector<Tensor<1, dim>>> values;
      for (const auto &message : told)
        for (const unsigned int r : message.second)
          values[message.first].push_back(multipliers[r]);
      if (Utilities::MPI::n_mpi_processes(communicator) > 1)
        values = Utilities::MPI::some_to_some(communicator, values);
      values[me] = multipliers;
      for (Part &part : parts)
        {
          part.last_shift = part.shift;
          part.shift      = Tensor<1, dim>();
          for (const Neighbor &neighbor : part.neighbors)
            part.shift +=
              neighbor.weight * values.at(neighbor.rank)[neighbor.place];
        }
    }

    template class JumpPenalty<2>;
    template class JumpPenalty<3>;
  } // namespace Enforcement
} // namespace Impoint
