#ifndef impoint_enforcement_acting_cells_h
#define impoint_enforcement_acting_cells_h

#include <impoint/enforcement/enforcement.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Those of @p candidates, cells without material beside it, in which a
     * boundary acts from @p start to @p end: tractions and contact in all of
     * them, other boundaries where the material reaches up to them: they hold
     * nothing beyond it, but go on holding what they held. @p reached receives
     * the cells where the material is up to some boundary. Both increasing.
     * Collective.
     */
    template <int dim>
    std::vector<unsigned int>
    acting_cells(const Methods<dim>              &methods,
                 const double                     start,
                 const double                     end,
                 const std::vector<unsigned int> &candidates,
                 const BackgroundGrid<dim>       &grid,
                 const MaterialPoints<dim>       &points,
                 std::vector<unsigned int>       &reached);
  } // namespace Enforcement
} // namespace Impoint

#endif
