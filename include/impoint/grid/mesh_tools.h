#ifndef impoint_grid_mesh_tools_h
#define impoint_grid_mesh_tools_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/grid/tria.h>

namespace Impoint
{
  using namespace dealii;

  struct MeshParameters;

  /** Scales about the origin, then rotates about it, then shifts. */
  template <int spacedim>
  struct Similarity
  {
    Similarity() = default;
    explicit Similarity(const MeshParameters &parameters);

    Point<spacedim>     point(const Point<spacedim> &x) const;
    Tensor<1, spacedim> vector(const Tensor<1, spacedim> &v) const;

    /** The point that comes to lie at @p x. */
    Point<spacedim> original(const Point<spacedim> &x) const;

    bool is_identity() const;

    double              scale    = 1;
    Tensor<2, spacedim> rotation = unit_tensor();
    Tensor<1, spacedim> shift;

  private:
    static Tensor<2, spacedim> unit_tensor();
  };

  /**
   * Moves @p mesh, which must not have been refined, and its curved manifolds
   * along, so that later refinement follows the moved shape.
   */
  template <int dim, int spacedim>
  void move_mesh(const Similarity<spacedim>   &motion,
                 Triangulation<dim, spacedim> &mesh);

  /**
   * Gives @p mesh transfinite manifolds of its own: a copied one still refers
   * to the coarse cells of the mesh it was copied from.
   */
  template <int dim, int spacedim>
  void renew_transfinite_manifolds(Triangulation<dim, spacedim> &mesh);

  /**
   * Two triangles a quadrilateral or six tetrahedra a hexahedron, without new
   * vertices, of the active cells of @p source. Every face is cut by the
   * diagonal through that of its vertices which comes first by the last
   * coordinate, then by the one before, so neighbours agree, and a box of equal
   * cells becomes the structured (Kuhn) mesh. Boundary and material ids stay.
   */
  template <int dim, int spacedim>
  void split_into_simplices(const Triangulation<dim, spacedim> &source,
                            Triangulation<dim, spacedim>       &target);
} // namespace Impoint

#endif
