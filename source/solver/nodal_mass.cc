#include <impoint/base/exceptions.h>
#include <impoint/solver/nodal_mass.h>

#include <cmath>

namespace Impoint
{
  namespace
  {
    using Vector = LinearAlgebra::distributed::Vector<double>;

    // Diagonal entries below this part of the largest are round-off.
    constexpr double smallest_mass = 1e-24;

    /** Calls function(N, nodes, mass) for this rank's points. */
    template <int dim, typename Function>
    void for_points(const ActiveNodes<dim>    &active,
                    const MaterialPoints<dim> &points,
                    const Function            &function)
    {
      for (unsigned int k = 0; k < active.n_material_cells(); ++k)
        for (unsigned int p = points.ranges()[k].begin;
             p < points.ranges()[k].end;
             ++p)
          function(points.support(p),
                   active.nodes(k),
                   points.data(p)[points.slots().mass]);
    }



    template <int dim>
    void multiply(const ActiveNodes<dim>    &active,
                  const MaterialPoints<dim> &points,
                  const Vector              &x,
                  Vector                    &result)
    {
      result.reinit(active.unknowns());
      for_points<dim>(
        active,
        points,
        [&](const double *N, const auto &nodes, const double mass) {
          Tensor<1, dim> momentum;
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              momentum[d] += mass * N[a] * x.local_element(nodes[a] * dim + d);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              result.local_element(nodes[a] * dim + d) += N[a] * momentum[d];
        });
      result.compress(VectorOperation::add);
    }



    /** Inverse of the diagonal; 0 where it is round-off. */
    template <int dim>
    Vector inverse_diagonal(const ActiveNodes<dim>    &active,
                            const MaterialPoints<dim> &points)
    {
      Vector diagonal(active.unknowns());
      for_points<dim>(
        active,
        points,
        [&](const double *N, const auto &nodes, const double mass) {
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              diagonal.local_element(nodes[a] * dim + d) += mass * N[a] * N[a];
        });
      diagonal.compress(VectorOperation::add);
      const double threshold = smallest_mass * diagonal.linfty_norm();
      for (double &entry : diagonal)
        entry = entry > threshold ? 1. / entry : 0.;
      return diagonal;
    }
  } // namespace



  template <int dim>
  void divide_by_consistent_mass(const ActiveNodes<dim>    &active,
                                 const MaterialPoints<dim> &points,
                                 const Vector              &first_guess,
                                 Vector                    &momenta)
  {
    constexpr double       tolerance      = 1e-14;
    constexpr unsigned int max_iterations = 10000;

    const Vector inverse = inverse_diagonal(active, points);
    Vector       residual(active.unknowns()), x(active.unknowns()), product;
    x.copy_locally_owned_data_from(first_guess);
    residual.copy_locally_owned_data_from(momenta);
    Vector scaled(residual);
    scaled.scale(inverse);
    const double enough = tolerance * tolerance * (residual * scaled);
    x.update_ghost_values();
    multiply(active, points, x, product);
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
        multiply(active, points, direction, product);
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

  template void divide_by_consistent_mass(const ActiveNodes<2> &,
                                          const MaterialPoints<2> &,
                                          const Vector &,
                                          Vector &);
  template void divide_by_consistent_mass(const ActiveNodes<3> &,
                                          const MaterialPoints<3> &,
                                          const Vector &,
                                          Vector &);
} // namespace Impoint
