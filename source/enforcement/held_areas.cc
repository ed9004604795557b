#include <impoint/enforcement/held_areas.h>
#include <impoint/enforcement/wall_facets.h>

#include <array>
#include <cmath>
#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // Points further from the wall along its normal are not held by it [h].
      constexpr double far_away = 0.5;

      // Between points at this distance from a particle [half their edge] there
      // is material, too: Gauss points stand for flat boxes, not for cubes.
      constexpr double around = 2.5;



      /** How far aside of a particle's normal the cube of a point reaches: in
       * 3D it is a square seen from there, turned anyhow. */
      template <int dim>
      double reach_aside(const double half)
      {
        return half * std::sqrt(dim - 1.) * (1. + 1e-6);
      }



      template <int dim>
      constexpr unsigned int n_ways = dim == 2 ? 2 : 16;

      /** Unit vectors at right angles to @p normal, all around. */
      template <int dim>
      std::array<Tensor<1, dim>, n_ways<dim>>
      ways_aside(const Tensor<1, dim> &normal)
      {
        if constexpr (dim == 2)
          {
            const Tensor<1, dim> along = cross_product_2d(normal);
            return {{along, -along}};
          }
        else
          {
            Tensor<1, dim> axis;
            axis[std::abs(normal[0]) < 0.7 ? 0 : 1] = 1.;
            Tensor<1, dim> first = cross_product_3d(normal, axis);
            first /= first.norm();
            const Tensor<1, dim> second = cross_product_3d(normal, first);
            std::array<Tensor<1, dim>, n_ways<dim>> ways;
            for (unsigned int i = 0; i < ways.size(); ++i)
              {
                const double angle = 2 * numbers::PI * i / ways.size();
                ways[i] = std::cos(angle) * first + std::sin(angle) * second;
              }
            return ways;
          }
      }



      /** Whether a point in cell @p c itself lies before particle @p b at
       * @p x. */
      template <int dim>
      bool is_covered_by_cell(const BoundaryParticles<dim> &boundary,
                              const unsigned int            b,
                              const Point<dim>             &x,
                              const unsigned int            c,
                              const MaterialPoints<dim>    &points)
      {
        const Tensor<1, dim> normal =
          boundary.vector(b, boundary.slots().normal);
        const auto range = range_in(points, c);
        for (unsigned int p = range.begin; p < range.end; ++p)
          if (aside(x - place(points, p), normal) <=
              reach_aside<dim>(half_edge(points, p, boundary.thickness())))
            return true;
        return false;
      }



      /** Whether material lies before (or behind) each of @p particles at
       * @p places (of all particles): seen along the normal, in a point's cube
       * or not farther than half an edge beside the hull of points around it.
       * Collective. */
      template <int dim>
      std::vector<char> are_covered(const BoundaryParticles<dim>    &boundary,
                                    const std::vector<unsigned int> &particles,
                                    const std::vector<Point<dim>>   &places,
                                    const BackgroundGrid<dim>       &grid,
                                    const MaterialPoints<dim>       &points)
      {
        const double   h    = grid.smallest_size();
        const MPI_Comm comm = grid.communicator();
        const auto facets   = all_facets(boundary, particles, places, {}, comm);
        // bits: ways in which the hull reaches far enough
        constexpr unsigned int    all_ways = (1U << (n_ways<dim>)) - 1;
        std::vector<unsigned int> reached(facets.size(), 0);
        for (unsigned int i = 0; i < facets.size(); ++i)
          {
            const Tensor<1, dim> &normal = facets[i].normal;
            const auto            ways   = ways_aside(normal);
            for_points_near(
              facets[i].new_x, h, grid, points, [&](const unsigned int p) {
                const Tensor<1, dim> to = place(points, p) - facets[i].new_x;
                const double         before = -(to * normal);
                const double half = half_edge(points, p, boundary.thickness());
                if (reached[i] == all_ways || before < -h ||
                    before - half > far_away * h)
                  return;
                const double distance = aside(to, normal);
                if (distance <= reach_aside<dim>(half))
                  reached[i] = all_ways;
                else if (distance <= around * half)
                  for (unsigned int w = 0; w < ways.size(); ++w)
                    if (to * ways[w] >= -half)
                      reached[i] |= 1U << w;
              });
          }
        // what ranks see of a facet together
        for (const auto &part : Utilities::MPI::all_gather(comm, reached))
          for (unsigned int i = 0; i < reached.size(); ++i)
            reached[i] |= part[i];

        const auto counts = Utilities::MPI::all_gather(comm, particles.size());
        const std::size_t first =
          std::accumulate(counts.begin(),
                          counts.begin() +
                            Utilities::MPI::this_mpi_process(comm),
                          std::size_t(0));
        std::vector<char> covered(particles.size());
        for (unsigned int i = 0; i < covered.size(); ++i)
          covered[i] = reached[first + i] == all_ways;
        return covered;
      }



      template <int dim>
      void find_held_area(Method<dim>               &method,
                          const ActiveNodes<dim>    &active,
                          const MaterialPoints<dim> &points)
      {
        auto          &boundary   = method.particles();
        const auto    &slots      = boundary.slots();
        const MPI_Comm comm       = active.basis().grid().communicator();
        const bool     keeps_grid = points.carried().keeps_grid;
        const auto     on_any     = [&](const auto &has) {
          bool any = false;
          for (unsigned int b = 0; b < boundary.n(); ++b)
            any |= has(b);
          return Utilities::MPI::max(int(any), comm) != 0;
        };
        // what was before them at the start stays
        if (keeps_grid && on_any([&](const unsigned int b) {
              return boundary.vector(b, slots.force).norm_square() > 0;
            }))
          return;

        std::vector<Point<dim>>   places(boundary.n());
        std::vector<unsigned int> questions;
        for (unsigned int b = 0; b < boundary.n(); ++b)
          places[b] = keeps_grid ? Point<dim>(boundary.vector(b, slots.start)) :
                                   boundary.position(b);
        for_active_ranges(
          method, active, [&](const unsigned int r, const unsigned int) {
            const auto &range = boundary.ranges()[r];
            for (unsigned int b = range.begin; b < range.end; ++b)
              if (is_covered_by_cell(
                    boundary, b, places[b], range.cell, points))
                boundary.hold(b, true);
              else
                questions.push_back(b);
          });
        const auto covered = are_covered(
          boundary, questions, places, active.basis().grid(), points);
        for (unsigned int i = 0; i < covered.size(); ++i)
          boundary.hold(questions[i], covered[i]);
        if (!on_any(
              [&](const unsigned int b) { return boundary.held_area(b) > 0; }))
          for (unsigned int b = 0; b < boundary.n(); ++b)
            boundary.hold(b, true);
      }
    } // namespace



    template <int dim>
    void find_held_areas(const Methods<dim>        &methods,
                         const double               start,
                         const double               end,
                         const ActiveNodes<dim>    &active,
                         const MaterialPoints<dim> &points)
    {
      for (const auto &method : methods)
        // Means over all of a cell are the better ones where it ends only for
        // linear functions; a contact waits for what comes.
        if ((method->holds_by_particle() ||
             (active.basis().degree() > 1 && method->is_linear())) &&
            method->parameters().is_active(start, end))
          find_held_area(*method, active, points);
    }

#define IMPOINT_INSTANTIATE(dim)                          \
  template void find_held_areas(const Methods<dim> &,     \
                                const double,             \
                                const double,             \
                                const ActiveNodes<dim> &, \
                                const MaterialPoints<dim> &);

    IMPOINT_INSTANTIATE(2)
    IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
  } // namespace Enforcement
} // namespace Impoint
