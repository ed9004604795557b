#include <impoint/grid/active_nodes.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Impoint
{
  template <int dim>
  ActiveNodes<dim>::ActiveNodes(const Basis<dim> &basis)
    : functions(basis)
    , positions(basis.grid().n_cells(), BackgroundGrid<dim>::nowhere)
    , compact_of(basis.n_nodes(), BackgroundGrid<dim>::nowhere)
  {}



  template <int dim>
  bool ActiveNodes<dim>::reinit(const std::vector<unsigned int> &material_cells,
                                const std::vector<unsigned int> &boundary_cells)
  {
    const bool changed = fresh || material_cells != last_material ||
                         boundary_cells != last_boundary;
    if (!Utilities::MPI::max(int(changed), functions.grid().communicator()))
      return false;
    fresh         = false;
    last_material = material_cells;
    last_boundary = boundary_cells;
    activate(material_cells, boundary_cells);
    number();
    build_pattern();
    return true;
  }



  namespace
  {
    using Indices = std::vector<types::global_dof_index>;

    /** Nodes of cells, each once, increasing. */
    template <int dim>
    std::vector<unsigned int>
    nodes_of_cells(const Basis<dim>                &basis,
                   const std::vector<unsigned int> &cells)
    {
      std::vector<unsigned int> nodes;
      for (const unsigned int c : cells)
        for (const unsigned int node : basis.nodes(c))
          nodes.push_back(node);
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      return nodes;
    }

    /** Those of @p nodes that other ranks own, as global indices by rank. */
    template <int dim>
    std::map<unsigned int, Indices>
    by_foreign_owner(const Basis<dim>                &basis,
                     const std::vector<unsigned int> &nodes)
    {
      const unsigned int me =
        Utilities::MPI::this_mpi_process(basis.grid().communicator());
      std::map<unsigned int, Indices> indices;
      for (const unsigned int node : nodes)
        if (basis.owner(node) != me)
          indices[basis.owner(node)].push_back(basis.global_index(node));
      return indices;
    }
  } // namespace



  /** For each of the nodes @p wanted: whether any rank has it in @p marked. */
  template <int dim>
  std::vector<char>
  ActiveNodes<dim>::shared_marks(const std::vector<unsigned int> &marked,
                                 const std::vector<unsigned int> &wanted) const
  {
    const MPI_Comm    comm = functions.grid().communicator();
    std::vector<char> mark(functions.n_nodes(), false);
    for (const unsigned int node : marked)
      mark[node] = true;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      {
        const auto reported =
          Utilities::MPI::some_to_some(comm,
                                       by_foreign_owner(functions, marked));
        for (const auto &message : reported)
          for (const auto index : message.second)
            mark[functions.node_of(index)] = true;

        const auto questions = by_foreign_owner(functions, wanted);
        const auto asked     = Utilities::MPI::some_to_some(comm, questions);
        std::map<unsigned int, std::vector<char>> answers;
        for (const auto &message : asked)
          for (const auto index : message.second)
            answers[message.first].push_back(mark[functions.node_of(index)]);
        for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
          for (unsigned int i = 0; i < answer.second.size(); ++i)
            mark[functions.node_of(questions.at(answer.first)[i])] =
              answer.second[i];
      }
    std::vector<char> result;
    for (const unsigned int node : wanted)
      result.push_back(mark[node]);
    return result;
  }



  template <int dim>
  void
  ActiveNodes<dim>::activate(const std::vector<unsigned int> &material_cells,
                             const std::vector<unsigned int> &boundary_cells)
  {
    for (const unsigned int c : cells)
      positions[c] = BackgroundGrid<dim>::nowhere;
    for (const unsigned int node : grid_nodes)
      compact_of[node] = BackgroundGrid<dim>::nowhere;

    cells      = material_cells;
    n_material = cells.size();
    for (unsigned int k = 0; k < n_material; ++k)
      positions[cells[k]] = k;

    const auto material_nodes = nodes_of_cells(functions, material_cells);
    const auto wanted         = nodes_of_cells(functions, boundary_cells);
    const auto marks          = shared_marks(material_nodes, wanted);
    for (const unsigned int c : boundary_cells)
      if (positions[c] == BackgroundGrid<dim>::nowhere)
        for (const unsigned int node : functions.nodes(c))
          if (marks[std::lower_bound(wanted.begin(), wanted.end(), node) -
                    wanted.begin()])
            {
              positions[c] = cells.size();
              cells.push_back(c);
              break;
            }
  }



  template <int dim>
  void ActiveNodes<dim>::number()
  {
    const MPI_Comm     comm = functions.grid().communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);

    std::vector<unsigned int> active    = nodes_of_cells(functions, cells);
    const auto                questions = by_foreign_owner(functions, active);
    std::map<unsigned int, Indices> asked;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      asked = Utilities::MPI::some_to_some(comm, questions);

    std::vector<unsigned int> owned;
    for (const unsigned int node : active)
      if (functions.owner(node) == me)
        owned.push_back(node);
    for (const auto &question : asked)
      for (const auto index : question.second)
        owned.push_back(functions.node_of(index));
    std::sort(owned.begin(), owned.end());
    owned.erase(std::unique(owned.begin(), owned.end()), owned.end());
    n_owned = owned.size();

    const types::global_dof_index total =
      Utilities::MPI::sum(types::global_dof_index(n_owned), comm);
    const auto counts = Utilities::MPI::all_gather(comm, n_owned);
    const types::global_dof_index first =
      std::accumulate(counts.begin(),
                      counts.begin() + me,
                      types::global_dof_index(0));
    grid_nodes = owned;
    for (unsigned int i = 0; i < n_owned; ++i)
      compact_of[owned[i]] = i;

    std::map<unsigned int, Indices> answers;
    for (const auto &question : asked)
      for (const auto index : question.second)
        answers[question.first].push_back(first +
                                          compact_of[functions.node_of(index)]);
    std::vector<std::pair<types::global_dof_index, unsigned int>> ghosts;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
        for (unsigned int i = 0; i < answer.second.size(); ++i)
          ghosts.emplace_back(answer.second[i],
                              functions.node_of(questions.at(answer.first)[i]));
    std::sort(ghosts.begin(), ghosts.end());

    global_numbers.clear();
    for (unsigned int i = 0; i < n_owned; ++i)
      global_numbers.push_back(first + i);
    for (const auto &ghost : ghosts)
      {
        compact_of[ghost.second] = grid_nodes.size();
        grid_nodes.push_back(ghost.second);
        global_numbers.push_back(ghost.first);
      }

    with_material =
      shared_marks(nodes_of_cells(functions,
                                  {cells.begin(), cells.begin() + n_material}),
                   grid_nodes);

    for (const unsigned int block : {1, dim})
      {
        IndexSet own(total * block), ghost(total * block);
        own.add_range(first * block, (first + n_owned) * block);
        for (unsigned int i = n_owned; i < n_nodes(); ++i)
          ghost.add_range(global_numbers[i] * block,
                          (global_numbers[i] + 1) * block);
        (block == 1 ? node_partitioner : unknown_partitioner) =
          std::make_shared<const Utilities::MPI::Partitioner>(own, ghost, comm);
      }
  }



  template <int dim>
  void ActiveNodes<dim>::build_pattern()
  {
    first_node.assign(1, 0);
    first_block.assign(1, 0);
    cell_nodes.clear();
    std::vector<std::size_t> first_cell(n_nodes() + 1, 0); // of a node
    for (const unsigned int c : cells)
      {
        const unsigned int n = functions.n_nodes_of(c);
        for (const unsigned int node : functions.nodes(c))
          {
            cell_nodes.push_back(compact_of[node]);
            ++first_cell[compact_of[node] + 1];
          }
        first_node.push_back(cell_nodes.size());
        first_block.push_back(first_block.back() + n * n);
      }
    for (unsigned int i = 0; i < n_nodes(); ++i)
      first_cell[i + 1] += first_cell[i];
    std::vector<unsigned int> cells_of(cell_nodes.size());
    std::vector<std::size_t>  next(first_cell.begin(), first_cell.end() - 1);
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (const unsigned int i : nodes(k))
        cells_of[next[i]++] = k;

    // A row is finished before the next begins, so one marker array serves
    // both to find its columns and to place the blocks of its cells.
    auto &columns = block_pattern.columns;
    columns.clear();
    block_pattern.row_start.assign(1, 0);
    scatter_map.resize(first_block.back());
    std::vector<unsigned int> place(n_nodes(), BackgroundGrid<dim>::nowhere);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        const std::size_t begin = columns.size();
        place[i]                = 0;
        columns.push_back(i);
        for (std::size_t q = first_cell[i]; q < first_cell[i + 1]; ++q)
          for (const unsigned int j : nodes(cells_of[q]))
            if (place[j] == BackgroundGrid<dim>::nowhere)
              {
                place[j] = 0;
                columns.push_back(j);
              }
        std::sort(columns.begin() + begin, columns.end());
        for (std::size_t q = begin; q < columns.size(); ++q)
          place[columns[q]] = q;
        for (std::size_t q = first_cell[i]; q < first_cell[i + 1]; ++q)
          {
            const unsigned int k       = cells_of[q];
            const auto         in_cell = nodes(k);
            const unsigned int n       = in_cell.size();
            for (unsigned int a = 0; a < n; ++a)
              if (in_cell[a] == i)
                for (unsigned int b = 0; b < n; ++b)
                  scatter_map[first_block[k] + a * n + b] = place[in_cell[b]];
          }
        for (std::size_t q = begin; q < columns.size(); ++q)
          place[columns[q]] = BackgroundGrid<dim>::nowhere;
        block_pattern.row_start.push_back(columns.size());
      }
  }

  template class ActiveNodes<2>;
  template class ActiveNodes<3>;
} // namespace Impoint
