#include <impoint/grid/splines.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  template <int dim>
  Splines<dim>::Splines(const BackgroundGrid<dim> &grid,
                        const unsigned int         degree)
    : CellFunctions<dim>(grid)
    , degree(degree)
  {
    Assert(grid.lattice().exists, ExcInternalError());
    AssertIndexRange(degree, SplineLine::max_degree + 1);
    for (unsigned int d = 0; d < dim; ++d)
      lines.emplace_back(degree, grid.lattice().n_cells[d]);
    list_cell_nodes();
    place_nodes();
    find_owners();
  }



  template <int dim>
  types::global_dof_index
  Splines<dim>::index(const std::array<int, dim> &place) const
  {
    types::global_dof_index result = 0;
    for (unsigned int d = dim; d-- > 0;)
      result = result * lines[d].n_functions() + place[d];
    return result;
  }



  template <int dim>
  void Splines<dim>::list_cell_nodes()
  {
    const unsigned int n_in_cell = Utilities::fixed_power<dim>(degree + 1);
    auto              &lists     = this->node_lists;
    std::vector<types::global_dof_index> of_cells;
    cell_places.resize(this->grid.n_cells());
    lists.first_node.assign(1, 0);
    for (unsigned int c = 0; c < this->grid.n_cells(); ++c)
      {
        if (this->grid.is_known(c))
          {
            cell_places[c] = this->grid.lattice_place(c);
            for (unsigned int a = 0; a < n_in_cell; ++a)
              {
                std::array<int, dim> place = cell_places[c];
                for (unsigned int d = 0, rest = a; d < dim;
                     ++d, rest /= degree + 1)
                  place[d] += rest % (degree + 1);
                of_cells.push_back(index(place));
              }
          }
        lists.first_node.push_back(of_cells.size());
      }

    auto &indices = lists.global_indices;
    indices       = of_cells;
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    lists.cell_nodes.reserve(of_cells.size());
    for (const auto global_index : of_cells)
      lists.cell_nodes.push_back(lists.node_of(global_index));
  }



  template <int dim>
  void Splines<dim>::place_nodes()
  {
    auto       &lists   = this->node_lists;
    const auto &lattice = this->grid.lattice();
    for (auto rest : lists.global_indices)
      {
        std::array<int, dim> place;
        Tensor<1, dim>       steps;
        for (unsigned int d = 0; d < dim; ++d)
          {
            place[d] = rest % lines[d].n_functions();
            rest /= lines[d].n_functions();
            steps[d] = lattice.spacing[d] * lines[d].greville_place(place[d]);
          }
        lists.lattice.push_back(place);
        lists.points.push_back(lattice.origin + lattice.axes * steps);
      }
  }



  /**
   * A support reaches beyond the ghost cells, so no rank sees all who own a
   * part of it. The indices are shared out over the ranks, each of which keeps
   * book of the lowest rank that reports to own a cell of them.
   */
  template <int dim>
  void Splines<dim>::find_owners()
  {
    using Indices              = std::vector<types::global_dof_index>;
    auto              &lists   = this->node_lists;
    const MPI_Comm     comm    = this->grid.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    lists.owners.assign(lists.global_indices.size(), 0);
    if (n_ranks == 1)
      return;

    const auto keeper = [&](const types::global_dof_index global_index) {
      return static_cast<unsigned int>(global_index % n_ranks);
    };
    std::vector<char> has_own_cell(lists.global_indices.size(), false);
    for (unsigned int c = 0; c < this->grid.n_cells(); ++c)
      if (this->grid.is_owned(c))
        for (std::size_t q = lists.first_node[c]; q < lists.first_node[c + 1];
             ++q)
          has_own_cell[lists.cell_nodes[q]] = true;
    std::map<unsigned int, Indices> reports, questions;
    for (unsigned int node = 0; node < has_own_cell.size(); ++node)
      {
        const auto global_index = lists.global_indices[node];
        questions[keeper(global_index)].push_back(global_index);
        if (has_own_cell[node])
          reports[keeper(global_index)].push_back(global_index);
      }

    std::map<types::global_dof_index, unsigned int> lowest; // by index
    for (const auto &report : Utilities::MPI::some_to_some(comm, reports))
      for (const auto global_index : report.second)
        {
          const auto place = lowest.emplace(global_index, report.first).first;
          place->second    = std::min(place->second, report.first);
        }
    std::map<unsigned int, std::vector<unsigned int>> answers;
    for (const auto &asked : Utilities::MPI::some_to_some(comm, questions))
      for (const auto global_index : asked.second)
        answers[asked.first].push_back(lowest.at(global_index));
    for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
      for (unsigned int i = 0; i < answer.second.size(); ++i)
        lists.owners[lists.node_of(questions.at(answer.first)[i])] =
          answer.second[i];
  }



  template <int dim>
  void Splines<dim>::evaluate(const unsigned int c,
                              const Point<dim>  &xi,
                              double            *support) const
  {
    constexpr unsigned int most = SplineLine::max_degree + 1;
    double                 N[dim][most], dN[dim][most];
    for (unsigned int d = 0; d < dim; ++d)
      lines[d].evaluate(cell_places[c][d], xi[d], N[d], dN[d]);

    const Tensor<2, dim> &inverse     = this->grid.inverse_jacobian_of(c);
    const unsigned int    n           = this->node_lists.n_nodes_of(c);
    unsigned int          factor[dim] = {};
    for (unsigned int a = 0; a < n; ++a)
      {
        double value = 1, reference[dim];
        for (unsigned int e = 0; e < dim; ++e)
          {
            value *= N[e][factor[e]];
            reference[e] = dN[e][factor[e]];
            for (unsigned int d = 0; d < dim; ++d)
              if (d != e)
                reference[e] *= N[d][factor[d]];
          }
        support[a] = value;
        for (unsigned int d = 0; d < dim; ++d)
          {
            double sum = 0;
            for (unsigned int e = 0; e < dim; ++e)
              sum += inverse[e][d] * reference[e];
            support[n + a * dim + d] = sum;
          }
        for (unsigned int d = 0; d < dim && ++factor[d] > degree; ++d)
          factor[d] = 0;
      }
  }



  template <int dim>
  std::vector<unsigned int>
  Splines<dim>::nodes_on_face(const unsigned int c, const unsigned int f) const
  {
    const int                 outermost = f % 2 == 0 ? 0 : degree;
    const auto               &lists     = this->node_lists;
    std::vector<unsigned int> nodes;
    for (std::size_t q = lists.first_node[c]; q < lists.first_node[c + 1]; ++q)
      {
        const unsigned int node = lists.cell_nodes[q];
        if (lists.lattice[node][f / 2] == cell_places[c][f / 2] + outermost)
          nodes.push_back(node);
      }
    return nodes;
  }



  template <int dim>
  bool Splines<dim>::can_hold_face(const unsigned int c,
                                   const unsigned int f) const
  {
    return cell_places[c][f / 2] == (f % 2 == 0 ? 0 : lines[f / 2].n_cells - 1);
  }

  template class Splines<2>;
  template class Splines<3>;
} // namespace Impoint
