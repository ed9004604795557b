#include <impoint/grid/hinges.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/cell_id.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <unordered_map>

namespace Impoint
{
  namespace
  {
    constexpr auto empty = std::numeric_limits<std::uint64_t>::max();
  }



  template <int dim>
  Hinges<dim>::Hinges(const BackgroundGrid<dim> &grid)
    : grid(grid)
    , places(grid.n_cells(), BackgroundGrid<dim>::nowhere)
  {}



  template <int dim>
  const std::vector<unsigned int> &
  Hinges<dim>::cells_between(const std::vector<unsigned int> &material_cells)
  {
    const bool changed = fresh || material_cells != material;
    fresh              = false;
    if (Utilities::MPI::max(int(changed), grid.communicator()) == 0)
      return between;
    material = material_cells;
    label_pieces();
    find_cells_between();
    for (const unsigned int c : cells)
      places[c] = BackgroundGrid<dim>::nowhere;
    cells.clear();
    labels.clear();
    return between;
  }



  template <int dim>
  void Hinges<dim>::label_pieces()
  {
    const MPI_Comm comm  = grid.communicator();
    const bool     alone = Utilities::MPI::n_mpi_processes(comm) == 1;
    const Label    me    = Utilities::MPI::this_mpi_process(comm);
    for (const unsigned int c : material)
      label(c, me << 32 | c);
    if (alone)
      {
        spread();
        return;
      }
    bool changes = true;
    while (changes)
      {
        exchange();
        changes = Utilities::MPI::max(int(spread()), comm) != 0;
      }
  }



  template <int dim>
  void Hinges<dim>::label(const unsigned int c, const Label value)
  {
    if (places[c] == BackgroundGrid<dim>::nowhere)
      {
        places[c] = cells.size();
        cells.push_back(c);
        labels.push_back(value);
      }
    labels[places[c]] = value;
  }



  /** Lists the cells at the borders of ranks, which both sides know. */
  template <int dim>
  void Hinges<dim>::find_borders()
  {
    const unsigned int me =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::vector<std::set<unsigned int>> ranks(
      grid.triangulation().n_vertices());
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      if (grid.is_known(c))
        for (const unsigned int v : grid.cell(c)->vertex_indices())
          ranks[grid.cell(c)->vertex_index(v)].insert(
            grid.cell(c)->subdomain_id());
    std::map<unsigned int, std::map<CellId, unsigned int>> to, from;
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      if (grid.is_known(c))
        {
          const auto         cell  = grid.cell(c);
          const unsigned int owner = cell->subdomain_id();
          for (const unsigned int v : cell->vertex_indices())
            for (const unsigned int rank : ranks[cell->vertex_index(v)])
              if (owner == me && rank != me)
                to[rank][cell->id()] = c;
              else if (owner != me && rank == me)
                from[owner][cell->id()] = c;
        }
    const auto list = [](const auto &all, auto &lists) {
      for (const auto &of_rank : all)
        for (const auto &cell : of_rank.second)
          lists[of_rank.first].push_back(cell.second);
    };
    list(to, told);
    list(from, heard);
  }



  /** Takes the labels of cells at the borders from their owners. */
  template <int dim>
  void Hinges<dim>::exchange()
  {
    if (told.empty() && heard.empty())
      find_borders();
    std::map<unsigned int, std::vector<Label>> messages;
    for (const auto &of_rank : told)
      for (const unsigned int c : of_rank.second)
        messages[of_rank.first].push_back(
          places[c] == BackgroundGrid<dim>::nowhere ? empty :
                                                      labels[places[c]]);
    for (const auto &message :
         Utilities::MPI::some_to_some(grid.communicator(), messages))
      {
        const auto &of_rank = heard.at(message.first);
        for (unsigned int i = 0; i < of_rank.size(); ++i)
          if (message.second[i] != empty)
            label(of_rank[i], message.second[i]);
      }
  }



  /** Gives all cells that faces connect the lowest label of theirs; whether
   * that changed any. */
  template <int dim>
  bool Hinges<dim>::spread()
  {
    const unsigned int                                   n = cells.size();
    std::vector<unsigned int>                            rank(n), parent(n);
    boost::disjoint_sets<unsigned int *, unsigned int *> pieces(rank.data(),
                                                                parent.data());
    for (unsigned int i = 0; i < n; ++i)
      pieces.make_set(i);
    for (unsigned int i = 0; i < n; ++i)
      for (const unsigned int c : grid.neighbors_of(cells[i]))
        if (c < grid.n_cells() && places[c] != BackgroundGrid<dim>::nowhere)
          pieces.union_set(i, places[c]);
    std::vector<Label> lowest(labels);
    for (unsigned int i = 0; i < n; ++i)
      {
        Label &of_piece = lowest[pieces.find_set(i)];
        of_piece        = std::min(of_piece, labels[i]);
      }
    bool changed = false;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Label value = lowest[pieces.find_set(i)];
        changed |= value != labels[i];
        labels[i] = value;
      }
    return changed;
  }



  template <int dim>
  std::vector<unsigned int> Hinges<dim>::vertices_between_pieces() const
  {
    std::vector<unsigned int> result;
    if (std::all_of(labels.begin(), labels.end(), [&](const Label value) {
          return value == labels.front();
        }))
      return result;
    std::unordered_map<unsigned int, Label> label_of;
    for (unsigned int i = 0; i < cells.size(); ++i)
      {
        const auto cell = grid.cell(cells[i]);
        for (const unsigned int v : cell->vertex_indices())
          if (label_of.emplace(cell->vertex_index(v), labels[i])
                .first->second != labels[i])
            result.push_back(cell->vertex_index(v));
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }



  template <int dim>
  void Hinges<dim>::find_cells_between()
  {
    between.clear();
    for (const unsigned int hinge : vertices_between_pieces())
      {
        const Point<dim> &x = grid.triangulation().get_vertices()[hinge];
        for (const unsigned int c : grid.cells_near(x, x))
          {
            const auto cell = grid.cell(c);
            const auto all  = cell->vertex_indices();
            if (grid.is_owned(c) && places[c] == BackgroundGrid<dim>::nowhere &&
                std::any_of(all.begin(), all.end(), [&](const unsigned int v) {
                  return cell->vertex_index(v) == hinge;
                }))
              between.push_back(c);
          }
      }
    std::sort(between.begin(), between.end());
    between.erase(std::unique(between.begin(), between.end()), between.end());
  }

  template class Hinges<2>;
  template class Hinges<3>;
} // namespace Impoint
