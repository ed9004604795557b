#ifndef impoint_solver_stored_nodes_h
#define impoint_solver_stored_nodes_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/stored_particles.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /** Appends the values of @p vector at the nodes of this rank's active cells
   * to @p archive, ghosts up to date. */
  template <int dim>
  void store_nodes(const ActiveNodes<dim>                           &active,
                   const LinearAlgebra::distributed::Vector<double> &vector,
                   StateArchive                                     &archive);

  /** Reads what each rank stored of the same active cells, on any number of
   * ranks. Collective. */
  template <int dim>
  void restore_nodes(StoredPieces                               &pieces,
                     const OwnCells                             &cells,
                     const ActiveNodes<dim>                     &active,
                     LinearAlgebra::distributed::Vector<double> &vector);

  /** Gives @p vector, of the nodes of a kept grid or empty, the ghosts of
   * @p layout: the owned nodes stay, ghosts come and go with links. An empty
   * one becomes zero. Collective. */
  void
  take_layout(const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
              LinearAlgebra::distributed::Vector<double>               &vector);
} // namespace Impoint

#endif
