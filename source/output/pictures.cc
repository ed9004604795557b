#include <impoint/output/pictures.h>
#include <impoint/particles/smoothed_forces.h>

namespace Impoint
{
  template <int dim>
  Pictures<dim>::Pictures(const OutputFolder &folder)
    : points_writer(folder, "points")
    , boundary_writer(folder, "boundary")
    , grid_writer(folder, "grid")
  {}



  template <int dim>
  PointFields<dim>
  Pictures<dim>::material(const MaterialPoints<dim> &points) const
  {
    const auto      &slots   = points.slots();
    const bool       dynamic = points.carried().dynamic;
    PointFields<dim> result;
    NamedField       displacement{"displacement", dim, {}};
    NamedField       velocity{"velocity", dim, {}};
    NamedField       stress{"Cauchy stress", 6, {}};
    NamedField       J{"J", 1, {}};
    NamedField       body{"body", 1, {}}, id{"id", 1, {}};
    NamedField       plastic_strain{"plastic strain", 1, {}};
    const bool       plastic = points.carried().n_history > 0;
    const auto       put =
      [&](NamedField &field, const unsigned int p, const unsigned int slot) {
        const double *state = points.data(p) + slot;
        field.data.insert(field.data.end(), state, state + dim);
      };
    for (unsigned int p = 0; p < points.n(); ++p)
      {
        const double *state    = points.data(p);
        const double  jacobian = determinant(points.deformation_gradient(p));
        const double  divisor =
          points.material(p).small_strain() ? 1. : jacobian;
        result.positions.push_back(points.position(p));
        put(displacement, p, slots.u);
        if (dynamic)
          put(velocity, p, slots.v);
        // tensors are three-dimensional in pictures: xx yy zz xy xz yz
        std::array<double, 6> sigma = {};
        for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
          sigma[dim == 2 && k == 2 ? 3 : k] = state[slots.stress + k] / divisor;
        if (dim == 2)
          sigma[2] = state[slots.stress + Voigt<dim>::n] / divisor;
        stress.data.insert(stress.data.end(), sigma.begin(), sigma.end());
        J.data.push_back(jacobian);
        if (plastic)
          plastic_strain.data.push_back(
            points.material(p).plastic_strain(state + slots.history));
        body.data.push_back(points.body(p));
        id.data.push_back(points.id(p));
      }
    result.fields = {displacement, stress, J, body, id};
    if (dynamic)
      result.fields.push_back(velocity);
    if (plastic)
      result.fields.push_back(plastic_strain);
    return result;
  }



  template <int dim>
  PointFields<dim> Pictures<dim>::boundary(
    const std::vector<const BoundaryParticles<dim> *> &boundaries,
    const Basis<dim>                                  &basis) const
  {
    PointFields<dim> result;
    NamedField       force{"force", dim, {}}, gap{"gap", dim, {}};
    NamedField       normal{"normal", dim, {}};
    NamedField       traction{"traction", dim, {}};
    NamedField       smoothed{"smoothed force", dim, {}};
    NamedField       area{"area", 1, {}}, number{"boundary", 1, {}};
    for (unsigned int i = 0; i < boundaries.size(); ++i)
      {
        const auto &particles = *boundaries[i];
        const auto  forces    = smoothed_forces(particles, basis);
        for (unsigned int b = 0; b < particles.n(); ++b)
          {
            const auto   &slots = particles.slots();
            const double *state = particles.data(b);
            result.positions.push_back(particles.position(b));
            const auto put = [&](NamedField &field, const unsigned int slot) {
              field.data.insert(field.data.end(),
                                state + slot,
                                state + slot + dim);
            };
            put(force, slots.force);
            put(gap, slots.gap);
            put(normal, slots.normal);
            for (unsigned int d = 0; d < dim; ++d)
              {
                traction.data.push_back(state[slots.force + d] /
                                        particles.area(b));
                smoothed.data.push_back(forces[b][d]);
              }
            area.data.push_back(particles.area(b));
            number.data.push_back(i);
          }
      }
    result.fields = {force, smoothed, traction, gap, normal, area, number};
    return result;
  }



  template <int dim>
  GridFields<dim>
  Pictures<dim>::grid(const ActiveNodes<dim>                           &active,
                      const LinearAlgebra::distributed::Vector<double> &u) const
  {
    const auto     &basis = active.basis();
    GridFields<dim> result;
    result.simplices = basis.grid().simplicial();
    NamedField          displacement{"displacement of the step", dim, {}};
    NamedField          material{"with material", 1, {}};
    std::vector<double> support;
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      {
        const unsigned int c     = active.cell(k);
        const auto         nodes = active.nodes(k);
        support.resize(basis.support_size(c));
        material.data.push_back(k < active.n_material_cells());
        for (const Point<dim> &vertex : basis.grid().vertices(c))
          {
            result.vertices.push_back(vertex);
            basis.evaluate(c,
                           basis.grid().to_reference(c, vertex),
                           support.data());
            for (unsigned int d = 0; d < dim; ++d)
              {
                double value = 0;
                for (unsigned int a = 0; a < nodes.size() && u.size() > 0; ++a)
                  value += support[a] * u.local_element(nodes[a] * dim + d);
                displacement.data.push_back(value);
              }
          }
      }
    result.vertex_fields = {displacement};
    result.cell_fields   = {material};
    return result;
  }



  template <int dim>
  void Pictures<dim>::write(
    const double                                       time,
    const MaterialPoints<dim>                         &points,
    const std::vector<const BoundaryParticles<dim> *> &boundaries,
    const ActiveNodes<dim>                            &active,
    const LinearAlgebra::distributed::Vector<double>  &u)
  {
    points_writer.write(time, material(points));
    if (!boundaries.empty())
      boundary_writer.write(time, boundary(boundaries, active.basis()));
    if (u.size() > 0)
      grid_writer.write(time, grid(active, u));
  }

  template class Pictures<2>;
  template class Pictures<3>;
} // namespace Impoint
