#include <impoint/base/exceptions.h>
#include <impoint/solver/nodal_mass.h>

#include <cmath>

namespace Impoint
{
  namespace
  {
    // Diagonal entries below this part of the largest are round-off.
    constexpr double smallest_mass = 1e-24;
  } // namespace



  template <int dim>
  ConsistentNodalMass<dim>::ConsistentNodalMass(
    const ActiveNodes<dim>    &active,
    const MaterialPoints<dim> &points,
    const GhostPenalty<dim>   &ghost_penalty)
    : active(active)
    , points(points)
    , ghost_penalty(ghost_penalty)
  {}



  /** Calls function(N, nodes, mass) for this rank's points. */
  template <int dim>
  template <typename Function>
  void ConsistentNodalMass<dim>::for_points(const Function &function) const
  {
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      for (unsigned int p = points.ranges()[k].begin;
           p < points.ranges()[k].end;
           ++p)
        function(points.support(p),
                 active.nodes(k),
                 points.data(p)[points.slots().mass]);
  }



  /** @p x has its ghost values. */
  template <int dim>
  void ConsistentNodalMass<dim>::multiply(const Vector &x, Vector &result) const
  {
    result.reinit(active.unknowns());
    for_points([&](const double *N, const auto &nodes, const double mass) {
      Tensor<1, dim> momentum;
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          momentum[d] += mass * N[a] * x.local_element(nodes[a] * dim + d);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result.local_element(nodes[a] * dim + d) += N[a] * momentum[d];
    });
    ghost_penalty.for_masses(
      [&](const double *entries, const auto &nodes, const double density) {
        const unsigned int n = nodes.size();
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              result.local_element(nodes[a] * dim + d) +=
                density * entries[a * n + b] *
                x.local_element(nodes[b] * dim + d);
      });
    result.compress(VectorOperation::add);
  }



  /** 0 where the diagonal is round-off. */
  template <int dim>
  typename ConsistentNodalMass<dim>::Vector
  ConsistentNodalMass<dim>::inverse_diagonal() const
  {
    Vector     diagonal(active.unknowns());
    const auto add = [&](const unsigned int node, const double mass) {
      for (unsigned int d = 0; d < dim; ++d)
        diagonal.local_element(node * dim + d) += mass;
    };
    for_points([&](const double *N, const auto &nodes, const double mass) {
      for (unsigned int a = 0; a < nodes.size(); ++a)
        add(nodes[a], mass * N[a] * N[a]);
    });
    ghost_penalty.for_masses(
      [&](const double *entries, const auto &nodes, const double density) {
        for (unsigned int a = 0; a < nodes.size(); ++a)
          add(nodes[a], density * entries[a * nodes.size() + a]);
      });
    diagonal.compress(VectorOperation::add);
    const double threshold = smallest_mass * diagonal.linfty_norm();
    for (double &entry : diagonal)
      entry = entry > threshold ? 1. / entry : 0.;
    return diagonal;
  }



  template <int dim>
  void ConsistentNodalMass<dim>::divide(Vector       &momenta,
                                        const Vector &first_guess) const
  {
    constexpr double       tolerance      = 1e-14;
    constexpr unsigned int max_iterations = 10000;

    const Vector inverse = inverse_diagonal();
    Vector       residual(active.unknowns()), x(active.unknowns()), product;
    x.copy_locally_owned_data_from(first_guess);
    residual.copy_locally_owned_data_from(momenta);
    Vector scaled(residual);
    scaled.scale(inverse);
    const double enough = tolerance * tolerance * (residual * scaled);
    x.update_ghost_values();
    multiply(x, product);
    x.zero_out_ghost_values();
    residual -= product;
    scaled = residual;
    scaled.scale(inverse);
    Vector direction(scaled);
    double square = residual * scaled;
    for (unsigned int i = 0; square > enough; ++i)
      {
        if (i == max_iterations)
          throw StepFailed(
            "velocities projected to the nodes were not found in " +
            std::to_string(i) + " iterations");
        direction.update_ghost_values();
        multiply(direction, product);
        direction.zero_out_ghost_values();
        const double length = square / (direction * product);
        x.add(length, direction);
        residual.add(-length, product);
        scaled = residual;
        scaled.scale(inverse);
        const double next = residual * scaled;
        direction.sadd(next / square, scaled);
        square = next;
      }
    momenta = x;
    momenta.update_ghost_values();
  }

  template class ConsistentNodalMass<2>;
  template class ConsistentNodalMass<3>;
} // namespace Impoint
