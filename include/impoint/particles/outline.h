#ifndef impoint_particles_outline_h
#define impoint_particles_outline_h

#include <impoint/particles/clipping.h>

#include <string>
#include <vector>

namespace Impoint
{
  class ParameterFile;
  struct BodyParameters;

  /**
   * Reads "x y; x y; ... | x y; ..." from the entry @p path: lists of corners,
   * separated by '|'. Throws InputError if a list has fewer than @p at_least
   * corners or a corner is not dim numbers.
   */
  template <int dim>
  std::vector<Corners<dim>> parse_corners(const ParameterFile &file,
                                          const std::string   &path,
                                          const std::string   &text,
                                          const unsigned int   at_least);

  /**
   * Convex parts, without overlap, of the area that @p rings enclose: what lies
   * inside an odd number of them, so holes are rings inside of a ring. One
   * convex ring is one part; anything else is cut into trapezoids at the
   * corners' heights. Throws InputError, naming the entry @p path, if sides
   * cross.
   */
  std::vector<ConvexPolytope<2>>
  convex_parts(const ParameterFile           &file,
               const std::string             &path,
               const std::vector<Corners<2>> &rings);

  /** The body as convex parts: of its outline, or the cells of its mesh (those
   * with warped faces as tetrahedra). */
  template <int dim>
  std::vector<ConvexPolytope<dim>> body_parts(const ParameterFile  &file,
                                              const BodyParameters &body);
} // namespace Impoint

#endif
