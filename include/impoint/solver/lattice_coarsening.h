#ifndef impoint_solver_lattice_coarsening_h
#define impoint_solver_lattice_coarsening_h

#include <impoint/grid/spline_line.h>
#include <impoint/solver/covering_lattice.h>
#include <impoint/solver/owned_rows.h>

#include <array>
#include <vector>

namespace Impoint
{
  /**
   * One step of coarsening on a lattice to cells of twice the size: each
   * function of the coarse lattice is a sum of fine ones (linear: 1/2 1 1/2;
   * splines: knot insertion, 1/4 3/4 3/4 1/4 and 1/8 4/8 6/8 4/8 1/8 but at the
   * ends). All coarse functions that a fine one is in exist. The places of all
   * products in P^T A P are found once, so that values are only streamed.
   *
   * Coarse nodes belong to the lowest rank that owns a fine node of theirs. A
   * rank makes the part of P^T A P of its fine rows; OwnedRows adds these up.
   */
  template <int dim>
  class LatticeCoarsening
  {
  public:
    using Lattice = std::vector<std::array<int, dim>>;

    /** @p lines: of the lattice, one a direction. All collective. */
    LatticeCoarsening(const BlockPattern            &pattern,
                      const NodeExchange            &nodes,
                      const Lattice                 &lattice,
                      const std::vector<SplineLine> &lines);

    /** From nodes without a lattice to one that covers them: what is coarse is
     * a sum of fine functions by its values at the nodes. */
    LatticeCoarsening(const BlockPattern         &pattern,
                      const NodeExchange         &nodes,
                      const CoveringLattice<dim> &lattice);

    /** coarse = P^T fine P. */
    void galerkin(const BlockMatrix<dim> &fine, BlockMatrix<dim> &coarse) const;

    /** coarse = P^T fine, of the nodes owned. */
    void restrict(const std::vector<double> &fine,
                  std::vector<double>       &coarse) const;

    /** fine += P coarse, of the nodes owned; what follows these in coarse is
     * of no use afterwards. */
    void prolongate(std::vector<double> &coarse,
                    std::vector<double> &fine) const;

    const BlockPattern            &pattern() const; // of the coarse matrix
    const NodeExchange            &nodes() const;   // of its rows and columns
    const Lattice                 &lattice() const; // of these
    const std::vector<SplineLine> &lines() const;   // of the coarse lattice

  private:
    /** The transpose of the lists of parents. */
    struct Children
    {
      std::vector<std::size_t>  start; // by coarse nodes
      std::vector<unsigned int> nodes;
      std::vector<std::size_t> links; // where the coarse node stands in parents
    };

    /** Of a node, along one of the lines: the first parent, how many follow
     * one another, their factors. */
    struct Parents
    {
      int    first, n;
      double factors[SplineLine::max_degree + 1];
    };

    /** Makes everything from what @p parents says of nodes and directions. */
    template <typename ParentsOf>
    void build(const BlockPattern &pattern,
               const NodeExchange &nodes,
               const ParentsOf    &parents_of);
    template <typename ParentsOf>
    void find_parents(const std::size_t n_nodes, const ParentsOf &parents_of);
    void share_parents(const MPI_Comm comm, const unsigned int n_owned);
    void own_rows();
    Children find_children() const;
    void multiply(const BlockMatrix<dim> &fine, BlockMatrix<dim> &part) const;
    void find_half_products(const BlockPattern &fine);
    void build_pattern(const Children &children);
    void find_targets(const Children &children);

    // the part of this rank
    NodeExchange     part_nodes;
    BlockPattern     part_pattern;
    BlockMatrix<dim> part;

    OwnedRows<dim>          rows; // of several ranks
    Lattice                 coarse_lattice;
    std::vector<SplineLine> coarse_lines;

    // P by fine nodes
    std::vector<std::size_t>  parent_start;
    std::vector<unsigned int> parents;
    std::vector<double>       weights;

    // A P by fine nodes; where each block of A goes in its row, parent by
    // parent; where each block of a row goes in P^T A P, parent by parent
    BlockPattern                half_product;
    std::vector<unsigned short> half_target;
    std::vector<unsigned int>   target;
  };
} // namespace Impoint

#endif
