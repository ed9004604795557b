#ifndef impoint_solver_gathered_factor_h
#define impoint_solver_gathered_factor_h

#include <impoint/solver/direct_solver.h>
#include <impoint/solver/node_exchange.h>

#include <optional>
#include <vector>

namespace Impoint
{
  /**
   * The Cholesky factor of a matrix that is spread by rows, made on rank 0: for
   * what is small beside the whole problem, as bands and the bottoms of
   * multigrid are. One process has its matrix there already.
   */
  template <int dim>
  class GatheredFactor : public Preconditioner
  {
  public:
    /** Rows of the nodes owned. All collective. */
    void new_pattern(const BlockPattern &pattern, const NodeExchange &nodes);

    /**
     * Factorises matrix + diag(ridge), with ridge per node owned (empty: zero).
     * Returns, on all ranks, the global number of the node whose pivot is not
     * positive, if any.
     */
    std::optional<NodeExchange::Number>
    factorize(const BlockMatrix<dim>    &matrix,
              const std::vector<double> &ridge = {});

    /** Of the rows here; and whether a global number is one of theirs. */
    NodeExchange::Number first_number() const
    {
      return nodes.first_number();
    }
    bool owns(const NodeExchange::Number number) const
    {
      return number >= first_number() && number < first_number() + n_owned;
    }

    /** x = A^-1 b, of the nodes owned. */
    void vmult(const std::vector<double> &b,
               std::vector<double>       &x) const override;

  private:
    bool         on_root() const;
    void         gather(const std::vector<double> &own,
                        const std::vector<int>    &counts,
                        std::vector<double>       &all) const;
    NodeExchange nodes;
    unsigned int n_owned = 0;

    DirectSolver<dim>        factor;
    std::vector<std::size_t> order; // of own blocks, rows by global columns
    BlockPattern             whole_pattern; // rank 0 of several
    BlockMatrix<dim>         whole;

    // rank 0: per rank, numbers of values
    std::vector<int>            node_counts, unknown_counts, matrix_counts;
    mutable std::vector<double> whole_right, whole_solution;
  };
} // namespace Impoint

#endif
