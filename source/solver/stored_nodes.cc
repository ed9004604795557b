#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/stored_nodes.h>

#include <algorithm>
#include <limits>

namespace Impoint
{
  namespace
  {
    /** The cells of one rank, and the values at their nodes. */
    struct PackedNodes
    {
      StoredCells               cells;
      std::vector<unsigned int> n_nodes;
      std::vector<double>       values;

      void save_or_load(StateArchive &archive)
      {
        cells.save_or_load(archive);
        archive &n_nodes &values;
      }
    };
  } // namespace



  template <int dim>
  void store_nodes(const ActiveNodes<dim>                           &active,
                   const LinearAlgebra::distributed::Vector<double> &vector,
                   StateArchive                                     &archive)
  {
    PackedNodes packed;
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      {
        packed.cells.add(active.basis().grid(), active.cell(k));
        packed.n_nodes.push_back(active.nodes(k).size());
        for (const unsigned int i : active.nodes(k))
          for (unsigned int d = 0; d < dim; ++d)
            packed.values.push_back(vector.local_element(i * dim + d));
      }
    packed.save_or_load(archive);
  }



  template <int dim>
  void restore_nodes(StoredPieces                               &pieces,
                     const OwnCells                             &cells,
                     const ActiveNodes<dim>                     &active,
                     LinearAlgebra::distributed::Vector<double> &vector)
  {
    // A node's owner may have none of its cells. All who know a value know the
    // same one, so that it is the largest of all.
    vector.reinit(active.unknowns());
    for (unsigned int i = 0; i < active.n_nodes() * dim; ++i)
      vector.local_element(i) = std::numeric_limits<double>::lowest();
    on_all_ranks(active.basis().grid().communicator(), [&]() {
      pieces.for_each([&](StateArchive &archive) {
        PackedNodes packed;
        packed.save_or_load(archive);
        const double *value = packed.values.data();
        for (unsigned int i = 0; i < packed.n_nodes.size(); ++i)
          {
            const auto         found = packed.cells.find(i, cells);
            const unsigned int n     = packed.n_nodes[i] * dim;
            const unsigned int k     = found == cells.end() ?
                                         BackgroundGrid<dim>::nowhere :
                                         active.position(found->second);
            if (k != BackgroundGrid<dim>::nowhere)
              {
                const auto nodes = active.nodes(k);
                if (nodes.size() * dim != n)
                  throw StateArchive::does_not_fit(
                    "its cells have other nodes");
                for (unsigned int j = 0; j < n; ++j)
                  vector.local_element(nodes[j / dim] * dim + j % dim) =
                    value[j];
              }
            value += n;
          }
      });
    });
    vector.compress(VectorOperation::max);
    vector.update_ghost_values();
  }



  void
  take_layout(const std::shared_ptr<const Utilities::MPI::Partitioner> &layout,
              LinearAlgebra::distributed::Vector<double>               &vector)
  {
    if (vector.get_partitioner() == layout)
      return;
    LinearAlgebra::distributed::Vector<double> laid_out(layout);
    if (vector.size() > 0)
      {
        AssertDimension(laid_out.locally_owned_size(),
                        vector.locally_owned_size());
        std::copy(vector.begin(), vector.end(), laid_out.begin());
      }
    laid_out.update_ghost_values();
    vector.swap(laid_out);
  }

#define IMPOINT_INSTANTIATE(dim)                        \
  template void store_nodes(                            \
    const ActiveNodes<dim> &,                           \
    const LinearAlgebra::distributed::Vector<double> &, \
    StateArchive &);                                    \
  template void restore_nodes(StoredPieces &,           \
                              const OwnCells &,         \
                              const ActiveNodes<dim> &, \
                              LinearAlgebra::distributed::Vector<double> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
