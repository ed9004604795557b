#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/particles/point_cloud.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <sstream>
#include <tuple>

namespace Impoint
{
  template <int dim>
  PointCloud<dim>::PointCloud(const Basis<dim>     &basis,
                              const PropertyLayout &layout,
                              const unsigned int    anchor)
    : basis(basis)
    , property_layout(layout)
    , anchor(anchor)
    , pool(std::make_unique<Pool>(property_layout.n_doubles()))
  {}



  template <int dim>
  PointCloud<dim>::~PointCloud()
  {
    // The pool insists on it.
    if (pool)
      for (auto handle : handles)
        pool->deregister_particle(handle);
  }



  template <int dim>
  PointCloud<dim>::PointCloud(PointCloud &&) noexcept = default;



  template <int dim>
  std::vector<unsigned int> PointCloud<dim>::cells() const
  {
    std::vector<unsigned int> result;
    result.reserve(cell_ranges.size());
    for (const Range &range : cell_ranges)
      result.push_back(range.cell);
    return result;
  }



  template <int dim>
  void PointCloud<dim>::insert(const std::vector<NewParticle> &particles)
  {
    std::vector<Arrival> arrivals;
    pool->reserve(n() + particles.size());
    take_in(particles, arrivals);
    list(std::move(arrivals));
    n_of_all_ranks = Utilities::MPI::sum(types::particle_index(n()),
                                         basis.grid().communicator());
    evaluate_supports();
  }



  /** Puts the particles' state into the pool. */
  template <int dim>
  void PointCloud<dim>::take_in(const std::vector<NewParticle> &particles,
                                std::vector<Arrival>           &arrivals)
  {
    for (const NewParticle &particle : particles)
      {
        Assert(basis.grid().is_owned(particle.cell), ExcInternalError());
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = particle.properties[anchor + d];
        const auto handle = pool->register_particle();
        pool->set_id(handle, particle.id);
        std::copy(particle.properties.begin(),
                  particle.properties.end(),
                  pool->get_properties(handle).begin());
        arrivals.push_back({particle.cell,
                            particle.id,
                            handle,
                            basis.grid().to_reference(particle.cell, x)});
      }
  }



