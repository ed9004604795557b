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
    }



    template <int dim>
    bool SharedConstraints<dim>::anything_changed(
      const BoundaryParticles<dim> &boundary,
      const ActiveNodes<dim>       &active)
    {
      std::vector<unsigned int> cells;
      std::vector<double>       particles;
      for (const auto &range : boundary.ranges())
        {
          cells.push_back(range.cell);
          cells.push_back(range.end);
          cells.push_back(active.position(range.cell) !=
                          BackgroundGrid<dim>::nowhere);
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
          particles.push_back(boundary.area(b));
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
                                        const ActiveNodes<dim>       &active)
    {
      if (!anything_changed(boundary, active))
        return;
      clear();
      const auto                 &grid = active.basis().grid();
      const ConstrainedCells<dim> constrained(boundary, active);
      const ConstraintGroups<dim> groups(constrained,
                                         grid.simplicial(),
                                         boundary.thickness());
      const auto                 &cells = constrained.cells();

      std::vector<unsigned int> range_of(cells.size(), nobody);
      parts.resize(boundary.ranges().size());
      for (unsigned int r = 0; r < parts.size(); ++r)
        if (constrained.of_range(r) != BackgroundGrid<dim>::nowhere)
          range_of[constrained.of_range(r)] = r;

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



    namespace
    {
      /** What a rank tells of its patch, as numbers. */
      template <int dim>
      void pack(const GapPatch<dim> &patch, std::vector<double> &numbers)
      {
        numbers.push_back(patch.area);
        for (unsigned int d = 0; d < dim; ++d)
          {
            numbers.push_back(patch.start_gap[d]);
            numbers.push_back(patch.multiplier[d]);
          }
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          if (patch.normal_only)
            numbers.insert(numbers.end(),
                           patch.rows[a].begin_raw(),
                           patch.rows[a].end_raw());
          else
            numbers.push_back(patch.values[a]);
      }

      template <int dim>
      const double *unpack(const double *numbers, GapPatch<dim> &patch)
      {
        patch.area = *numbers++;
        for (unsigned int d = 0; d < dim; ++d)
          {
            patch.start_gap[d]  = *numbers++;
            patch.multiplier[d] = *numbers++;
          }
        for (unsigned int a = 0; a < patch.n_nodes; ++a)
          if (patch.normal_only)
            for (unsigned int d = 0; d < dim; ++d)
              patch.rows[a][d] = *numbers++;
          else
            patch.values[a] = *numbers++;
        return numbers;
      }

      /** Adds @p part, whose nodes are at @p places of @p sum's: until all are
       * there, sums weighted by areas. */
      template <int dim>
      void add_part(const GapPatch<dim>             &part,
                    const std::vector<unsigned int> &places,
                    GapPatch<dim>                   &sum)
      {
        sum.area += part.area;
        sum.start_gap += part.area * part.start_gap;
        sum.multiplier += part.area * part.multiplier;
        for (unsigned int a = 0; a < part.n_nodes; ++a)
          {
            sum.values[places[a]] += part.area * part.values[a];
            sum.rows[places[a]] += part.area * part.rows[a];
          }
      }

      template <int dim>
      void divide_by_area(GapPatch<dim> &sum)
      {
        sum.start_gap /= sum.area;
        sum.multiplier /= sum.area;
        for (unsigned int a = 0; a < sum.n_nodes; ++a)
          {
            sum.values[a] /= sum.area;
            sum.rows[a] /= sum.area;
          }
      }
    } // namespace



    template <int dim>
    std::vector<GapPatch<dim>> SharedConstraints<dim>::collect(
      const ActiveNodes<dim>                                 &active,
      const unsigned int                                      first,
      const bool                                              normal_only,
      const std::function<GapPatch<dim>(const unsigned int)> &patch) const
    {
      // In the order of links and members, whatever the number of ranks.
      using Place = std::pair<unsigned int, unsigned int>;
      std::map<unsigned int, std::vector<Place>>  places;
      std::map<unsigned int, std::vector<double>> numbers;
      for (unsigned int r = 0; r < parts.size(); ++r)
        if (contains(r))
          {
            places[parts[r].rank].emplace_back(parts[r].link, parts[r].member);
            pack(patch(r), numbers[parts[r].rank]);
          }
      const MPI_Comm comm   = active.basis().grid().communicator();
      const auto     asked  = Utilities::MPI::some_to_some(comm, places);
      const auto     gotten = Utilities::MPI::some_to_some(comm, numbers);
      std::map<Place, GapPatch<dim>> of_members;
      for (const auto &message : asked)
        {
          const double *next = gotten.at(message.first).data();
          for (const Place &place : message.second)
            {
              const unsigned int cell = links[place.first].cells[place.second];
              GapPatch<dim> part(normal_only, active.basis().n_nodes_of(cell));
              next = unpack(next, part);
              of_members.emplace(place, part);
            }
        }

      std::vector<GapPatch<dim>> result;
      for (unsigned int l = 0; l < links.size(); ++l)
        {
          const unsigned int k = active.link(first + l);
          result.emplace_back(normal_only, active.nodes(k).size());
          for (unsigned int m = 0; m < links[l].cells.size(); ++m)
            add_part(of_members.at({l, m}),
                     active.places(k, links[l].cells[m]),
                     result.back());
          divide_by_area(result.back());
          if (normal_only)
            result.back().normal[0] = 1.;
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
  } // namespace Enforcement
} // namespace Impoint
