#ifndef impoint_particles_clipping_h
#define impoint_particles_clipping_h

#include <impoint/grid/background_grid.h>

#include <array>
#include <string>
#include <vector>

namespace Impoint
{
  /** Corners of a convex polygon in order (in 2D also of a segment). */
  template <int dim>
  using Corners = std::vector<Point<dim>>;

  /**
   * Keeps the part of a convex polygon or segment that lies in @p half_space.
   * Corners within round-off of its border count as on it. Nothing is left if
   * no corner lies strictly inside.
   */
  template <int dim>
  void clip(Corners<dim> &corners, const HalfSpace<dim> &half_space);

  /**
   * Sum of the outer products of successive edges from the first corner, over
   * two: normal to the polygon, with its area for length; right-hand rule.
   */
  Tensor<1, 3> area_vector(const Corners<3> &polygon);

  /** A convex polygon (2D) or polyhedron (3D) that can be cut by half spaces.
   */
  template <int dim>
  class ConvexPolytope
  {
  public:
    using Simplex = std::array<Point<dim>, dim + 1>;

    /** An empty one. */
    ConvexPolytope() = default;

    /** A cell with planar faces, from its vertices in deal.II's order:
     * triangle, quadrilateral; tetrahedron, hexahedron. */
    static ConvexPolytope from_cell(const std::vector<Point<dim>> &vertices);

    /** 2D: from corners in either direction. 3D: from the faces of a convex
     * body, corners counter-clockwise seen from outside. */
    explicit ConvexPolytope(const std::vector<Corners<dim>> &faces);

    bool empty() const
    {
      return polygons.empty();
    }

    /** 2D: the polygon itself, counter-clockwise; 3D: the faces. */
    const std::vector<Corners<dim>> &faces() const
    {
      return polygons;
    }

    double           volume() const; // 2D: area
    Point<dim>       centroid() const;
    BoundingBox<dim> box() const;

    void clip(const HalfSpace<dim> &half_space);

    /** Whether no corner is strictly inside of the half space. */
    bool is_outside(const HalfSpace<dim> &half_space) const;

    /** Those whose intersection it is. */
    std::vector<HalfSpace<dim>> half_spaces() const;

    /** Simplices that make it up, degenerate ones left out. */
    std::vector<Simplex> simplices() const;

  private:
    template <typename Function>
    void for_each_simplex(const Function &function) const;

    std::vector<Corners<dim>> polygons;
  };

  /** The part of @p polytope inside of all @p half_spaces. */
  template <int dim>
  ConvexPolytope<dim> intersect(ConvexPolytope<dim>                polytope,
                                const std::vector<HalfSpace<dim>> &half_spaces);

  /** Signed volume (2D: area). */
  template <int dim>
  double simplex_volume(const std::array<Point<dim>, dim + 1> &simplex);
} // namespace Impoint

#endif
