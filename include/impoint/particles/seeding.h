#ifndef impoint_particles_seeding_h
#define impoint_particles_seeding_h

#include <impoint/grid/background_grid.h>
#include <impoint/particles/body_parameters.h>
#include <impoint/particles/boundary_parameters.h>

#include <vector>

namespace Impoint
{
  /** A material point to be: place, volume (2D: area), the cell that holds it
   * and its number in the body (the same whatever the number of ranks). */
  template <int dim>
  struct SeededPoint
  {
    Point<dim>   x;
    double       volume = 0;
    unsigned int cell   = 0;
    std::size_t  number = 0;
  };

  /** A boundary particle to be: area [m2] (2D: length), unit normal out of the
   * material. */
  template <int dim>
  struct SeededBoundaryParticle
  {
    Point<dim>     x;
    double         area = 0;
    Tensor<1, dim> normal;
    unsigned int   cell   = 0;
    std::size_t    number = 0;
  };

  /** The body's points that lie in this rank's own cells. Throws InputError, on
   * all ranks, if a part of the body lies outside of the grid. Collective. */
  template <int dim>
  std::vector<SeededPoint<dim>> seed_body(const ParameterFile       &file,
                                          const BodyParameters      &body,
                                          const BackgroundGrid<dim> &grid);

  /** For bodies with 'Points = clipped': what each cell of the grid holds of
   * the body becomes points. A part of a cell's volume below 1e-12 gets none,
   * all but such a part counts as all of it, and the points share what that
   * lacks of the body's volume. Collective. */
  template <int dim>
  std::vector<SeededPoint<dim>> seed_clipped(const ParameterFile       &file,
                                             const BodyParameters      &body,
                                             const BackgroundGrid<dim> &grid);

  /** For bodies with a 'Signed distance': a rule of Saye for the part of each
   * cell where it is negative (SIAM J. Sci. Comput. 37, 2015), on the cubic
   * through its values in the cell, or in the dim + 1 quadrilaterals or
   * hexahedra that make up a simplex. Collective. */
  template <int dim>
  std::vector<SeededPoint<dim>>
  seed_signed_distance(const ParameterFile       &file,
                       const BodyParameters      &body,
                       const BackgroundGrid<dim> &grid);

  /**
   * The boundary's particles that lie in this rank's own cells; of a conforming
   * one, Gauss points on its sides of the grid. Those on a face
   * of the grid belong to the cell on the inner side, against the normal, if
   * there is one. Particles outside of the grid are left out; throws
   * InputError, on all ranks, if all of them are. Collective.
   */
  template <int dim>
  std::vector<SeededBoundaryParticle<dim>>
  seed_boundary(const ParameterFile       &file,
                const BoundaryParameters  &boundary,
                const BackgroundGrid<dim> &grid);
} // namespace Impoint

#endif
