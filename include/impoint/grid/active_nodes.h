#ifndef impoint_grid_active_nodes_h
#define impoint_grid_active_nodes_h

#include <impoint/base/block_pattern.h>
#include <impoint/grid/basis.h>
#include <impoint/grid/links.h>
#include <impoint/grid/node_set.h>

#include <deal.II/base/partitioner.h>

#include <functional>
#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * The nodes and cells that take part in a step, in a compact numbering, and
   * the pattern and scatter maps of matrices on them. Rebuilt only when the
   * set of active cells changes; costs nothing for the rest of the grid.
   *
   * Numbering of nodes on a rank: the ones it owns first, then ghosts by
   * their global number. Unknown d of node i is dim * i + d.
   *
   * Nodes couple in groups: those of each active cell, and those of each link.
   * A link is what reaches beyond a cell: the two cells at a face (ghost
   * penalty), or the cells whose boundary particles share a multiplier. Its
   * nodes are those of all its cells. One rank makes a link, of its own cells
   * and ghosts; let it be the lowest that owns one of them
   * (subdomain_id()), so that the links do not depend on the ranks.
   *
   * An Enforcement::Method acts on links by make_links(), which appends them,
   * and add_link(), which gets the displacements of a link's nodes and adds to
   * their residual and matrix. places() tells which of them a cell's nodes are:
   * the row of a multiplier that a link's cells share is the sum of N_a A_b / A
   * of all their particles, at the places of the nodes of each particle's cell.
   * Particles in ghost cells are other ranks': those send cell, supports,
   * areas and gaps, and want the multiplier back for their forces.
   */
  template <int dim>
  class ActiveNodes
  {
  public:
    /** Those that take part of cells without material, increasing. */
    using Selection = std::function<std::vector<unsigned int>(
      const std::vector<unsigned int> &)>;

    explicit ActiveNodes(const Basis<dim> &basis);

    /**
     * Makes active: @p material_cells and those of @p boundary_cells that
     * share a node with a material cell of any rank (both: own cells,
     * increasing, without duplicates; a cell may be in both); of the latter
     * only those that @p select returns. Then asks @p find_links, which may
     * look at position(). Both are called on all ranks.
     * Collective. Returns whether anything changed on any rank since the last
     * call.
     */
    bool reinit(const std::vector<unsigned int> &material_cells,
                const std::vector<unsigned int> &boundary_cells,
                const std::function<Links()>    &find_links = nullptr,
                const Selection                 &select     = nullptr);

    /** Active cells: the material cells in their order, then boundary cells
     * without material. */
    unsigned int n_cells() const
    {
      return cells.size();
    }
    unsigned int n_material_cells() const
    {
      return n_material;
    }
    unsigned int cell(const unsigned int k) const
    {
      return cells[k];
    }

    /** Place of the grid's cell @p c among the active ones, or nowhere. */
    unsigned int position(const unsigned int c) const
    {
      return positions[c];
    }

    /** Groups of nodes: the active cells, then the links. */
    unsigned int n_groups() const
    {
      return cells.size() + links.size();
    }
    unsigned int link(const unsigned int l) const
    {
      return cells.size() + l;
    }

    /** Compact nodes of active cell or link @p k. */
    ArrayView<const unsigned int> nodes(const unsigned int k) const
    {
      return ArrayView<const unsigned int>(cell_nodes.data() + first_node[k],
                                           first_node[k + 1] - first_node[k]);
    }

    unsigned int n_nodes() const
    {
      return grid_nodes.size();
    }
    unsigned int n_owned_nodes() const
    {
      return n_owned;
    }

    /** Number of the basis' node behind compact node @p i. */
    unsigned int grid_node(const unsigned int i) const
    {
      return grid_nodes[i];
    }

    /** Compact number of the basis' @p node, or nowhere. */
    unsigned int compact(const unsigned int node) const
    {
      return compact_of[node];
    }

    /** Number of compact node @p i among all ranks' active nodes. */
    types::global_dof_index global_number(const unsigned int i) const
    {
      return global_numbers[i];
    }

    /** Layout of distributed vectors of dim unknowns a node, and of one. */
    const std::shared_ptr<const Utilities::MPI::Partitioner> &unknowns() const
    {
      return unknown_partitioner;
    }
    const std::shared_ptr<const Utilities::MPI::Partitioner> &scalars() const
    {
      return node_partitioner;
    }

    /** Where the nodes of the grid's cell @p c stand among those of group @p k,
     * which has them all. */
    std::vector<unsigned int> places(const unsigned int k,
                                     const unsigned int c) const;

    /** Couplings of this rank's groups (rows of ghosts included). */
    const BlockPattern &pattern() const
    {
      return block_pattern;
    }

    /** For group @p k with n nodes: block (a, b) of its matrix goes to
     * block scatter(k)[a * n + b] of the pattern. */
    const unsigned int *scatter(const unsigned int k) const
    {
      return scatter_map.data() + first_block[k];
    }

    const Basis<dim> &basis() const
    {
      return functions;
    }

  private:
    /** A node in a group: the group and the node's place in it. */
    struct Visit
    {
      unsigned int group, node;
    };

    void find_neighbors();
    void activate(const std::vector<unsigned int> &without_material);
    void number();
    void list_groups_of_nodes();
    void list_nodes_of_links();
    void build_pattern();
    template <typename Cells>
    void mark_nodes_of(const Cells &of_cells);
    void share_marks(const std::vector<unsigned int> &wanted);

    const Basis<dim>         &functions;
    std::vector<unsigned int> last_material, last_boundary;
    std::vector<unsigned int> neighbors; // boundary cells without material
    bool                      fresh = true;
    NodeSet                   marks; // of the basis' nodes; empty between calls

    std::vector<unsigned int>            cells;
    Links                                links;
    unsigned int                         n_material = 0;
    std::vector<unsigned int>            positions;  // per cell of the grid
    std::vector<unsigned int>            compact_of; // per node of the basis
    std::vector<unsigned int>            grid_nodes;
    std::vector<types::global_dof_index> global_numbers;
    unsigned int                         n_owned = 0;
    std::vector<std::size_t>             first_node, first_block; // per group
    std::vector<unsigned int>            cell_nodes, scatter_map;
    std::vector<std::size_t>             first_visit; // per compact node
    std::vector<Visit>                   visits;
    BlockPattern                         block_pattern;
    std::shared_ptr<const Utilities::MPI::Partitioner> unknown_partitioner,
      node_partitioner;
  };
} // namespace Impoint

#endif
