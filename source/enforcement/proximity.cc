#include <impoint/base/exceptions.h>
#include <impoint/enforcement/proximity.h>
#include <impoint/enforcement/wall_facets.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // A point that gets that far beyond a wall has passed it [h], ...
      constexpr double passed = 0.05;

      // ... if at least that part of it in one step: smaller steps let the wall
      // push it back in time.
      constexpr double fast = 0.2;


      std::vector<unsigned int> all_of(const unsigned int n)
      {
        std::vector<unsigned int> numbers(n);
        std::iota(numbers.begin(), numbers.end(), 0U);
        return numbers;
      }
    } // namespace



    template <int dim>
    std::vector<Proximity>
    distances_of(const BoundaryParticles<dim>    &boundary,
                 const std::vector<unsigned int> &particles,
                 const std::vector<Point<dim>>   &places,
                 const std::vector<char>         &closed,
                 const BackgroundGrid<dim>       &grid,
                 const MaterialPoints<dim>       &points)
    {
      const double h = grid.smallest_size();
      const auto   facets =
        all_facets(boundary, particles, places, closed, grid.communicator());
      std::vector<double> edge(facets.size(), h), centre(facets.size(), 0.);
      for (unsigned int i = 0; i < facets.size(); ++i)
        for_points_near(
          facets[i].new_x, h, grid, points, [&](const unsigned int p) {
            const Tensor<1, dim> away   = facets[i].new_x - place(points, p);
            const double         before = away * facets[i].normal;
            const double half = half_edge(points, p, boundary.thickness());
            if (before > -h && aside(away, facets[i].normal) <=
                                 facets[i].search *
                                   std::max(facets[i].radius, half) *
                                   (1. + 1e-10))
              {
                edge[i]   = std::min(edge[i], before - half);
                centre[i] = std::min(centre[i], before);
              }
          });
      if (!edge.empty())
        for (auto *values : {&edge, &centre})
          Utilities::MPI::min(*values, grid.communicator(), *values);

      const auto counts =
        Utilities::MPI::all_gather(grid.communicator(), particles.size());
      const unsigned int rank =
        Utilities::MPI::this_mpi_process(grid.communicator());
      const std::size_t first =
        std::accumulate(counts.begin(), counts.begin() + rank, std::size_t(0));
      std::vector<Proximity> own(particles.size());
      for (unsigned int i = 0; i < own.size(); ++i)
        own[i] = {edge[first + i], -centre[first + i]};
      return own;
    }



    template <int dim>
    std::vector<Proximity> distances(const BoundaryParticles<dim> &boundary,
                                     const std::vector<char>      &closed,
                                     const BackgroundGrid<dim>    &grid,
                                     const MaterialPoints<dim>    &points)
    {
      std::vector<Point<dim>> places(boundary.n());
      for (unsigned int b = 0; b < boundary.n(); ++b)
        places[b] = boundary.position(b);
      return distances_of(
        boundary, all_of(boundary.n()), places, closed, grid, points);
    }



    template <int dim>
    void check_crossing(const Methods<dim>                         &methods,
                        const BackgroundGrid<dim>                  &grid,
                        const MaterialPoints<dim>                  &points,
                        const std::vector<Point<dim>>              &new_places,
                        const std::vector<std::vector<Point<dim>>> &wall_places)
    {
      if (std::none_of(methods.begin(), methods.end(), [](const auto &method) {
            return method->is_active() && method->constrains();
          }))
        return;
      const MPI_Comm comm    = grid.communicator();
      const double   h       = grid.smallest_size();
      double         fastest = 0;
      for (unsigned int p = 0; p < points.n(); ++p)
        fastest =
          std::max(fastest, (new_places[p] - points.position(p)).norm_square());
      for (unsigned int m = 0; m < methods.size(); ++m)
        if (methods[m]->moves() && methods[m]->is_active())
          for (unsigned int b = 0; b < wall_places[m].size(); ++b)
            fastest =
              std::max(fastest,
                       (wall_places[m][b] - methods[m]->particles().position(b))
                         .norm_square());
      fastest = std::sqrt(Utilities::MPI::max(fastest, comm));
      if (fastest <= fast * passed * h)
        return;

      int          crossed = 0;
      const double thickness =
        methods.empty() ? 1. : methods.front()->particles().thickness();
      for (unsigned int m = 0; m < methods.size(); ++m)
        if (methods[m]->is_active() && methods[m]->constrains())
          for (const auto &facet :
               all_facets(methods[m]->particles(),
                          all_of(methods[m]->particles().n()),
                          wall_places[m],
                          {},
                          comm))
            for_points_near(
              facet.x,
              h + 2. * fastest,
              grid,
              points,
              [&](const unsigned int p) {
                const Tensor<1, dim> before = points.position(p) - facet.x,
                                     after  = new_places[p] - facet.new_x;
                const double from           = before * facet.normal,
                             to             = after * facet.normal;
                if (to <= passed * h || from > passed * h ||
                    to - from <= fast * passed * h)
                  return;
                // where it meets the plane of the facet
                const double         part = from / (from - to);
                const Tensor<1, dim> meet = before + part * (after - before);
                crossed |=
                  aside(meet, facet.normal) <=
                  std::max(facet.radius, half_edge(points, p, thickness));
              });
      if (Utilities::MPI::max(crossed, comm))
        throw StepFailed("a material point would pass a wall in one step");
    }

#define IMPOINT_INSTANTIATE(dim)                                            \
  template std::vector<Proximity> distances(const BoundaryParticles<dim> &, \
                                            const std::vector<char> &,      \
                                            const BackgroundGrid<dim> &,    \
                                            const MaterialPoints<dim> &);   \
  template std::vector<Proximity> distances_of(                             \
    const BoundaryParticles<dim> &,                                         \
    const std::vector<unsigned int> &,                                      \
    const std::vector<Point<dim>> &,                                        \
    const std::vector<char> &,                                              \
    const BackgroundGrid<dim> &,                                            \
    const MaterialPoints<dim> &);                                           \
  template void check_crossing(const Methods<dim> &,                        \
                               const BackgroundGrid<dim> &,                 \
                               const MaterialPoints<dim> &,                 \
                               const std::vector<Point<dim>> &,             \
                               const std::vector<std::vector<Point<dim>>> &);

    IMPOINT_INSTANTIATE(2)
    IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
  } // namespace Enforcement
} // namespace Impoint
