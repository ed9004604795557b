#include <impoint/solver/owned_rows.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace Impoint
{
  namespace
  {
    constexpr int row_tag = 4713;

    using Number = NodeExchange::Number;

    /** A row's number, how many columns it has, their numbers; and so on. */
    using Rows = std::vector<Number>;

    /** Calls @p action with the row and each of its columns. */
    template <typename Action>
    void for_entries(const Rows &rows, const Action &action)
    {
      for (std::size_t i = 0; i < rows.size(); i += 2 + rows[i + 1])
        for (std::size_t k = 0; k < rows[i + 1]; ++k)
          action(rows[i], rows[i + 2 + k]);
    }

    /** The rows of ghosts, by their owner. */
    std::map<unsigned int, Rows> rows_of_others(const BlockPattern &part,
                                                const NodeExchange &nodes)
    {
      const unsigned int           n_owned = part.n_rows() - nodes.n_ghosts();
      std::map<unsigned int, Rows> result;
      for (const auto &owner : nodes.owners())
        for (unsigned int i = n_owned + owner.begin; i < n_owned + owner.end;
             ++i)
          {
            Rows &rows = result[owner.rank];
            rows.push_back(nodes.global_number(i));
            rows.push_back(part.row_start[i + 1] - part.row_start[i]);
            for (std::size_t k = part.row_start[i]; k < part.row_start[i + 1];
                 ++k)
              rows.push_back(nodes.global_number(part.columns[k]));
          }
      return result;
    }

    using Entries = std::vector<std::pair<unsigned int, unsigned int>>;

    /** Of the entries of both; those of @p own are sorted. */
    BlockPattern
    pattern_of(const Entries &own, Entries others, const unsigned int n_rows)
    {
      std::sort(others.begin(), others.end());
      others.erase(std::unique(others.begin(), others.end()), others.end());
      Entries all;
      std::set_union(own.begin(),
                     own.end(),
                     others.begin(),
                     others.end(),
                     std::back_inserter(all));
      BlockPattern pattern;
      pattern.row_start.assign(n_rows + 1, 0);
      for (const auto &[row, column] : all)
        {
          ++pattern.row_start[row + 1];
          pattern.columns.push_back(column);
        }
      for (unsigned int row = 0; row < n_rows; ++row)
        pattern.row_start[row + 1] += pattern.row_start[row];
      return pattern;
    }

    std::size_t place_of(const BlockPattern &pattern,
                         const unsigned int  row,
                         const unsigned int  column)
    {
      const auto begin = pattern.columns.begin() + pattern.row_start[row];
      const auto end   = pattern.columns.begin() + pattern.row_start[row + 1];
      return std::lower_bound(begin, end, column) - pattern.columns.begin();
    }
  } // namespace



  template <int dim>
  void OwnedRows<dim>::new_pattern(const BlockPattern &part,
                                   const NodeExchange &part_nodes)
  {
    const unsigned int n_owned  = part.n_rows() - part_nodes.n_ghosts();
    const Number       first    = part_nodes.first_number();
    const auto         is_owned = [&](const Number number) {
      return number >= first && number < first + n_owned;
    };
    const auto messages =
      Utilities::MPI::some_to_some(part_nodes.communicator(),
                                   rows_of_others(part, part_nodes));
    std::vector<Number> ghosts;
    for (std::size_t k = 0; k < part.row_start[n_owned]; ++k)
      if (part.columns[k] >= n_owned)
        ghosts.push_back(part_nodes.global_number(part.columns[k]));
    for (const auto &message : messages)
      for_entries(message.second, [&](const Number, const Number column) {
        if (!is_owned(column))
          ghosts.push_back(column);
      });
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    row_nodes        = NodeExchange(part_nodes.communicator(), n_owned, ghosts);
    const auto local = [&](const Number number) -> unsigned int {
      return is_owned(number) ?
               number - first :
               n_owned +
                 (std::lower_bound(ghosts.begin(), ghosts.end(), number) -
                  ghosts.begin());
    };

    Entries own, of_others;
    for (unsigned int row = 0; row < n_owned; ++row)
      for (std::size_t k = part.row_start[row]; k < part.row_start[row + 1];
           ++k)
        own.emplace_back(row,
                         part.columns[k] < n_owned ?
                           part.columns[k] :
                           local(part_nodes.global_number(part.columns[k])));
    for (const auto &message : messages)
      for_entries(message.second, [&](const Number row, const Number column) {
        of_others.emplace_back(local(row), local(column));
      });
    row_pattern = pattern_of(own, of_others, n_owned);

    places.clear();
    for (const auto &entry : own)
      places.push_back(place_of(row_pattern, entry.first, entry.second));
    received.clear();
    for (const auto &message : messages)
      {
        received.push_back({message.first, {}});
        for_entries(message.second, [&](const Number row, const Number column) {
          received.back().places.push_back(
            place_of(row_pattern, local(row), local(column)));
        });
      }
    sent.clear();
    for (const auto &owner : part_nodes.owners())
      sent.push_back({owner.rank,
                      part.row_start[n_owned + owner.begin],
                      part.row_start[n_owned + owner.end]});
  }



  template <int dim>
  void OwnedRows<dim>::add_up(const BlockMatrix<dim> &part,
                              BlockMatrix<dim>       &rows) const
  {
    constexpr std::size_t            block = dim * dim;
    const MPI_Comm                   comm  = row_nodes.communicator();
    std::vector<MPI_Request>         requests;
    std::vector<std::vector<double>> values;
    for (const Received &it : received)
      {
        values.emplace_back(it.places.size() * block);
        requests.emplace_back();
        MPI_Irecv(values.back().data(),
                  values.back().size(),
                  MPI_DOUBLE,
                  it.rank,
                  row_tag,
                  comm,
                  &requests.back());
      }
    for (const Sent &it : sent)
      {
        requests.emplace_back();
        MPI_Isend(part.values.data() + it.begin * block,
                  (it.end - it.begin) * block,
                  MPI_DOUBLE,
                  it.rank,
                  row_tag,
                  comm,
                  &requests.back());
      }
    rows.reinit(row_pattern);
    const auto add = [&rows](const double *from, const std::size_t place) {
      for (std::size_t e = 0; e < block; ++e)
        rows.values[place * block + e] += from[e];
    };
    for (std::size_t k = 0; k < places.size(); ++k)
      add(&part.values[k * block], places[k]);
    const int status =
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(status);
    for (unsigned int k = 0; k < received.size(); ++k)
      for (std::size_t i = 0; i < received[k].places.size(); ++i)
        add(&values[k][i * block], received[k].places[i]);
  }

  template class OwnedRows<2>;
  template class OwnedRows<3>;
} // namespace Impoint
