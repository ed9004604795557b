#ifndef impoint_grid_background_grid_tree_h
#define impoint_grid_background_grid_tree_h

#include <impoint/grid/background_grid.h>

#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/numerics/rtree.h>

namespace Impoint
{
  /** What places are looked up in. */
  template <int dim>
  struct BackgroundGrid<dim>::Tree
  {
    using Leaf = std::pair<BoundingBox<dim>, unsigned int>;
    RTree<Leaf> boxes;

    /** Of a lattice, unless it is mostly holes: the known cell at each place or
     * nowhere, the last direction running fastest. */
    std::vector<unsigned int> lattice;

    void list_lattice(const BackgroundGrid &grid);

    /** The known cell of the lattice at @p x, moved by nudge(); or nowhere. */
    unsigned int cell_on_lattice(const BackgroundGrid &grid,
                                 const Point<dim>     &x) const;

    /** By how little places on faces are moved before they are looked for:
     * several cells hold them. The direction is parallel to no face: the same
     * cell is chosen on every rank. */
    static Tensor<1, dim> nudge(const BackgroundGrid &grid);
  };
} // namespace Impoint

#endif
