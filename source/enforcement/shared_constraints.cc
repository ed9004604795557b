#include <impoint/enforcement/band_patch.h>
#include <impoint/enforcement/gap_patch.h>
#include <impoint/enforcement/shared_constraints.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    void SharedConstraints<dim>::clear()
    {
      parts.clear();
      links.clear();
      lonely.clear();
    }



    template <int dim>
    bool SharedConstraints<dim>::anything_changed(
      const BoundaryParticles<dim> &boundary,
      const ActiveNodes<dim>       &active,
      const Choice                 &may_share)
    {
      std::vector<unsigned int> cells;
      std::vector<double>       particles;
      for (unsigned int r = 0; r < boundary.ranges().size(); ++r)
        {
          const auto &range = boundary.ranges()[r];
          cells.push_back(range.cell);
          cells.push_back(range.end);
          cells.push_back(active.position(range.cell) !=
                          BackgroundGrid<dim>::nowhere);
          cells.push_back(!may_share || may_share(r));
        }
      for (unsigned int b = 0; b < boundary.n(); ++b)
        {
          const Point<dim>     x = boundary.position(b);
          const Tensor<1, dim> normal =
            boundary.vector(b, boundary.slots().normal);
          particles.insert(particles.end(), x.begin_raw(), x.end_raw());
          particles.insert(particles.end(),
                           normal.begin_raw(),
                           normal.end_raw());
          particles.push_back(boundary.held_area(b));
        }
      const bool changed =
        fresh || cells != last_cells || particles != last_particles;
      fresh = false;
      last_cells.swap(cells);
      last_particles.swap(particles);
      return Utilities::MPI::max(int(changed),
                                 active.basis().grid().communicator());
    }



    template <int dim>
    void
    SharedConstraints<dim>::find_groups(const BoundaryParticles<dim> &boundary,
                                        const ActiveNodes<dim>       &active,
                                        const Choice                 &may_share)
    {
      if (!anything_changed(boundary, active, may_share))
        return;
      clear();
      const auto                 &grid = active.basis().grid();
      const ConstrainedCells<dim> constrained(boundary, active, may_share);
      const ConstraintGroups<dim> groups(constrained,
                                         grid.simplicial(),
                                         boundary.thickness());
      const auto                 &cells = constrained.cells();

      std::vector<unsigned int> range_of(cells.size(), nobody);
      parts.resize(boundary.ranges().size());
      for (unsigned int r = 0; r < parts.size(); ++r)
        if (constrained.of_range(r) != BackgroundGrid<dim>::nowhere)
          range_of[constrained.of_range(r)] = r;

      lonely.assign(parts.size(), false);
      const auto piece = constrained.pieces(constrained.edge_neighbors());
      std::vector<unsigned int> n_cells(cells.size(), 0);
      for (const unsigned int i : piece)
        ++n_cells[i];
      for (unsigned int i = 0; i < cells.size(); ++i)
        if (range_of[i] != nobody)
          lonely[range_of[i]] = n_cells[piece[i]] < dim;

      const unsigned int me =
        Utilities::MPI::this_mpi_process(grid.communicator());
      std::map<unsigned int, unsigned int> n_links; // per rank
      for (const auto &group : groups.groups())
        {
          if (group.size() == 1)
            continue;
          const unsigned int middle = groups.hub(group);
          const unsigned int rank   = cells[middle].rank;
          const unsigned int link   = n_links[rank]++;
          for (unsigned int m = 0; m < group.size(); ++m)
            if (range_of[group[m]] != nobody)
              parts[range_of[group[m]]] = {rank, link, m};
          if (rank != me)
            continue;
          links.push_back({range_of[middle], {}, {}});
          for (const unsigned int i : group)
            {
              links.back().cells.push_back(
                grid.triangulation()
                  .create_cell_iterator(CellId(cells[i].cell))
                  ->active_cell_index());
              links.back().ranks.push_back(cells[i].rank);
            }
        }
    }



    template <int dim>
    void SharedConstraints<dim>::append_links(Links &all_links) const
    {
      for (const Link &link : links)
        all_links.add(link.cells);
    }



    template <int dim>
    template <typename Patch>
    std::vector<Patch> SharedConstraints<dim>::collect(
      const ActiveNodes<dim>                         &active,
      const unsigned int                              first,
      const std::function<Patch(const unsigned int)> &empty,
      const std::function<Patch(const unsigned int)> &patch) const
    {
      // In the order of links and members, whatever the number of ranks.
      using Place = std::pair<unsigned int, unsigned int>;
      std::map<unsigned int, std::vector<Place>>  places;
      std::map<unsigned int, std::vector<double>> numbers;
      for (unsigned int r = 0; r < parts.size(); ++r)
        if (contains(r))
          {
            places[parts[r].rank].emplace_back(parts[r].link, parts[r].member);
            patch(r).pack(numbers[parts[r].rank]);
          }
      const MPI_Comm comm   = active.basis().grid().communicator();
      const auto     asked  = Utilities::MPI::some_to_some(comm, places);
      const auto     gotten = Utilities::MPI::some_to_some(comm, numbers);
      std::map<Place, Patch> of_members;
      for (const auto &message : asked)
        {
          const double *next = gotten.at(message.first).data();
          for (const Place &place : message.second)
            {
              const unsigned int cell = links[place.first].cells[place.second];
              Patch              part = empty(active.basis().n_nodes_of(cell));
              next                    = part.unpack(next);
              of_members.emplace(place, part);
            }
        }

      std::vector<Patch> result;
      for (unsigned int l = 0; l < links.size(); ++l)
        {
          const unsigned int k = active.link(first + l);
          result.push_back(empty(active.nodes(k).size()));
          for (unsigned int m = 0; m < links[l].cells.size(); ++m)
            result.back().add_part(of_members.at({l, m}),
                                   active.places(k, links[l].cells[m]));
          result.back().divide_by_area();
        }
      return result;
    }



    template <int dim>
    std::vector<Tensor<1, dim>> SharedConstraints<dim>::distribute(
      const std::vector<Tensor<1, dim>> &of_links,
      const MPI_Comm                     communicator) const
    {
      using Values =
        std::map<std::pair<unsigned int, unsigned int>, Tensor<1, dim>>;
      std::map<unsigned int, Values> answers;
      for (unsigned int l = 0; l < links.size(); ++l)
        for (unsigned int m = 0; m < links[l].cells.size(); ++m)
          answers[links[l].ranks[m]][{l, m}] = of_links[l];
      const auto received = Utilities::MPI::some_to_some(communicator, answers);
      std::vector<Tensor<1, dim>> result(parts.size());
      for (unsigned int r = 0; r < parts.size(); ++r)
        if (contains(r))
          result[r] =
            received.at(parts[r].rank).at({parts[r].link, parts[r].member});
      return result;
    }

    template class SharedConstraints<2>;
    template class SharedConstraints<3>;

#define INSTANTIATE(dim, Patch)                                     \
  template std::vector<Patch<dim>> SharedConstraints<dim>::collect( \
    const ActiveNodes<dim> &,                                       \
    const unsigned int,                                             \
    const std::function<Patch<dim>(const unsigned int)> &,          \
    const std::function<Patch<dim>(const unsigned int)> &) const;
    INSTANTIATE(2, GapPatch)
    INSTANTIATE(3, GapPatch)
    INSTANTIATE(2, BandPatch)
    INSTANTIATE(3, BandPatch)
#undef INSTANTIATE
  } // namespace Enforcement
} // namespace Impoint
