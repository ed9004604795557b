#include <impoint/particles/nearby_stiffness.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  NearbyStiffness<dim>::NearbyStiffness(const ActiveNodes<dim>    &active,
                                        const MaterialPoints<dim> &points)
    : active(active)
    , points(points)
  {}



  /** The first body's of that modulus. */
  template <int dim>
  const Materials::Material<dim> &
  NearbyStiffness<dim>::with_modulus(const double young) const
  {
    for (unsigned int body = 0; body < points.n_bodies(); ++body)
      if (points.material_of_body(body).young() == young)
        return points.material_of_body(body);
    return points.stiffest_material();
  }



  template <int dim>
  void NearbyStiffness<dim>::reinit()
  {
    materials.clear();
    if (points.equally_stiff())
      return;
    LinearAlgebra::distributed::Vector<double> nodes(active.scalars());
    std::vector<double>                        own(active.n_cells(), 0.);
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto &range = points.ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          own[k] = std::max(own[k], points.material(p).young());
        for (const unsigned int node : active.nodes(k))
          nodes.local_element(node) =
            std::max(nodes.local_element(node), own[k]);
      }
    nodes.compress(VectorOperation::max);
    nodes.update_ghost_values();
    materials.resize(active.n_cells());
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      {
        if (own[k] == 0.)
          for (const unsigned int node : active.nodes(k))
            own[k] = std::max(own[k], nodes.local_element(node));
        materials[k] = &with_modulus(own[k]);
      }
  }



  template <int dim>
  const Materials::Material<dim> &
  NearbyStiffness<dim>::material(const unsigned int c) const
  {
    const unsigned int k = active.position(c);
    return k < materials.size() ? *materials[k] : points.stiffest_material();
  }

  template <int dim>
  double NearbyStiffness<dim>::largest_young(
    const std::vector<typename PointCloud<dim>::Range> &ranges) const
  {
    double largest = 0;
    for (const auto &range : ranges)
      if (active.position(range.cell) != BackgroundGrid<dim>::nowhere)
        largest = std::max(largest, young(range.cell));
    largest =
      Utilities::MPI::max(largest, active.basis().grid().communicator());
    return largest > 0 ? largest : points.young();
  }

  template class NearbyStiffness<2>;
  template class NearbyStiffness<3>;
} // namespace Impoint
