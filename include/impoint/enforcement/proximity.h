#ifndef impoint_enforcement_proximity_h
#define impoint_enforcement_proximity_h

#include <impoint/enforcement/enforcement.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /** Where the material is, seen from a boundary particle along its normal.
     */
    struct Proximity
    {
      double edge =
        0; // of the nearest material point; below 0: beyond the wall
      double depth = 0; // how far a point's centre is beyond the wall
    };

    /**
     * How far the material is from each of this rank's particles of a boundary;
     * one cell size where none is near. A point reaches half the edge of the
     * cube of its volume; along the wall, to find a particle that was @p
     * closed, the double. Collective.
     */
    template <int dim>
    std::vector<Proximity> distances(const BoundaryParticles<dim> &boundary,
                                     const std::vector<char>      &closed,
                                     const BackgroundGrid<dim>    &grid,
                                     const MaterialPoints<dim>    &points);

    /** The same of @p particles alone, at @p places (of all particles). */
    template <int dim>
    std::vector<Proximity>
    distances_of(const BoundaryParticles<dim>    &boundary,
                 const std::vector<unsigned int> &particles,
                 const std::vector<Point<dim>>   &places,
                 const std::vector<char>         &closed,
                 const BackgroundGrid<dim>       &grid,
                 const MaterialPoints<dim>       &points);

    /**
     * Throws StepFailed, on all ranks, if a material point would pass one of
     * the walls in one step: @p new_places are those of the points,
     * @p wall_places[m] those of the particles of method m. Collective.
     */
    template <int dim>
    void
    check_crossing(const Methods<dim>                         &methods,
                   const BackgroundGrid<dim>                  &grid,
                   const MaterialPoints<dim>                  &points,
                   const std::vector<Point<dim>>              &new_places,
                   const std::vector<std::vector<Point<dim>>> &wall_places);
  } // namespace Enforcement
} // namespace Impoint

#endif
