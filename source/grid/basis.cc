#include <impoint/base/parameter_file.h>
#include <impoint/grid/basis.h>
#include <impoint/grid/finite_elements.h>
#include <impoint/grid/splines.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  template <int dim>
  unsigned int
  NodeLists<dim>::node_of(const types::global_dof_index index) const
  {
    const auto place =
      std::lower_bound(global_indices.begin(), global_indices.end(), index);
    return place != global_indices.end() && *place == index ?
             place - global_indices.begin() :
             BackgroundGrid<dim>::nowhere;
  }



  template <int dim>
  Basis<dim>::Basis(const BackgroundGrid<dim> &grid)
    : background(grid)
    , kind("linear")
    , of_degree(1)
  {
    make_functions();
  }



  template <int dim>
  Basis<dim>::Basis(const BackgroundGrid<dim> &grid,
                    const ParameterFile       &file,
                    const GridParameters      &parameters)
    : background(grid)
    , kind(parameters.basis)
    , of_degree(parameters.degree())
  {
    if (is_spline() && !grid.lattice().exists)
      throw file.error(parameters.section + "/Basis",
                       "a '" + kind +
                         "' on a grid that is not made of equal boxes",
                       "Set Basis = linear or quadratic, or make the grid "
                       "Cartesian (rotated and shifted as you like): without "
                       "'Distortion' and 'Refine where', 'Cells = as made'.");
    make_functions();
  }



  template <int dim>
  void Basis<dim>::make_functions()
  {
    if (is_spline())
      functions = std::make_unique<Splines<dim>>(background, degree());
    else
      functions = std::make_unique<FiniteElements<dim>>(background, degree());
    if (background.lattice().exists && (is_spline() || degree() == 1))
      for (unsigned int d = 0; d < dim; ++d)
        lattice_lines.emplace_back(degree(), background.lattice().n_cells[d]);
  }



  namespace
  {
    /** Normal of a cell's face out of the cell, as long as the face is large.
     */
    template <int dim, typename CellIterator, typename FaceIterator>
    Tensor<1, dim> outward_normal(const CellIterator &cell,
                                  const FaceIterator &face)
    {
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal = cross_product_2d(face->vertex(1) - face->vertex(0));
      else
        normal = cross_product_3d(face->vertex(1) - face->vertex(0),
                                  face->vertex(2) - face->vertex(0));
      return (face->center() - cell->center()) * normal < 0 ? -normal : normal;
    }

    /** Calls @p function(c, f) for this rank's own faces on that part of the
     * boundary. */
    template <int dim, typename Function>
    void for_boundary_faces(const BackgroundGrid<dim> &grid,
                            const types::boundary_id   boundary_id,
                            const Function            &function)
    {
      for (unsigned int c = 0; c < grid.n_cells(); ++c)
        if (grid.is_owned(c))
          for (const unsigned int f : grid.cell(c)->face_indices())
            if (grid.cell(c)->face(f)->at_boundary() &&
                grid.cell(c)->face(f)->boundary_id() == boundary_id)
              function(c, f);
    }
  } // namespace



  template <int dim>
  bool Basis<dim>::can_hold(const types::boundary_id boundary_id) const
  {
    bool can = true;
    for_boundary_faces(background,
                       boundary_id,
                       [&](const unsigned int c, const unsigned int f) {
                         can = can && functions->can_hold_face(c, f);
                       });
    return Utilities::MPI::min(int(can), background.communicator()) != 0;
  }



  /** Completes the sums at nodes that other ranks' cells have, too, and tells
   * ranks that touch the boundary with a corner alone. */
  template <int dim>
  void Basis<dim>::sum_over_ranks(NodalNormals &normals) const
  {
    const MPI_Comm     comm = background.communicator();
    const unsigned int me   = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, std::vector<types::global_dof_index>> foreign;
    std::map<unsigned int, NodalNormals>                         parts;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (owner(node) != me)
        {
          foreign[owner(node)].push_back(global_index(node));
          parts[owner(node)].push_back(normals[node]);
        }
    const auto asked    = Utilities::MPI::some_to_some(comm, foreign);
    const auto received = Utilities::MPI::some_to_some(comm, parts);
    for (const auto &part : received)
      for (unsigned int i = 0; i < part.second.size(); ++i)
        for (unsigned int k = 0; k <= dim; ++k)
          normals[node_of(asked.at(part.first)[i])][k] += part.second[i][k];

    std::map<unsigned int, NodalNormals> answers;
    for (const auto &question : asked)
      for (const auto index : question.second)
        answers[question.first].push_back(normals[node_of(index)]);
    for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
      for (unsigned int i = 0; i < answer.second.size(); ++i)
        normals[node_of(foreign.at(answer.first)[i])] = answer.second[i];
  }



  template <int dim>
  std::vector<std::pair<unsigned int, Tensor<1, dim>>>
  Basis<dim>::boundary_nodes(const types::boundary_id boundary_id) const
  {
    // a normal and the number of faces that a node is on
    NodalNormals normals(n_nodes(), std::array<double, dim + 1>());
    for_boundary_faces(
      background, boundary_id, [&](const unsigned int c, const unsigned int f) {
        const auto          &cell   = background.cell(c);
        const Tensor<1, dim> normal = outward_normal<dim>(cell, cell->face(f));
        for (const unsigned int node : functions->nodes_on_face(c, f))
          {
            for (unsigned int d = 0; d < dim; ++d)
              normals[node][d] += normal[d];
            normals[node][dim] += 1.;
          }
      });
    sum_over_ranks(normals);

    std::vector<std::pair<unsigned int, Tensor<1, dim>>> nodes;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (normals[node][dim] > 0)
        {
          Tensor<1, dim> normal;
          for (unsigned int d = 0; d < dim; ++d)
            normal[d] = normals[node][d];
          nodes.emplace_back(node, normal);
        }
    return nodes;
  }

  template struct NodeLists<2>;
  template struct NodeLists<3>;
  template class Basis<2>;
  template class Basis<3>;
} // namespace Impoint
