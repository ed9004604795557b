#include <impoint/grid/support_size.h>
#include <impoint/solver/inertia.h>
#include <impoint/solver/nodal_mass.h>
#include <impoint/solver/stored_nodes.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    /** Turns values N of functions that may be negative into positive weights
     * that sum to one: N_I^2 / sum_J N_J^2 (the diagonal of the consistent
     * mass, scaled: E. Hinton, T. Rock, O. Zienkiewicz, A note on mass lumping
     * and related processes in the finite element method, Earthq. Eng. Struct.
     * Dyn. 4, 1976). */
    void mean_weights(const double *N, const unsigned int n, double *weights)
    {
      double sum = 0;
      for (unsigned int a = 0; a < n; ++a)
        sum += weights[a] = N[a] * N[a];
      for (unsigned int a = 0; a < n; ++a)
        weights[a] /= sum;
    }
  } // namespace



  // Bossak's b = (rho - 1)/(rho + 1), with the beta and gamma that make the
  // scheme stable and of second order (W. Wood, M. Bossak, O. Zienkiewicz, An
  // alpha modification of Newmark's method, Int. J. Numer. Meth. Eng. 15,
  // 1980).
  template <int dim>
  Inertia<dim>::Inertia(const TimeParameters &parameters)
    : beta(parameters.beta)
    , gamma(parameters.gamma)
    , bossak((parameters.spectral_radius - 1) /
             (parameters.spectral_radius + 1))
    , filter(parameters.filter)
    , filter_at_rest(parameters.filter_at_rest)
    , is_consistent(parameters.mass == MassMatrix::consistent)
    , projects_consistently(parameters.consistent_projection)
  {
    if (bossak < 0)
      {
        gamma = 0.5 - bossak;
        beta  = 0.25 * (1 - bossak) * (1 - bossak);
      }
  }



  template <int dim>
  double Inertia<dim>::filtered_part() const
  {
    return filter > 0 ? -std::expm1(-dt / (at_rest ? filter_at_rest : filter)) :
                        0.;
  }



  template <int dim>
  void Inertia<dim>::look_for_rest(const ActiveNodes<dim>    &active,
                                   const MaterialPoints<dim> &points)
  {
    constexpr double rest   = 1e-4; // of the largest energy
    double           energy = 0;
    for (unsigned int p = 0; p < points.n(); ++p)
      energy += 0.5 * points.data(p)[points.slots().mass] *
                points.vector(p, points.slots().v).norm_square();
    energy  = Utilities::MPI::sum(energy, active.basis().grid().communicator());
    largest = std::max(largest, energy);
    at_rest = energy < rest * largest;
  }



  /** Momenta to velocities. A node whose mass is round-off gets none rather
   * than a quotient. */
  template <int dim>
  void Inertia<dim>::divide_by_mass(Vector &momenta) const
  {
    constexpr double smallest_mass = 1e-12;
    const double     threshold     = smallest_mass * masses.linfty_norm();
    momenta.update_ghost_values();
    const unsigned int n_nodes =
      masses.locally_owned_size() + masses.get_partitioner()->n_ghost_indices();
    for (unsigned int i = 0; i < n_nodes; ++i)
      {
        const double mass    = masses.local_element(i);
        const double inverse = mass > threshold ? 1. / mass : 0.;
        for (unsigned int d = 0; d < dim; ++d)
          momenta.local_element(i * dim + d) *= inverse;
      }
  }



  /** Sums of one cell's points: mass, then momentum, then inertia force. */
  template <int dim>
  template <int n_static>
  void Inertia<dim>::project_cell(const MaterialPoints<dim>             &points,
                                  const typename PointCloud<dim>::Range &range,
                                  const ArrayView<const unsigned int>    nodes)
  {
    const unsigned int     n      = n_static > 0 ? n_static : nodes.size();
    const auto            &slots  = points.slots();
    constexpr unsigned int n_sums = 2 * dim + 1;
    double                 sums[array_size<n_static> * n_sums];
    std::fill(sums, sums + n * n_sums, 0.);
    double weights[array_size<n_static>];
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        points.prefetch_after(p);
        const double *N     = points.support(p);
        const double *state = points.data(p);
        double        moving[n_sums];
        moving[0] = state[slots.mass];
        // the least squares' fit asks for moments with the functions themselves
        const double *of_mass = N;
        if (weighted)
          {
            mean_weights(N, n, weights);
            of_mass = weights;
            N       = projects_consistently ? N : weights;
          }
        for (unsigned int d = 0; d < dim; ++d)
          {
            moving[1 + d]       = moving[0] * state[slots.v + d];
            moving[1 + dim + d] = moving[0] * state[slots.a + d];
          }
#pragma GCC unroll 1 // for vector instructions
        for (unsigned int a = 0; a < n; ++a)
          sums[a] += of_mass[a] * moving[0];
        for (unsigned int s = 1; s < n_sums; ++s)
#pragma GCC unroll 1
          for (unsigned int a = 0; a < n; ++a)
            sums[s * n + a] += N[a] * moving[s];
      }
    for (unsigned int a = 0; a < n; ++a)
      {
        const unsigned int i = nodes[a];
        masses.local_element(i) += sums[a];
        for (unsigned int d = 0; d < dim; ++d)
          {
            velocities.local_element(i * dim + d) += sums[(1 + d) * n + a];
            accelerations.local_element(i * dim + d) +=
              sums[(1 + dim + d) * n + a];
          }
      }
  }



  template <int dim>
  void Inertia<dim>::project(const ActiveNodes<dim>    &active,
                             const MaterialPoints<dim> &points,
                             const GhostPenalty<dim>   &ghost_penalty,
                             const double               time_step)
  {
    dt       = time_step;
    weighted = !active.basis().is_positive();
    masses.reinit(active.scalars());
    velocities.reinit(active.unknowns());
    accelerations.reinit(active.unknowns());
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      with_support_size<dim>(active.nodes(k).size(), [&](const auto n_static) {
        project_cell<n_static>(points, points.ranges()[k], active.nodes(k));
      });
    for (Vector *vector : {&masses, &velocities, &accelerations})
      vector->compress(VectorOperation::add);
    masses.update_ghost_values();
    for (Vector *vector : {&velocities, &accelerations})
      {
        Vector means(*vector);
        divide_by_mass(means);
        if (projects_consistently)
          ConsistentNodalMass<dim>(active, points, ghost_penalty)
            .divide(*vector, means);
        else
          vector->swap(means);
      }
    if (filter > 0)
      find_seen_velocities(active, points);
    if (filter_at_rest > 0)
      look_for_rest(active, points);
  }



  template <int dim>
  bool Inertia<dim>::begin_step(const ActiveNodes<dim>    &active,
                                const MaterialPoints<dim> &points,
                                const GhostPenalty<dim>   &ghost_penalty,
                                const double               time_step)
  {
    dt = time_step;
    if (has_carried)
      {
        take_layout(active.unknowns(), velocities);
        take_layout(active.unknowns(), accelerations);
        take_layout(active.scalars(), masses);
        return false;
      }
    project(active, points, ghost_penalty, time_step);
    return true;
  }



  template <int dim>
  void Inertia<dim>::end_step(const Vector &u)
  {
    const unsigned int n =
      u.locally_owned_size() + u.get_partitioner()->n_ghost_indices();
    for (unsigned int i = 0; i < n; ++i)
      {
        const double a_new = acceleration(i, u.local_element(i));
        velocities.local_element(i) =
          new_velocity(velocities.local_element(i),
                       accelerations.local_element(i),
                       a_new);
        accelerations.local_element(i) = a_new;
      }
    has_carried = true;
  }



  /**
   * With S the projection to the nodes and P the interpolation to the points,
   * (1 - P S) v is what the grid doesn't see of v, but also the error of lumped
   * masses for what it does. That is smaller in (1 - P S)^2 v = v - P (S v + S
   * (v - P S v)), which is still all of the unseen part (the idea of XPIC: C.
   * Hammerquist, J. Nairn, A new method for material point method particle
   * updates that reduces noise and enhances stability, Comput. Methods Appl.
   * Mech. Eng. 318, 2017).
   */
  template <int dim>
  void Inertia<dim>::find_seen_velocities(const ActiveNodes<dim>    &active,
                                          const MaterialPoints<dim> &points)
  {
    const auto &slots = points.slots();
    seen_velocities.reinit(active.unknowns());
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points.ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            const double *N = points.support(p);
            for (unsigned int d = 0; d < dim; ++d)
              {
                double unseen = points.data(p)[slots.v + d];
                for (unsigned int a = 0; a < nodes.size(); ++a)
                  unseen -= N[a] * velocities.local_element(nodes[a] * dim + d);
                for (unsigned int a = 0; a < nodes.size(); ++a)
                  seen_velocities.local_element(nodes[a] * dim + d) +=
                    N[a] * points.data(p)[slots.mass] * unseen;
              }
          }
      }
    seen_velocities.compress(VectorOperation::add);
    divide_by_mass(seen_velocities);
    for (unsigned int i = 0; i < active.n_nodes() * dim; ++i)
      seen_velocities.local_element(i) += velocities.local_element(i);
  }

  template class Inertia<2>;
  template class Inertia<3>;
} // namespace Impoint
