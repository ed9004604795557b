// Links of the two cells at each face, and of the cells at each vertex: their
// nodes, their couplings in the pattern, and that nothing depends on the ranks.

#include <impoint/grid/active_nodes.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <iostream>
#include <set>

#include "basis_checks.h"

// the cells around what a cell shares with them: faces, or its first vertex
template <int dim>
std::vector<std::set<unsigned int>> groups_at(const BackgroundGrid<dim> &grid,
                                              const unsigned int         c,
                                              const bool                 faces)
{
  std::vector<std::set<unsigned int>> groups;
  for (const unsigned int f : grid.cell(c)->face_indices())
    if (faces && !grid.cell(c)->at_boundary(f))
      groups.push_back({c, grid.cell(c)->neighbor(f)->active_cell_index()});
  if (!faces)
    {
      groups.emplace_back();
      for (unsigned int other = 0; other < grid.n_cells(); ++other)
        if (grid.is_known(other))
          for (const auto v : grid.cell(other)->vertex_indices())
            if (grid.cell(other)->vertex(v).distance(grid.cell(c)->vertex(0)) <
                1e-10)
              groups[0].insert(other);
    }
  return groups;
}

// each group once, by the lowest rank that owns a cell of it
template <int dim>
Links links_of(const BackgroundGrid<dim> &grid, const bool faces)
{
  const unsigned int me = Utilities::MPI::this_mpi_process(grid.communicator());
  std::set<std::set<unsigned int>> all;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (faces ? grid.is_owned(c) : grid.is_known(c))
      for (const auto &group : groups_at(grid, c, faces))
        {
          unsigned int lowest = numbers::invalid_unsigned_int;
          for (const unsigned int other : group)
            lowest = std::min(lowest, grid.cell(other)->subdomain_id());
          if (lowest == me && group.size() > 1)
            all.insert(group);
        }
  Links links;
  for (const auto &group : all)
    links.add({group.begin(), group.end()});
  return links;
}

template <int dim>
void print_sums(const ActiveNodes<dim> &active, const Links &links)
{
  const MPI_Comm comm = active.basis().grid().communicator();
  LinearAlgebra::distributed::Vector<double> field(active.scalars());
  for (unsigned int i = 0; i < active.n_owned_nodes(); ++i)
    field.local_element(i) =
      coefficient(active.basis().point(active.grid_node(i)));
  field.update_ghost_values();

  std::vector<double> matrix(active.pattern().columns.size(), 0.);
  double              size = 0, misplaced = 0;
  for (unsigned int l = 0; l < links.size(); ++l)
    {
      const unsigned int k     = active.link(l);
      const auto         nodes = active.nodes(k);
      size += nodes.size();
      for (const unsigned int c : links.cells(l))
        for (unsigned int a = 0; a < active.places(k, c).size(); ++a)
          misplaced +=
            active.basis()
              .point(active.grid_node(nodes[active.places(k, c)[a]]))
              .distance(active.basis().point(active.basis().nodes(c)[a]));
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int b = 0; b < nodes.size(); ++b)
          matrix[active.scatter(k)[a * nodes.size() + b]] +=
            active.basis()
              .point(active.grid_node(nodes[a]))
              .distance(active.basis().point(active.grid_node(nodes[b])));
    }
  double energy = 0;
  for (unsigned int i = 0; i < active.n_nodes(); ++i)
    for (std::size_t q = active.pattern().row_start[i];
         q < active.pattern().row_start[i + 1];
         ++q)
      energy += field.local_element(i) * matrix[q] *
                field.local_element(active.pattern().columns[q]);
  const auto n = Utilities::MPI::sum(links.size(), comm);
  size         = Utilities::MPI::sum(size, comm);
  energy       = Utilities::MPI::sum(energy, comm);
  if (Utilities::MPI::this_mpi_process(comm) == 0)
    std::cout << "  " << n << " links, " << size << " nodes, energy "
              << energy / n << (misplaced == 0 ? "" : ", misplaced")
              << std::endl;
}

template <int dim>
void test(const std::vector<std::string> &entries)
{
  const GridScene           scene(entries);
  const BackgroundGrid<dim> grid(scene.file, scene.parameters, MPI_COMM_WORLD);
  const Basis<dim>          basis(grid, scene.file, scene.parameters);
  ActiveNodes<dim>          active(basis);
  std::vector<unsigned int> own;
  for (unsigned int c = 0; c < grid.n_cells(); ++c)
    if (grid.is_owned(c))
      own.push_back(c);
  const bool root = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  if (root)
    std::cout << dim << "D, " << basis.name() << std::endl;
  active.reinit(own, {});
  for (const bool faces : {true, false})
    {
      const Links links  = links_of(grid, faces);
      const auto  find   = [&]() { return links; };
      const bool  first  = active.reinit(own, {}, find),
                 changed = active.reinit(own, {}, find);
      if (root)
        std::cout << "  changed: " << first << ' ' << changed << std::endl;
      print_sums(active, links);
    }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string box = "Grid/Generator = subdivided_hyper_rectangle";
  for (const std::string basis : {"linear", "quadratic", "cubic spline"})
    test<2>(
      {box, "Grid/Arguments = 5, 4 : 0, 0 : 1, 1", "Grid/Basis = " + basis});
  test<2>(
    {box, "Grid/Arguments = 5, 4 : 0, 0 : 1, 1", "Grid/Cells = triangles"});
  test<3>({box,
           "Grid/Arguments = 3, 3, 2 : 0, 0, 0 : 1, 1, 1",
           "Grid/Basis = quadratic spline"});
}
