#ifndef impoint_enforcement_held_areas_h
#define impoint_enforcement_held_areas_h

#include <impoint/enforcement/enforcement.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Tells those @p methods that act from @p start to @p end, and hold only
     * what is before each of their particles (Method::holds_by_particle()),
     * which particles have material before them: within the cube of a point, or
     * between points. Where no particle of a boundary has, all hold.
     * Collective.
     */
    template <int dim>
    void find_held_areas(const Methods<dim>        &methods,
                         const double               start,
                         const double               end,
                         const ActiveNodes<dim>    &active,
                         const MaterialPoints<dim> &points);
  } // namespace Enforcement
} // namespace Impoint

#endif
