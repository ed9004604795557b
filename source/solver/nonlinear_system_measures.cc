#include <impoint/solver/held_nodes.h>
#include <impoint/solver/nonlinear_system.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    // Forces below this part of E h^(dim-1) are none.
    constexpr double smallest_force = 1e-13;

    // Of one operation, with what sums of a few dozen terms make of it.
    constexpr double machine_precision = 1e-15;
  } // namespace



  template <int dim>
  bool NonlinearSystem<dim>::is_linear() const
  {
    bool linear = points.small_strain() && points.constant_tangent();
    for (const auto &method : methods)
      linear &= !method->is_active() || method->is_linear();
    return linear;
  }



  template <int dim>
  bool NonlinearSystem<dim>::is_augmented() const
  {
    bool augmented = false;
    for (const auto &method : methods)
      augmented |= method->is_active() && method->multiplier_updates() &&
                   method->multiplier_updates()->augmented();
    return Utilities::MPI::max(int(augmented),
                               active.basis().grid().communicator());
  }



  template <int dim>
  bool NonlinearSystem<dim>::is_stiff() const
  {
    constexpr double harmless = 3e5; // in units of E h^(dim-2)
    return Utilities::MPI::max(problem.matrix.largest_entry(),
                               active.basis().grid().communicator()) >
           harmless * force_scale_of_strain() /
             active.basis().grid().smallest_size();
  }



  template <int dim>
  bool NonlinearSystem<dim>::moderate_wanted() const
  {
    return problem.symmetric && solver.iterative(active, problem);
  }



  /** E h^(dim-1), in 2D times the thickness: the force of a strain of one. */
  template <int dim>
  double NonlinearSystem<dim>::force_scale_of_strain() const
  {
    const double h = active.basis().grid().smallest_size();
    return points.young() * points.carried().thickness *
           Utilities::fixed_power<dim - 1>(h);
  }



  template <int dim>
  double NonlinearSystem<dim>::force_scale() const
  {
    return std::max(scale, smallest_force * force_scale_of_strain());
  }



  template <int dim>
  double NonlinearSystem<dim>::strain_of_forces() const
  {
    return force_scale() / force_scale_of_strain();
  }



  template <int dim>
  double NonlinearSystem<dim>::smallest_displacement() const
  {
    return machine_precision * active.basis().grid().smallest_size();
  }



  template <int dim>
  double NonlinearSystem<dim>::round_off(const Vector &u) const
  {
    const double stiffest =
      Utilities::MPI::max(problem.matrix.largest_entry(),
                          active.basis().grid().communicator());
    const double strain_part =
      points.small_strain() ? 0. : force_scale_of_strain();
    return machine_precision * std::sqrt(double(u.size())) *
           (stiffest * u.linfty_norm() + strain_part) / force_scale();
  }



  /** [N], of the forces at the displacements @p u + @p delta. */
  template <int dim>
  double NonlinearSystem<dim>::round_off_of_forces(const Vector &u,
                                                   const Vector &delta) const
  {
    Vector place(u), forces(active.unknowns());
    place += delta;
    place.update_ghost_values();
    problem.matrix.absolute_vmult(place.begin(), forces.begin());
    forces.compress(VectorOperation::add);
    return machine_precision * forces.l2_norm();
  }



  template <int dim>
  bool NonlinearSystem<dim>::may_lose_digits(const Vector &u) const
  {
    constexpr double harmless = 1e-6;
    const double     loads =
      std::max(external.l2_norm(),
               inertia == nullptr ? 0. : assembly.inertia_norm(u));
    return round_off_of_forces(u, Vector(u.get_partitioner())) >
           harmless * loads;
  }



  template <int dim>
  double NonlinearSystem<dim>::linear_residual(const Vector &delta) const
  {
    // The matrix is without held unknowns; so is the residual.
    Vector product(active.unknowns());
    problem.matrix.vmult(delta.begin(), product.begin());
    product.compress(VectorOperation::add);
    product += rest;
    product += multiplier_forces;
    cut(held, false, product);
    return product.l2_norm() / force_scale();
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