  /** Renews the lists: without the particles in moves, with the arrivals. */
  template <int dim>
  void PointCloud<dim>::list(std::vector<Arrival> arrivals)
  {
    std::sort(arrivals.begin(),
              arrivals.end(),
              [](const Arrival &a, const Arrival &b) {
                return std::tie(a.cell, a.id) < std::tie(b.cell, b.id);
              });
    std::vector<Range>                 old_ranges;
    std::vector<typename Pool::Handle> old_handles;
    std::vector<Point<dim>>            old_references;
    old_ranges.swap(cell_ranges);
    old_handles.swap(handles);
    old_references.swap(references);
    handles.reserve(old_handles.size() + arrivals.size());
    references.reserve(old_handles.size() + arrivals.size());

    auto       move        = moves.cbegin();
    auto       arrival     = arrivals.cbegin();
    const auto append_next = [&]() {
      append(arrival->cell, arrival->handle, arrival->reference);
      ++arrival;
    };
    for (const Range &range : old_ranges)
      {
        while (arrival != arrivals.cend() && arrival->cell < range.cell)
          append_next();
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            if (move != moves.cend() && move->particle == p)
              {
                ++move;
                continue;
              }
            while (arrival != arrivals.cend() && arrival->cell == range.cell &&
                   arrival->id < pool->get_id(old_handles[p]))
              append_next();
            append(range.cell, old_handles[p], old_references[p]);
          }
      }
    while (arrival != arrivals.cend())
      append_next();
    place_states(arrivals.size());
  }



  template <int dim>
  void PointCloud<dim>::append(const unsigned int          cell,
                               const typename Pool::Handle handle,
                               const Point<dim>           &reference)
  {
    if (cell_ranges.empty() || cell_ranges.back().cell != cell)
      cell_ranges.push_back({cell,
                             static_cast<unsigned int>(handles.size()),
                             static_cast<unsigned int>(handles.size())});
    handles.push_back(handle);
    references.push_back(reference);
    ++cell_ranges.back().end;
  }



  /** Finds the states in the pool after @p n_new particles came in. */
  template <int dim>
  void PointCloud<dim>::place_states(const std::size_t n_new)
  {
    // Neighbours in the grid should be so in memory, too; but it costs as much
    // as an assembly to sort all.
    n_unsorted += n_new;
    if (4 * n_unsorted > handles.size())
      {
        pool->sort_memory_slots(handles);
        std::iota(handles.begin(), handles.end(), 0);
        n_unsorted = 0;
      }
    states.resize(handles.size());
    for (std::size_t p = 0; p < handles.size(); ++p)
      states[p] = pool->get_properties(handles[p]).data();
  }



  template <int dim>
  void PointCloud<dim>::evaluate_supports()
  {
    ++evaluations;
    first_support.resize(n());
    std::size_t size = 0;
    for (const Range &range : cell_ranges)
      {
        const unsigned int one = basis.support_size(range.cell);
        for (unsigned int p = range.begin; p < range.end; ++p, size += one)
          first_support[p] = size;
      }
    supports.resize(size);
    for (const Range &range : cell_ranges)
      basis.evaluate(range.cell,
                     ArrayView<const Point<dim>>(references.data() +
                                                   range.begin,
                                                 range.end - range.begin),
                     supports.data() + first_support[range.begin]);
  }



  template <int dim>
  bool PointCloud<dim>::find(const std::vector<Point<dim>> &new_places)
  {
    if (anchor != 0)
      return false;
    const BackgroundGrid<dim> &grid = basis.grid();
    std::vector<unsigned int>  strays;
    moves.clear();
    const unsigned int me =
      Utilities::MPI::this_mpi_process(grid.communicator());
    for (const Range &range : cell_ranges)
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          Point<dim> &xi = references[p];
          xi             = grid.to_reference(range.cell, new_places[p]);
          if (grid.is_inside(xi))
            continue;
          const unsigned int c = grid.walk(new_places[p], range.cell, xi);
          if (c != BackgroundGrid<dim>::nowhere && grid.is_owned(c))
            {
              if (c != range.cell)
                moves.push_back({p, c, me});
            }
          else
            strays.push_back(p);
        }
    if (Utilities::MPI::max(static_cast<unsigned int>(strays.size()),
                            grid.communicator()) > 0)
      find_strays(new_places, strays);
    return true;
  }



  /** Strays left this rank's cells: asks every rank whose they are. */
  template <int dim>
  void PointCloud<dim>::find_strays(const std::vector<Point<dim>>   &new_places,
                                    const std::vector<unsigned int> &strays)
  {
    const BackgroundGrid<dim> &grid = basis.grid();
    const unsigned int         me =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::vector<Point<dim>> places;
    for (const unsigned int p : strays)
      places.push_back(new_places[p]);

    const auto asked = Utilities::MPI::all_gather(grid.communicator(), places);
    std::vector<std::vector<unsigned int>> answers(asked.size());
    for (unsigned int rank = 0; rank < asked.size(); ++rank)
      for (const Point<dim> &x : asked[rank])
        {
          Point<dim>         xi;
          const unsigned int c = grid.find(x, xi);
          answers[rank].push_back(c != BackgroundGrid<dim>::nowhere &&
                                      grid.is_owned(c) ?
                                    c :
                                    BackgroundGrid<dim>::nowhere);
        }
    const auto answered =
      Utilities::MPI::all_gather(grid.communicator(), answers);

    on_all_ranks(grid.communicator(), [&]() {
      for (unsigned int i = 0; i < strays.size(); ++i)
        {
          unsigned int rank = 0;
          while (rank < answered.size() &&
                 answered[rank][me][i] == BackgroundGrid<dim>::nowhere)
            ++rank;
          if (rank == answered.size())
            {
              std::ostringstream message;
              message << "point " << id(strays[i]) << " left the grid at ("
                      << places[i]
                      << "). Enlarge the grid there, or hold the body";
              throw StepFailed(message.str());
            }
          moves.push_back({strays[i], answered[rank][me][i], rank});
        }
    });
  }



  template <int dim>
  bool PointCloud<dim>::move()
  {
    if (anchor != 0)
      return false;
    const MPI_Comm comm = basis.grid().communicator();
    const bool     changed =
      Utilities::MPI::max(static_cast<unsigned int>(moves.size()), comm) > 0;
    if (changed)
      {
        change_cells();
        const types::particle_index n_now =
          Utilities::MPI::sum(types::particle_index(n()), comm);
        if (n_now != n_of_all_ranks)
          throw RunFailed("points were lost between cells: " +
                          std::to_string(n_of_all_ranks) + " before, " +
                          std::to_string(n_now) + " after");
      }
    evaluate_supports();
    return changed;
  }



  template <int dim>
  void PointCloud<dim>::change_cells()
  {
    const MPI_Comm     comm = basis.grid().communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);
    std::sort(moves.begin(), moves.end(), [](const Move &a, const Move &b) {
      return a.particle < b.particle;
    });
    std::vector<Arrival>                             arrivals;
    std::map<unsigned int, std::vector<NewParticle>> for_others;
    for (const Move &move : moves)
      {
        auto &handle = handles[move.particle];
        if (move.rank == me)
          arrivals.push_back({move.cell,
                              pool->get_id(handle),
                              handle,
                              references[move.particle]});
        else
          {
            const double *state = states[move.particle];
            for_others[move.rank].push_back(
              {move.cell,
               pool->get_id(handle),
               std::vector<double>(state,
                                   state + property_layout.n_doubles())});
            pool->deregister_particle(handle);
          }
      }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      for (const auto &message : Utilities::MPI::some_to_some(comm, for_others))
        take_in(message.second, arrivals);
    list(std::move(arrivals));
    moves.clear();
  }

  template class PointCloud<2>;
  template class PointCloud<3>;
} // namespace Impoint
