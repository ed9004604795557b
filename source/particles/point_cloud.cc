#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/particles/point_cloud.h>

#include <deal.II/base/mpi.h>
#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  template <int dim>
  struct PointCloud<dim>::Handler
  {
    Handler(const BackgroundGrid<dim> &grid, const unsigned int n_properties)
      : particles(grid.triangulation(), grid.mapping(), n_properties)
    {}

    Particles::ParticleHandler<dim> particles;
  };



  template <int dim>
  PointCloud<dim>::PointCloud(const Basis<dim>     &basis,
                              const PropertyLayout &layout)
    : basis(basis)
    , property_layout(layout)
    , reference_slot(property_layout.add("reference place", dim))
    , handler(
        std::make_unique<Handler>(basis.grid(), property_layout.n_doubles()))
  {}



  template <int dim>
  PointCloud<dim>::~PointCloud() = default;



  template <int dim>
  PointCloud<dim>::PointCloud(PointCloud &&) noexcept = default;



  template <int dim>
  types::particle_index PointCloud<dim>::n_global() const
  {
    return handler->particles.n_global_particles();
  }



  template <int dim>
  std::vector<unsigned int> PointCloud<dim>::cells() const
  {
    std::vector<unsigned int> result;
    for (const Range &range : cell_ranges)
      result.push_back(range.cell);
    return result;
  }



  template <int dim>
  void PointCloud<dim>::insert(const std::vector<NewParticle> &particles)
  {
    put_in(particles);
    handler->particles.update_cached_numbers();
    std::vector<unsigned int> occupied = cells();
    for (const NewParticle &particle : particles)
      occupied.push_back(particle.cell);
    list(std::move(occupied));
    evaluate_supports();
  }



  template <int dim>
  void PointCloud<dim>::put_in(const std::vector<NewParticle> &particles)
  {
    std::vector<double> properties(property_layout.n_doubles());
    for (const NewParticle &particle : particles)
      {
        std::copy(particle.properties.begin(),
                  particle.properties.end(),
                  properties.begin());
        put_in(particle.cell, particle.id, properties.data());
      }
  }



  template <int dim>
  void PointCloud<dim>::put_in(const unsigned int          cell,
                               const types::particle_index id,
                               double                     *properties)
  {
    Assert(basis.grid().is_owned(cell), ExcInternalError());
    Point<dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = properties[d];
    const Point<dim> xi = basis.grid().to_reference(cell, x);
    for (unsigned int d = 0; d < dim; ++d)
      properties[reference_slot + d] = xi[d];
    handler->particles.insert_particle(
      x,
      xi,
      id,
      basis.grid().cell(cell),
      ArrayView<const double>(properties, property_layout.n_doubles()));
  }



  template <int dim>
  void PointCloud<dim>::list(std::vector<unsigned int> occupied_cells)
  {
    std::sort(occupied_cells.begin(), occupied_cells.end());
    occupied_cells.erase(std::unique(occupied_cells.begin(),
                                     occupied_cells.end()),
                         occupied_cells.end());
    cell_ranges.clear();
    states.clear();
    ids.clear();
    references.clear();
    for (const unsigned int c : occupied_cells)
      {
        const unsigned int begin = states.size();
        for (auto &particle :
             handler->particles.particles_in_cell(basis.grid().cell(c)))
          {
            states.push_back(particle.get_properties().data());
            ids.push_back(particle.get_id());
            Point<dim> x, xi;
            for (unsigned int d = 0; d < dim; ++d)
              {
                x[d]  = states.back()[d];
                xi[d] = states.back()[reference_slot + d];
              }
            references.push_back(xi);
            particle.set_location(x);
            particle.set_reference_location(xi);
          }
        if (states.size() > begin)
          cell_ranges.push_back(
            {c, begin, static_cast<unsigned int>(states.size())});
      }
  }



  template <int dim>
  void PointCloud<dim>::evaluate_supports()
  {
    first_support.resize(n());
    std::size_t size = 0;
    for (const Range &range : cell_ranges)
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          first_support[p] = size;
          size += basis.support_size(range.cell);
        }
    supports.resize(size);
    for (const Range &range : cell_ranges)
      for (unsigned int p = range.begin; p < range.end; ++p)
        basis.evaluate(range.cell,
                       references[p],
                       supports.data() + first_support[p]);
  }



  template <int dim>
  void PointCloud<dim>::find(const std::vector<Point<dim>> &new_places)
  {
    const BackgroundGrid<dim> &grid = basis.grid();
    std::vector<unsigned int>  strays;
    moves.clear();
    references.resize(n());
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
              message << "point " << ids[strays[i]] << " left the grid at ("
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
    const MPI_Comm comm = basis.grid().communicator();
    for (unsigned int p = 0; p < n(); ++p)
      for (unsigned int d = 0; d < dim; ++d)
        states[p][reference_slot + d] = references[p][d];

    const bool changed =
      Utilities::MPI::max(static_cast<unsigned int>(moves.size()), comm) > 0;
    if (changed)
      {
        const types::particle_index                      n_before = n_global();
        std::map<unsigned int, std::vector<NewParticle>> for_others;
        std::vector<unsigned int>                        occupied = cells();
        change_cells(for_others, occupied);
        if (Utilities::MPI::n_mpi_processes(comm) > 1)
          for (const auto &message :
               Utilities::MPI::some_to_some(comm, for_others))
            {
              put_in(message.second);
              for (const NewParticle &particle : message.second)
                occupied.push_back(particle.cell);
            }
        handler->particles.update_cached_numbers();
        list(std::move(occupied));
        if (n_global() != n_before)
          throw RunFailed(
            "points were lost between cells: " + std::to_string(n_before) +
            " before, " + std::to_string(n_global()) + " after");
        moves.clear();
      }
    evaluate_supports();
    return changed;
  }



  /** Puts the particles that move into their new cells, which are added to
   * @p occupied, or hands them out for other ranks. */
  template <int dim>
  void PointCloud<dim>::change_cells(
    std::map<unsigned int, std::vector<NewParticle>> &for_others,
    std::vector<unsigned int>                        &occupied)
  {
    const unsigned int me =
      Utilities::MPI::this_mpi_process(basis.grid().communicator());
    const unsigned int n_doubles = property_layout.n_doubles();
    std::sort(moves.begin(), moves.end(), [](const Move &a, const Move &b) {
      return a.particle < b.particle;
    });
    std::vector<double> staying; // on this rank, without one allocation each
    std::vector<typename Particles::ParticleHandler<dim>::particle_iterator>
         leaving;
    auto range = cell_ranges.begin();
    for (auto move = moves.begin(); move != moves.end();)
      {
        while (range->end <= move->particle)
          ++range;
        auto particle =
          handler->particles.particles_in_cell(basis.grid().cell(range->cell))
            .begin();
        for (unsigned int p = range->begin;
             p < range->end && move != moves.end();
             ++p, ++particle)
          if (move->particle == p)
            {
              leaving.push_back(particle);
              const double *begin = states[p], *end = begin + n_doubles;
              if (move->rank == me)
                staying.insert(staying.end(), begin, end);
              else
                for_others[move->rank].push_back(
                  {move->cell, ids[p], std::vector<double>(begin, end)});
              ++move;
            }
      }
    handler->particles.remove_particles(leaving);

    double *properties = staying.data();
    for (const Move &move : moves)
      if (move.rank == me)
        {
          put_in(move.cell, ids[move.particle], properties);
          properties += n_doubles;
          if (occupied.back() != move.cell)
            occupied.push_back(move.cell);
        }
  }

  template class PointCloud<2>;
  template class PointCloud<3>;
} // namespace Impoint
