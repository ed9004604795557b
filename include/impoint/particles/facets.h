#ifndef impoint_particles_facets_h
#define impoint_particles_facets_h

#include <impoint/particles/boundary_parameters.h>
#include <impoint/particles/clipping.h>

#include <vector>

namespace Impoint
{
  /**
   * The shape of a nonconforming boundary as segments (2D) or convex polygons
   * (3D; a quadrilateral of a mesh may be warped). The order of their corners
   * gives the normal: on the right of a segment, by the right-hand rule of a
   * polygon. Throws InputError.
   */
  template <int dim>
  std::vector<Corners<dim>> make_facets(const ParameterFile      &file,
                                        const BoundaryParameters &boundary);

  /**
   * Turns facets round, given the vertex numbers of their corners in order, so
   * that neighbours agree: with the first of each connected part, or outward if
   * the part is closed. Returns false for a one-sided surface.
   */
  template <int dim>
  bool orient_facets(const std::vector<Point<dim>>          &vertices,
                     std::vector<std::vector<unsigned int>> &facets);
} // namespace Impoint

#endif
