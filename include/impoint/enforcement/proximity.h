#ifndef impoint_enforcement_proximity_h
#define impoint_enforcement_proximity_h

#include <impoint/enforcement/enforcement.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * How far the material is from the particles of a boundary: for each of
     * this rank's, along its normal, from the edge of the nearest material
     * point that lies before it. Negative where a point reaches beyond, one
     * cell size where none is near. A point reaches half the edge of the cube
     * of its volume. Collective.
     */
    template <int dim>
    std::vector<double> distances(const BoundaryParticles<dim> &boundary,
                                  const ActiveNodes<dim>       &active,
                                  const MaterialPoints<dim>    &points);

    /**
     * Throws StepFailed, on all ranks, if a material point would pass one of
     * the walls in one step: @p new_places are those of the points,
     * @p wall_places[m] those of the particles of method m. Collective.
     */
    template <int dim>
    void
    check_crossing(const Methods<dim>                         &methods,
                   const ActiveNodes<dim>                     &active,
                   const MaterialPoints<dim>                  &points,
                   const std::vector<Point<dim>>              &new_places,
                   const std::vector<std::vector<Point<dim>>> &wall_places);
  } // namespace Enforcement
} // namespace Impoint

#endif
