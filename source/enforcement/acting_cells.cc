#include <impoint/enforcement/acting_cells.h>
#include <impoint/enforcement/proximity.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      /** Appends those of @p candidates in which the material reaches @p
       * boundary, or was held by it in the last step if it does not @p let_go.
       */
      template <int dim>
      void append_reached(const BoundaryParticles<dim>    &boundary,
                          const bool                       lets_go,
                          const std::vector<unsigned int> &candidates,
                          const BackgroundGrid<dim>       &grid,
                          const MaterialPoints<dim>       &points,
                          std::vector<unsigned int>       &reached)
      {
        // Cubes of points next to each other leave gaps where they are sheared.
        // A boundary that has not held anything was meant for what is near it,
        // however far its points are from each other.
        constexpr double near = 0.1, near_at_first = 0.5; // [h]

        const bool                keeps_grid = points.carried().keeps_grid;
        std::vector<unsigned int> particles, cells;
        std::vector<Point<dim>>   places(boundary.n());
        bool                      has_held = false;
        for (const auto &range : boundary.ranges())
          {
            const bool is_candidate = std::binary_search(candidates.begin(),
                                                         candidates.end(),
                                                         range.cell);
            bool       holds        = false;
            for (unsigned int b = range.begin; b < range.end && !lets_go; ++b)
              holds |=
                boundary.vector(b, boundary.slots().force).norm_square() > 0;
            has_held |= holds;
            if (is_candidate && holds)
              reached.push_back(range.cell);
            if (!is_candidate || holds)
              continue;
            for (unsigned int b = range.begin; b < range.end; ++b)
              {
                particles.push_back(b);
                cells.push_back(range.cell);
                places[b] =
                  keeps_grid ?
                    Point<dim>(boundary.vector(b, boundary.slots().start)) :
                    boundary.position(b);
              }
          }
        has_held = Utilities::MPI::max(int(has_held), grid.communicator()) != 0;
        const auto found =
          distances_of(boundary, particles, places, {}, grid, points);
        const bool   at_first = !lets_go && (!has_held || keeps_grid);
        const double enough =
          (at_first ? near_at_first : near) * grid.smallest_size();
        for (unsigned int i = 0; i < found.size(); ++i)
          if (found[i].edge <= enough)
            reached.push_back(cells[i]);
      }
    } // namespace



    template <int dim>
    std::vector<unsigned int>
    acting_cells(const Methods<dim>              &methods,
                 const double                     start,
                 const double                     end,
                 const std::vector<unsigned int> &candidates,
                 const BackgroundGrid<dim>       &grid,
                 const MaterialPoints<dim>       &points,
                 std::vector<unsigned int>       &reached)
    {
      std::vector<unsigned int> acting, result;
      reached.clear();
      for (const auto &method : methods)
        {
          const auto &boundary = method->particles();
          const bool  acts     = method->parameters().is_active(start, end);
          // all of a grid that is kept stays active
          if (points.carried().keeps_grid)
            for (const auto &range : boundary.ranges())
              acting.push_back(range.cell);
          if (!acts)
            continue;
          if (method->constrains())
            append_reached(boundary,
                           !method->is_linear(),
                           candidates,
                           grid,
                           points,
                           reached);
          if (!method->constrains() || !method->is_linear())
            for (const auto &range : boundary.ranges())
              acting.push_back(range.cell);
          if (!method->constrains())
            for (const auto &range : boundary.ranges())
              reached.push_back(range.cell);
        }
      const auto sort = [](std::vector<unsigned int> &cells) {
        std::sort(cells.begin(), cells.end());
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
      };
      acting.insert(acting.end(), reached.begin(), reached.end());
      sort(acting);
      sort(reached);
      std::set_intersection(candidates.begin(),
                            candidates.end(),
                            acting.begin(),
                            acting.end(),
                            std::back_inserter(result));
      return result;
    }

#define IMPOINT_INSTANTIATE(dim)                   \
  template std::vector<unsigned int> acting_cells( \
    const Methods<dim> &,                          \
    const double,                                  \
    const double,                                  \
    const std::vector<unsigned int> &,             \
    const BackgroundGrid<dim> &,                   \
    const MaterialPoints<dim> &,                   \
    std::vector<unsigned int> &);

    IMPOINT_INSTANTIATE(2)
    IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
  } // namespace Enforcement
} // namespace Impoint
