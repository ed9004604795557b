#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/particles/point_cloud.h>

#include <deal.II/base/mpi.h>
#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <map>
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
    , handler(std::make_unique<Handler>(basis.grid().triangulation(),
                                        basis.grid().mapping(),
                                        property_layout.n_doubles()))
    , pool(&handler->get_property_pool())
  {}



  template <int dim>
  PointCloud<dim>::~PointCloud() = default;



  template <int dim>
  PointCloud<dim>::PointCloud(PointCloud &&) noexcept = default;



  template <int dim>
  types::particle_index PointCloud<dim>::n_global() const
  {
    return handler->n_global_particles();
  }



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
    announce(particles, arrivals);
    handler->reserve(n() + particles.size());
    exchange({}, arrivals);
    list(arrivals);
    handler->update_cached_numbers();
    for (const Range &range : cell_ranges)
      evaluate_supports(range);
    ++evaluations;
  }



  template <int dim>
  void PointCloud<dim>::announce(const std::vector<NewParticle> &particles,
                                 std::vector<Arrival>           &arrivals) const
  {
    for (const NewParticle &particle : particles)
      {
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = particle.properties[anchor + d];
        arrivals.push_back({particle.cell,
                            particle.id,
                            basis.grid().to_reference(particle.cell, x),
                            particle.properties.data(),
                            Pool::invalid_handle});
      }
  }



  /**
   * Takes out particles, sorted by cell, and puts in others, which are sorted
   * then. The pool hands out first what was freed last; so what comes into a
   * cell gets the memory of what left it, as far as possible: particles that
   * are neighbours in the grid stay so in memory.
   */
  template <int dim>
  void PointCloud<dim>::exchange(const std::vector<Departure> &departures,
                                 std::vector<Arrival>         &arrivals)
  {
    std::sort(arrivals.begin(),
              arrivals.end(),
              [](const Arrival &a, const Arrival &b) {
                return std::tie(a.cell, a.id) < std::tie(b.cell, b.id);
              });
    std::vector<unsigned int> out, in, others_out, others_in;
    unsigned int              d = 0, a = 0;
    while (d < departures.size() || a < arrivals.size())
      if (a == arrivals.size() ||
          (d < departures.size() && departures[d].cell < arrivals[a].cell))
        others_out.push_back(d++);
      else if (d == departures.size() || arrivals[a].cell < departures[d].cell)
        others_in.push_back(a++);
      else
        {
          out.push_back(d++);
          in.push_back(a++);
        }
    out.insert(out.end(), others_out.begin(), others_out.end());
    in.insert(in.end(), others_in.begin(), others_in.end());

    for (auto i = out.rbegin(); i != out.rend(); ++i)
      take_out(departures[*i]);
    for (const unsigned int i : in)
      put_in(arrivals[i]);
  }



  template <int dim>
  void PointCloud<dim>::take_out(const Departure &departure)
  {
    auto particle =
      handler->particles_in_cell(basis.grid().cell(departure.cell)).begin();
    while (particle->get_local_index() != departure.handle)
      ++particle;
    handler->remove_particle(particle);
  }



  template <int dim>
  void PointCloud<dim>::put_in(Arrival &arrival)
  {
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = arrival.state[d];
    arrival.handle =
      handler
        ->insert_particle(x,
                          arrival.reference,
                          arrival.id,
                          basis.grid().cell(arrival.cell),
                          ArrayView<const double>(arrival.state,
                                                  property_layout.n_doubles()))
        ->get_local_index();
  }



  /** Renews the lists: without the particles in moves, with the arrivals. */
  template <int dim>
  void PointCloud<dim>::list(const std::vector<Arrival> &arrivals)
  {
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

    states.resize(handles.size());
    for (std::size_t p = 0; p < handles.size(); ++p)
      states[p] = pool->get_properties(handles[p]).data();
    place_supports();
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



  template <int dim>
  void PointCloud<dim>::place_supports()
  {
    first_support.resize(n());
    std::size_t size = 0;
    for (const Range &range : cell_ranges)
      {
        const unsigned int one = basis.support_size(range.cell);
        for (unsigned int p = range.begin; p < range.end; ++p, size += one)
          first_support[p] = size;
      }
    supports.resize(size);
  }



  template <int dim>
  void PointCloud<dim>::evaluate_supports(const Range &range)
  {
    basis.evaluate(range.cell,
                   ArrayView<const Point<dim>>(references.data() + range.begin,
                                               range.end - range.begin),
                   supports.data() + first_support[range.begin]);
  }



  template <int dim>
  void PointCloud<dim>::renew_supports(const Range &range)
  {
    if (anchor != 0 || !moves.empty())
      return;
    evaluate_supports(range);
    n_renewed += range.end - range.begin;
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
        const types::particle_index n_before = n_global();
        change_cells();
        handler->update_cached_numbers();
        if (n_global() != n_before)
          throw RunFailed(
            "points were lost between cells: " + std::to_string(n_before) +
            " before, " + std::to_string(n_global()) + " after");
      }
    if (changed || n_renewed < n())
      for (const Range &range : cell_ranges)
        evaluate_supports(range);
    ++evaluations;
    n_renewed = 0;
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
    const unsigned int     n_doubles = property_layout.n_doubles();
    std::vector<double>    leaving(moves.size() * n_doubles); // states
    std::vector<Departure> departures;
    std::vector<Arrival>   arrivals;
    std::map<unsigned int, std::vector<NewParticle>> for_others, from_others;
    auto    range = cell_ranges.begin();
    double *state = leaving.data();
    for (const Move &move : moves)
      {
        while (range->end <= move.particle)
          ++range;
        const types::particle_index id = this->id(move.particle);
        std::copy_n(states[move.particle], n_doubles, state);
        departures.push_back({range->cell, handles[move.particle]});
        if (move.rank == me)
          arrivals.push_back({move.cell,
                              id,
                              references[move.particle],
                              state,
                              Pool::invalid_handle});
        else
          for_others[move.rank].push_back(
            {move.cell, id, std::vector<double>(state, state + n_doubles)});
        state += n_doubles;
      }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      from_others = Utilities::MPI::some_to_some(comm, for_others);
    for (const auto &message : from_others)
      announce(message.second, arrivals);
    exchange(departures, arrivals);
    list(arrivals);
    moves.clear();
  }

  template class PointCloud<2>;
  template class PointCloud<3>;
} // namespace Impoint
