#include <impoint/enforcement/held_areas.h>
#include <impoint/enforcement/wall_facets.h>

#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // Points further from the wall along its normal are not held by it [h].
      constexpr double far_away = 0.5;

      // Points that lie around a particle at this distance [half their edge]
      // have a gap between them that is none of the material.
      constexpr double around = 2.5;



      /** How far aside of a particle's normal the cube of a point reaches: in
       * 3D it is a square seen from there, turned anyhow. */
      template <int dim>
      double reach_aside(const double half)
      {
        return half * std::sqrt(dim - 1.) * (1. + 1e-6);
      }



      /** Number of the quadrant (2D: side) about @p normal that @p away, at
       * right angles to it, points to. */
      template <int dim>
      unsigned int quadrant(const Tensor<1, dim> &away,
                            const Tensor<1, dim> &normal)
      {
        if constexpr (dim == 2)
          return away[0] * normal[1] - away[1] * normal[0] > 0;
        else
          {
            Tensor<1, dim> axis;
            axis[std::abs(normal[0]) < 0.7 ? 0 : 1] = 1.;
            const Tensor<1, dim> first = cross_product_3d(normal, axis);
            return (away * first > 0) +
                   2 * (away * cross_product_3d(normal, first) > 0);
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
       * @p places (of all particles). Collective. */
      template <int dim>
      std::vector<char> are_covered(const BoundaryParticles<dim>    &boundary,
                                    const std::vector<unsigned int> &particles,
                                    const std::vector<Point<dim>>   &places,
                                    const BackgroundGrid<dim>       &grid,
                                    const MaterialPoints<dim>       &points)
      {
        constexpr unsigned int all_ways = (1U << (1U << (dim - 1))) - 1;

        const double   h    = grid.smallest_size();
        const MPI_Comm comm = grid.communicator();
        const auto facets   = all_facets(boundary, particles, places, {}, comm);
        std::vector<unsigned int> ways(facets.size(), 0);
        for (unsigned int i = 0; i < facets.size(); ++i)
          for_points_near(
            facets[i].new_x, h, grid, points, [&](const unsigned int p) {
              const Tensor<1, dim> &normal = facets[i].normal;
              const Tensor<1, dim>  to     = facets[i].new_x - place(points, p);
              const double          before = to * normal;
              const double half = half_edge(points, p, boundary.thickness());
              if (ways[i] == all_ways || before < -h ||
                  before - half > far_away * h)
                return;
              const double distance = aside(to, normal);
              if (distance <= reach_aside<dim>(half))
                ways[i] = all_ways;
              else if (distance <= around * half)
                ways[i] |= 1U << quadrant(to - before * normal, normal);
            });
        // what ranks see of a facet together
        for (const auto &part : Utilities::MPI::all_gather(comm, ways))
          for (unsigned int i = 0; i < ways.size(); ++i)
            ways[i] |= part[i];

        const auto counts = Utilities::MPI::all_gather(comm, particles.size());
        const std::size_t first =
          std::accumulate(counts.begin(),
                          counts.begin() +
                            Utilities::MPI::this_mpi_process(comm),
                          std::size_t(0));
        std::vector<char> covered(particles.size());
        for (unsigned int i = 0; i < covered.size(); ++i)
          covered[i] = ways[first + i] == all_ways;
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
             (active.basis().degree() > 1 &&
              method->contact_states() == nullptr)) &&
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
