#ifndef impoint_tests_solver_split_problem_h
#define impoint_tests_solver_split_problem_h

#include <impoint/solver/distributed_problem.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "model_problem.h"

namespace ModelProblem
{
  /**
   * A problem in parts whose sum it is, as an assembly on several ranks leaves
   * them: each rank owns a slab of nodes, with neighbours as ghosts, and the
   * entries between ranks are in both their parts.
   */
  template <int dim>
  class SplitProblem
  {
  public:
    /** All ranks have @p whole; the last @p n_idle of several own no node. */
    SplitProblem(const LinearProblem<dim> &whole, const unsigned int n_idle = 0)
      : comm(MPI_COMM_WORLD)
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
      const unsigned int n_parts = n_ranks > n_idle ? n_ranks - n_idle : 1;
      for (unsigned int rank = 0; rank <= n_ranks; ++rank)
        firsts.push_back(std::size_t(whole.pattern.n_rows()) *
                         std::min(rank, n_parts) / n_parts);
      me = Utilities::MPI::this_mpi_process(comm);
      find_nodes(whole.pattern);
      copy_pattern(whole.pattern);
      part.lines = whole.lines;
      for (const unsigned int number : nodes)
        {
          part.points.push_back(whole.points[number]);
          if (!whole.lines.empty())
            part.lattice.push_back(whole.lattice[number]);
          part.enforced.push_back(whole.enforced[number]);
        }
    }

    /** Takes the values of @p whole. */
    void copy(const LinearProblem<dim> &whole)
    {
      part.has_moderate = whole.has_moderate;
      copy(whole.matrix, part.matrix);
      if (whole.has_moderate)
        copy(whole.moderate, part.moderate);
    }

    /** Of a vector, the unknowns owned; and all of them, by ranks. */
    std::vector<double> own(const std::vector<double> &all) const
    {
      return {all.begin() + firsts[me] * dim,
              all.begin() + firsts[me + 1] * dim};
    }
    std::vector<double> all(const std::vector<double> &own) const
    {
      std::vector<double> result;
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, own))
        result.insert(result.end(), of_rank.begin(), of_rank.end());
      return result;
    }

    NodeExchange exchange() const
    {
      return NodeExchange(comm,
                          n_owned(),
                          {nodes.begin() + n_owned(), nodes.end()});
    }

    LinearProblem<dim> part;

  private:
    bool owns(const unsigned int number) const
    {
      return number >= firsts[me] && number < firsts[me + 1];
    }
    unsigned int n_owned() const
    {
      return firsts[me + 1] - firsts[me];
    }

    void find_nodes(const BlockPattern &whole)
    {
      std::set<unsigned int> ghosts;
      for (unsigned int row = firsts[me]; row < firsts[me + 1]; ++row)
        {
          nodes.push_back(row);
          for (std::size_t k = whole.row_start[row];
               k < whole.row_start[row + 1];
               ++k)
            if (!owns(whole.columns[k]))
              ghosts.insert(whole.columns[k]);
        }
      nodes.insert(nodes.end(), ghosts.begin(), ghosts.end());
    }

    void copy_pattern(const BlockPattern &whole)
    {
      part.pattern.row_start.assign(1, 0);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        {
          std::map<unsigned int, std::size_t> row; // local columns
          for (std::size_t k = whole.row_start[nodes[i]];
               k < whole.row_start[nodes[i] + 1];
               ++k)
            {
              const unsigned int column = whole.columns[k];
              if (owns(nodes[i]) || owns(column) || column == nodes[i])
                row[owns(column) ? column - firsts[me] :
                                   std::lower_bound(nodes.begin() + n_owned(),
                                                    nodes.end(),
                                                    column) -
                                     nodes.begin()] = k;
            }
          for (const auto &[column, k] : row)
            {
              part.pattern.columns.push_back(column);
              source.push_back(k);
              weights.push_back(i < n_owned() ?
                                  (column < n_owned() ? 1. : 0.75) :
                                  (column < n_owned() ? 0.25 : 0.));
            }
          part.pattern.row_start.push_back(part.pattern.columns.size());
        }
    }

    void copy(const BlockMatrix<dim> &from, BlockMatrix<dim> &to) const
    {
      to.reinit(part.pattern);
      for (std::size_t k = 0; k < source.size(); ++k)
        for (unsigned int e = 0; e < dim * dim; ++e)
          to.values[k * dim * dim + e] =
            weights[k] * from.values[source[k] * dim * dim + e];
    }

    const MPI_Comm            comm;
    unsigned int              me;
    std::vector<unsigned int> firsts; // node of each rank
    std::vector<unsigned int> nodes;  // here, by their numbers in the whole
    std::vector<std::size_t>  source; // of blocks
    std::vector<double>       weights;
  };
} // namespace ModelProblem

#endif
