#ifndef impoint_solver_held_nodes_h
#define impoint_solver_held_nodes_h

#include <impoint/enforcement/conforming.h>
#include <impoint/solver/block_matrix.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <vector>

namespace Impoint
{
  /** Takes what conforming boundaries hold out of this rank's part of a matrix;
   * owners of nodes leave a diagonal. */
  template <int dim>
  void eliminate(const std::vector<Enforcement::HeldNode<dim>> &held,
                 const unsigned int                             n_owned_nodes,
                 const double                                   diagonal,
                 BlockMatrix<dim>                              &matrix);

  /** Takes what is held out of a vector, ghosts included, and puts the
   * prescribed values there if wanted. */
  template <int dim>
  void cut(const std::vector<Enforcement::HeldNode<dim>> &held,
           const bool                                     with_values,
           LinearAlgebra::distributed::Vector<double>    &vector);
} // namespace Impoint

#endif
