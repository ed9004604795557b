#include <impoint/base/on_all_ranks.h>
#include <impoint/solver/gathered_factor.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Impoint
{
  using namespace dealii;

  namespace
  {
    std::vector<int> starts(const std::vector<int> &counts)
    {
      std::vector<int> result(counts.size(), 0);
      for (unsigned int rank = 1; rank < counts.size(); ++rank)
        result[rank] = result[rank - 1] + counts[rank - 1];
      return result;
    }
  } // namespace



  template <int dim>
  bool GatheredFactor<dim>::on_root() const
  {
    return Utilities::MPI::this_mpi_process(nodes.communicator()) == 0;
  }



  template <int dim>
  void GatheredFactor<dim>::gather(const std::vector<double> &own,
                                   const std::vector<int>    &counts,
                                   std::vector<double>       &all) const
  {
    all.resize(std::accumulate(counts.begin(), counts.end(), std::size_t(0)));
    MPI_Gatherv(own.data(),
                own.size(),
                MPI_DOUBLE,
                all.data(),
                counts.data(),
                starts(counts).data(),
                MPI_DOUBLE,
                0,
                nodes.communicator());
  }



  template <int dim>
  void GatheredFactor<dim>::new_pattern(const BlockPattern &pattern,
                                        const NodeExchange &new_nodes)
  {
    nodes   = new_nodes;
    n_owned = pattern.n_rows();
    if (nodes.alone())
      return factor.new_pattern(pattern);

    order.resize(pattern.columns.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<NodeExchange::Number> columns;
    std::vector<unsigned int>         lengths;
    for (const unsigned int column : pattern.columns)
      columns.push_back(nodes.global_number(column));
    for (unsigned int row = 0; row < n_owned; ++row)
      {
        std::sort(order.begin() + pattern.row_start[row],
                  order.begin() + pattern.row_start[row + 1],
                  [&](const std::size_t k, const std::size_t l) {
                    return columns[k] < columns[l];
                  });
        std::sort(columns.begin() + pattern.row_start[row],
                  columns.begin() + pattern.row_start[row + 1]);
        lengths.push_back(pattern.row_start[row + 1] - pattern.row_start[row]);
      }
    const MPI_Comm comm        = nodes.communicator();
    const auto     all_lengths = Utilities::MPI::gather(comm, lengths, 0);
    const auto     all_columns = Utilities::MPI::gather(comm, columns, 0);
    whole_pattern              = BlockPattern{{0}, {}};
    node_counts.clear();
    unknown_counts.clear();
    matrix_counts.clear();
    for (unsigned int rank = 0; rank < all_lengths.size(); ++rank)
      {
        node_counts.push_back(all_lengths[rank].size());
        unknown_counts.push_back(all_lengths[rank].size() * dim);
        matrix_counts.push_back(all_columns[rank].size() * dim * dim);
        for (const unsigned int length : all_lengths[rank])
          whole_pattern.row_start.push_back(whole_pattern.row_start.back() +
                                            length);
        whole_pattern.columns.insert(whole_pattern.columns.end(),
                                     all_columns[rank].begin(),
                                     all_columns[rank].end());
      }
    Impoint::on_root(comm, [&]() { factor.new_pattern(whole_pattern); });
  }



  template <int dim>
  std::optional<NodeExchange::Number>
  GatheredFactor<dim>::factorize(const BlockMatrix<dim>    &matrix,
                                 const std::vector<double> &ridge)
  {
    if (nodes.alone())
      return factor.factorize(matrix, ridge);

    constexpr std::size_t block = dim * dim;
    std::vector<double>   values, own_ridge = ridge, whole_ridge;
    for (const std::size_t k : order)
      values.insert(values.end(),
                    matrix.values.begin() + k * block,
                    matrix.values.begin() + (k + 1) * block);
    own_ridge.resize(n_owned);
    whole.pattern = &whole_pattern;
    gather(values, matrix_counts, whole.values);
    gather(own_ridge, node_counts, whole_ridge);
    int failed = -1;
    Impoint::on_root(nodes.communicator(), [&]() {
      if (const auto node = factor.factorize(whole, whole_ridge))
        failed = *node;
    });
    whole.values.clear();
    whole.values.shrink_to_fit();
    failed = Utilities::MPI::broadcast(nodes.communicator(), failed);
    if (failed < 0)
      return {};
    return failed;
  }



  template <int dim>
  void GatheredFactor<dim>::vmult(const std::vector<double> &b,
                                  std::vector<double>       &x) const
  {
    if (nodes.alone())
      return factor.vmult(b, x);

    const std::vector<double> own(b.begin(), b.begin() + n_owned * dim);
    gather(own, unknown_counts, whole_right);
    if (on_root())
      factor.vmult(whole_right, whole_solution);
    x.resize(std::max<std::size_t>(x.size(), n_owned * dim));
    MPI_Scatterv(whole_solution.data(),
                 unknown_counts.data(),
                 starts(unknown_counts).data(),
                 MPI_DOUBLE,
                 x.data(),
                 n_owned * dim,
                 MPI_DOUBLE,
                 0,
                 nodes.communicator());
  }

  template class GatheredFactor<2>;
  template class GatheredFactor<3>;
} // namespace Impoint
