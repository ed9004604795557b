#ifndef impoint_particles_nearby_stiffness_h
#define impoint_particles_nearby_stiffness_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/material_points.h>

#include <vector>

namespace Impoint
{
  /**
   * The stiffest material of each active cell: the scale of what holds it. A
   * cell without material has the stiffest of those that share nodes with it,
   * and where there is none, or all materials are alike, it is the stiffest of
   * the scene.
   */
  template <int dim>
  class NearbyStiffness
  {
  public:
    using Material = Materials::Material<dim>;

    NearbyStiffness(const ActiveNodes<dim>    &active,
                    const MaterialPoints<dim> &points);

    /** Looks where the points are now. Collective. */
    void reinit();

    /** Of cell @p c of the grid, which may have no part in the step. */
    const Material &material(const unsigned int c) const;

    /** Its Young's modulus [Pa]. */
    double young(const unsigned int c) const
    {
      return material(c).young();
    }

    /** Of all ranks' cells of @p ranges that are active. Collective. */
    double largest_young(
      const std::vector<typename PointCloud<dim>::Range> &ranges) const;

  private:
    const Material &with_modulus(const double young) const;

    const ActiveNodes<dim>       &active;
    const MaterialPoints<dim>    &points;
    std::vector<const Material *> materials; // of active cells
  };
} // namespace Impoint

#endif
