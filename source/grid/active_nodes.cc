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
    , marks(basis.n_nodes())
    , positions(basis.grid().n_cells(), BackgroundGrid<dim>::nowhere)
    , compact_of(basis.n_nodes(), BackgroundGrid<dim>::nowhere)
  {}



  template <int dim>
  bool ActiveNodes<dim>::reinit(const std::vector<unsigned int> &material_cells,
                                const std::vector<unsigned int> &boundary_cells,
                                const std::function<Links()>    &find_links,
                                const Selection                 &select)
  {
    const MPI_Comm comm    = functions.grid().communicator();
    const auto     any_has = [&](const bool value) {
      return Utilities::MPI::max(int(value), comm) != 0;
    };
    if (any_has(fresh || material_cells != last_material ||
                boundary_cells != last_boundary))
      {
        last_material = material_cells;
        last_boundary = boundary_cells;
        find_neighbors();
      }
    const std::vector<unsigned int> new_cells =
      select ? select(neighbors) : neighbors;
    const bool changed = any_has(fresh || material_cells.size() != n_material ||
                                 !std::equal(cells.begin(),
                                             cells.begin() + n_material,
                                             material_cells.begin()) ||
                                 !std::equal(cells.begin() + n_material,
                                             cells.end(),
                                             new_cells.begin(),
                                             new_cells.end()));
    fresh              = false;
    if (changed)
      activate(new_cells);
    Links new_links;
    if (find_links)
      new_links = find_links();
    if (!any_has(changed || !(new_links == links)))
      return false;
    links = new_links;
    number();
    build_pattern();
    return true;
  }



  namespace
  {
    using Indices = std::vector<types::global_dof_index>;

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



  template <int dim>
  template <typename Cells>
  void ActiveNodes<dim>::mark_nodes_of(const Cells &of_cells)
  {
    for (const unsigned int c : of_cells)
      for (const unsigned int node : functions.nodes(c))
        marks.insert(node);
  }



  /** Marks those of the nodes @p wanted that any other rank has marked. */
  template <int dim>
  void ActiveNodes<dim>::share_marks(const std::vector<unsigned int> &wanted)
  {
    const MPI_Comm comm     = functions.grid().communicator();
    const auto     reported = Utilities::MPI::some_to_some(
      comm, by_foreign_owner(functions, marks.members()));
    for (const auto &message : reported)
      for (const auto index : message.second)
        marks.insert(functions.node_of(index));

    const auto questions = by_foreign_owner(functions, wanted);
    std::map<unsigned int, std::vector<char>> answers;
    for (const auto &message : Utilities::MPI::some_to_some(comm, questions))
      for (const auto index : message.second)
        answers[message.first].push_back(
          marks.contains(functions.node_of(index)));
    for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
      for (unsigned int i = 0; i < answer.second.size(); ++i)
        if (answer.second[i])
          marks.insert(functions.node_of(questions.at(answer.first)[i]));
  }



  template <int dim>
  void ActiveNodes<dim>::find_neighbors()
  {
    std::vector<unsigned int> without_material, wanted;
    std::set_difference(last_boundary.begin(),
                        last_boundary.end(),
                        last_material.begin(),
                        last_material.end(),
                        std::back_inserter(without_material));
    if (Utilities::MPI::n_mpi_processes(functions.grid().communicator()) > 1)
      {
        mark_nodes_of(without_material);
        wanted = marks.members();
        marks.clear();
        mark_nodes_of(last_material);
        share_marks(wanted);
      }
    else if (!without_material.empty())
      mark_nodes_of(last_material);
    neighbors.clear();
    for (const unsigned int c : without_material)
      {
        const auto nodes = functions.nodes(c);
        if (std::any_of(nodes.begin(),
                        nodes.end(),
                        [&](const unsigned int node) {
                          return marks.contains(node);
                        }))
          neighbors.push_back(c);
      }
    marks.clear();
  }



  /** The material cells, and @p without_material. */
  template <int dim>
  void
  ActiveNodes<dim>::activate(const std::vector<unsigned int> &without_material)
  {
    for (const unsigned int c : cells)
      positions[c] = BackgroundGrid<dim>::nowhere;
    cells      = last_material;
    n_material = cells.size();
    cells.insert(cells.end(), without_material.begin(), without_material.end());
    for (unsigned int k = 0; k < cells.size(); ++k)
      positions[cells[k]] = k;
  }



  template <int dim>
  void ActiveNodes<dim>::number()
  {
    const MPI_Comm     comm = functions.grid().communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);

    for (const unsigned int node : grid_nodes)
      compact_of[node] = BackgroundGrid<dim>::nowhere;
    mark_nodes_of(cells);
    for (unsigned int l = 0; l < links.size(); ++l)
      mark_nodes_of(links.cells(l));
    const std::vector<unsigned int> active = marks.members();
    const auto questions = by_foreign_owner(functions, active);
    std::map<unsigned int, Indices> asked;
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      asked = Utilities::MPI::some_to_some(comm, questions);
    for (const auto &question : asked)
      for (const auto index : question.second)
        marks.insert(functions.node_of(index));
    grid_nodes.clear();
    for (const unsigned int node : marks.members())
      if (functions.owner(node) == me)
        grid_nodes.push_back(node);
    marks.clear();
    n_owned = grid_nodes.size();

    const types::global_dof_index total =
      Utilities::MPI::sum(types::global_dof_index(n_owned), comm);
    const auto counts = Utilities::MPI::all_gather(comm, n_owned);
    const types::global_dof_index first =
      std::accumulate(counts.begin(),
                      counts.begin() + me,
                      types::global_dof_index(0));
    global_numbers.resize(n_owned);
    std::iota(global_numbers.begin(), global_numbers.end(), first);
    for (unsigned int i = 0; i < n_owned; ++i)
      compact_of[grid_nodes[i]] = i;

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
    for (const auto &ghost : ghosts)
      {
        compact_of[ghost.second] = grid_nodes.size();
        grid_nodes.push_back(ghost.second);
        global_numbers.push_back(ghost.first);
      }

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



  /** Appends the nodes of the links: of their first cell in its order, then
   * what the next have beside. */
  template <int dim>
  void ActiveNodes<dim>::list_nodes_of_links()
  {
    std::vector<unsigned int> last(n_nodes(), BackgroundGrid<dim>::nowhere);
    for (unsigned int l = 0; l < links.size(); ++l)
      {
        for (const unsigned int c : links.cells(l))
          for (const unsigned int node : functions.nodes(c))
            if (last[compact_of[node]] != l)
              {
                last[compact_of[node]] = l;
                cell_nodes.push_back(compact_of[node]);
              }
        first_node.push_back(cell_nodes.size());
      }
  }



  template <int dim>
  void ActiveNodes<dim>::list_groups_of_nodes()
  {
    first_node.assign(1, 0);
    cell_nodes.clear();
    for (const unsigned int c : cells)
      {
        for (const unsigned int node : functions.nodes(c))
          cell_nodes.push_back(compact_of[node]);
        first_node.push_back(cell_nodes.size());
      }
    if (links.size() > 0)
      list_nodes_of_links();

    first_block.assign(1, 0);
    for (unsigned int k = 0; k < n_groups(); ++k)
      first_block.push_back(first_block.back() +
                            nodes(k).size() * nodes(k).size());
    first_visit.assign(n_nodes() + 1, 0);
    for (const unsigned int node : cell_nodes)
      ++first_visit[node + 1];
    std::partial_sum(first_visit.begin(),
                     first_visit.end(),
                     first_visit.begin());
    visits.resize(cell_nodes.size());
    std::vector<std::size_t> next(first_visit.begin(), first_visit.end() - 1);
    for (unsigned int k = 0; k < n_groups(); ++k)
      for (unsigned int b = 0; b < nodes(k).size(); ++b)
        visits[next[nodes(k)[b]]++] = {k, b};
  }



  template <int dim>
  std::vector<unsigned int> ActiveNodes<dim>::places(const unsigned int k,
                                                     const unsigned int c) const
  {
    const auto                group = nodes(k);
    std::vector<unsigned int> result;
    for (const unsigned int node : functions.nodes(c))
      {
        const auto place =
          std::find(group.begin(), group.end(), compact_of[node]);
        Assert(place != group.end(), ExcInternalError());
        result.push_back(place - group.begin());
      }
    return result;
  }



  /** Goes over the columns in their order, so that those of each row come
   * sorted, and once before to count them: the pattern is symmetric. */
  template <int dim>
  void ActiveNodes<dim>::build_pattern()
  {
    list_groups_of_nodes();
    auto &row_start = block_pattern.row_start;
    auto &columns   = block_pattern.columns;
    row_start.assign(n_nodes() + 1, 0);
    std::vector<unsigned int> last(n_nodes(), BackgroundGrid<dim>::nowhere);
    for (unsigned int i = 0; i < n_nodes(); ++i)
      {
        last[i]            = i;
        std::size_t length = 1;
        for (std::size_t v = first_visit[i]; v < first_visit[i + 1]; ++v)
          for (const unsigned int j : nodes(visits[v].group))
            if (last[j] != i)
              {
                last[j] = i;
                ++length;
              }
        row_start[i + 1] = row_start[i] + length;
      }

    columns.resize(row_start.back());
    scatter_map.resize(first_block.back());
    std::vector<std::size_t>  next(row_start.begin(), row_start.end() - 1);
    std::vector<unsigned int> place(n_nodes());
    std::fill(last.begin(), last.end(), BackgroundGrid<dim>::nowhere);
    const auto couple = [&](const unsigned int i, const unsigned int j) {
      if (last[i] == j)
        return;
      last[i]           = j;
      place[i]          = next[i]++;
      columns[place[i]] = j;
    };
    for (unsigned int j = 0; j < n_nodes(); ++j)
      {
        couple(j, j);
        for (std::size_t v = first_visit[j]; v < first_visit[j + 1]; ++v)
          {
            const auto    group = nodes(visits[v].group);
            unsigned int *to =
              scatter_map.data() + first_block[visits[v].group];
            for (unsigned int a = 0; a < group.size(); ++a)
              {
                couple(group[a], j);
                to[a * group.size() + visits[v].node] = place[group[a]];
              }
          }
      }
  }

  template class ActiveNodes<2>;
  template class ActiveNodes<3>;
} // namespace Impoint
