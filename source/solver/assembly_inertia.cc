// Inertia in the balance of forces: as a diagonal, or a matrix of the cells.

#include <impoint/solver/assembly.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  /** Whether inertia is the terms' to add, cell by cell. Where masses alone
   * hold what boundaries do not, a diagonal is enough, if there is one. */
  template <int dim>
  bool Assembly<dim>::has_mass_matrix(const Part part) const
  {
    return inertia != nullptr && inertia->consistent() &&
           (part != Part::constraints || !inertia->can_lump());
  }



  /** Those of group k that balance forces, at its cell_u. */
  template <int dim>
  void Assembly<dim>::accelerations_of(const unsigned int k)
  {
    const auto nodes = active.nodes(k);
    cell_accelerations.resize(nodes.size() * dim);
    for (unsigned int a = 0; a < nodes.size(); ++a)
      for (unsigned int d = 0; d < dim; ++d)
        cell_accelerations[a * dim + d] =
          inertia->balanced_acceleration(nodes[a] * dim + d,
                                         cell_u[a * dim + d]);
  }



  /** Norm of the inertia force, which balances all others in free flight; of
   * lumped masses, whichever the balance has. */
  template <int dim>
  double Assembly<dim>::inertia_norm(const Vector &u) const
  {
    double norm_square = 0;
    for (unsigned int i = 0; i < active.n_owned_nodes() * dim; ++i)
      {
        const double force =
          inertia->mass(i / dim) *
          inertia->balanced_acceleration(i, u.local_element(i));
        norm_square += force * force;
      }
    return std::sqrt(
      Utilities::MPI::sum(norm_square, active.basis().grid().communicator()));
  }



  /** Lumped mass: a diagonal that each node's owner adds. */
  template <int dim>
  void Assembly<dim>::add_inertia(const Vector &u, const bool tangent_wanted)
  {
    for (unsigned int i = 0; i < active.n_owned_nodes(); ++i)
      {
        const double mass = inertia->mass(i);
        for (unsigned int d = 0; d < dim; ++d)
          rest.local_element(i * dim + d) +=
            mass * inertia->balanced_acceleration(i * dim + d,
                                                  u.local_element(i * dim + d));
        if (tangent_wanted)
          {
            const auto row   = problem->pattern.columns.begin();
            const auto begin = row + problem->pattern.row_start[i];
            const auto end   = row + problem->pattern.row_start[i + 1];
            double    *block = problem->matrix.values.data() +
                            (std::lower_bound(begin, end, i) - row) * dim * dim;
            for (unsigned int d = 0; d < dim; ++d)
              block[d * dim + d] += inertia->alpha() * mass;
          }
      }
  }

  template class Assembly<2>;
  template class Assembly<3>;
} // namespace Impoint
