#include <impoint/grid/basis.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  template <int dim>
  struct Basis<dim>::Elements
  {
    std::unique_ptr<FiniteElement<dim>> element;
    DoFHandler<dim>                     dofs;
    IndexSet                            relevant;
    AffineConstraints<double>           hanging;
  };



  template <int dim>
  Basis<dim>::Basis(const BackgroundGrid<dim> &grid)
    : background(grid)
    , elements(std::make_unique<Elements>())
  {
    if (grid.simplicial())
      elements->element = std::make_unique<FE_SimplexP<dim>>(1);
    else
      elements->element = std::make_unique<FE_Q<dim>>(1);
    elements->dofs.reinit(grid.triangulation());
    elements->dofs.distribute_dofs(*elements->element);
    number_nodes();
    list_cell_nodes();
  }



  template <int dim>
  Basis<dim>::~Basis() = default;



  template <int dim>
  void Basis<dim>::number_nodes()
  {
    const auto    &dofs     = elements->dofs;
    const IndexSet owned    = dofs.locally_owned_dofs();
    IndexSet      &relevant = elements->relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    elements->hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dofs, elements->hanging);
    elements->hanging.close();

    relevant.fill_index_vector(global_indices);
    owners = Utilities::MPI::compute_index_owner(owned,
                                                 relevant,
                                                 background.communicator());
  }



  template <int dim>
  void Basis<dim>::list_cell_nodes()
  {
    const auto        &dofs = elements->dofs;
    const unsigned int n_v  = elements->element->n_dofs_per_cell();
    std::vector<types::global_dof_index> indices(n_v);

    points.resize(global_indices.size());
    first_node.assign(background.n_cells() + 1, 0);
    hanging_index.assign(background.n_cells(), BackgroundGrid<dim>::nowhere);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        const unsigned int c = cell->active_cell_index();
        first_node[c]        = cell_nodes.size();
        first_node[c + 1]    = cell_nodes.size();
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(indices);
        bool hangs = false;
        for (unsigned int v = 0; v < n_v; ++v)
          {
            points[node_of(indices[v])] = cell->vertex(v);
            hangs |= elements->hanging.is_constrained(indices[v]);
          }
        if (!hangs)
          for (const auto index : indices)
            cell_nodes.push_back(node_of(index));
        else
          {
            std::vector<std::map<unsigned int, double>> rows(n_v);
            std::map<unsigned int, unsigned int>        column;
            for (unsigned int v = 0; v < n_v; ++v)
              {
                if (const auto *entries =
                      elements->hanging.get_constraint_entries(indices[v]))
                  for (const auto &entry : *entries)
                    rows[v][node_of(entry.first)] = entry.second;
                else
                  rows[v][node_of(indices[v])] = 1.;
                for (const auto &entry : rows[v])
                  column.emplace(entry.first, 0);
              }
            unsigned int n_columns = 0;
            for (auto &entry : column)
              {
                entry.second = n_columns++;
                cell_nodes.push_back(entry.first);
              }
            hanging_index[c] = hanging.size();
            hanging.emplace_back(n_v * n_columns, 0.);
            for (unsigned int v = 0; v < n_v; ++v)
              for (const auto &entry : rows[v])
                hanging.back()[v * n_columns + column[entry.first]] =
                  entry.second;
          }
        first_node[c + 1] = cell_nodes.size();
      }
  }



  template <int dim>
  unsigned int Basis<dim>::node_of(const types::global_dof_index index) const
  {
    const auto place =
      std::lower_bound(global_indices.begin(), global_indices.end(), index);
    return place != global_indices.end() && *place == index ?
             place - global_indices.begin() :
             BackgroundGrid<dim>::nowhere;
  }



  namespace
  {
    /** Values and reference gradients of the linear functions of a cell. */
    template <int dim>
    unsigned int linear_functions(const bool        simplicial,
                                  const Point<dim> &xi,
                                  double           *values,
                                  double           *gradients)
    {
      if (simplicial)
        {
          values[0] = 1.;
          for (unsigned int d = 0; d < dim; ++d)
            {
              values[0] -= xi[d];
              values[d + 1] = xi[d];
              gradients[d]  = -1.;
              for (unsigned int e = 0; e < dim; ++e)
                gradients[(d + 1) * dim + e] = (d == e);
            }
          return dim + 1;
        }
      for (unsigned int v = 0; v < (1 << dim); ++v)
        {
          double factor[dim], slope[dim];
          for (unsigned int d = 0; d < dim; ++d)
            {
              const bool upper = (v >> d) & 1;
              factor[d]        = upper ? xi[d] : 1. - xi[d];
              slope[d]         = upper ? 1. : -1.;
            }
          values[v] = factor[0] * factor[1] * (dim == 3 ? factor[dim - 1] : 1.);
          for (unsigned int d = 0; d < dim; ++d)
            {
              double product = slope[d];
              for (unsigned int e = 0; e < dim; ++e)
                if (e != d)
                  product *= factor[e];
              gradients[v * dim + d] = product;
            }
        }
      return 1 << dim;
    }
  } // namespace



  template <int dim>
  void Basis<dim>::evaluate(const unsigned int c,
                            const Point<dim>  &xi,
                            double            *support) const
  {
    if (!background.is_affine(c))
      return evaluate_by_fe_values(c, xi, support);

    constexpr unsigned int max_vertices = 1 << dim;
    double                 values[max_vertices], reference[max_vertices * dim];
    const unsigned int     n_v =
      linear_functions<dim>(background.simplicial(), xi, values, reference);
    const Tensor<2, dim> &inverse = background.inverse_jacobian_of(c);
    double                gradients[max_vertices * dim];
    for (unsigned int v = 0; v < n_v; ++v)
      for (unsigned int d = 0; d < dim; ++d)
        {
          double sum = 0;
          for (unsigned int e = 0; e < dim; ++e)
            sum += inverse[e][d] * reference[v * dim + e];
          gradients[v * dim + d] = sum;
        }

    if (hanging_index[c] == BackgroundGrid<dim>::nowhere)
      {
        std::copy(values, values + n_v, support);
        std::copy(gradients, gradients + n_v * dim, support + n_v);
        return;
      }
    const std::vector<double> &weights = hanging[hanging_index[c]];
    const unsigned int         n       = n_nodes_of(c);
    std::fill(support, support + support_size(c), 0.);
    for (unsigned int v = 0; v < n_v; ++v)
      for (unsigned int a = 0; a < n; ++a)
        {
          const double weight = weights[v * n + a];
          support[a] += weight * values[v];
          for (unsigned int d = 0; d < dim; ++d)
            support[n + a * dim + d] += weight * gradients[v * dim + d];
        }
  }



  template <int dim>
  void Basis<dim>::evaluate_by_fe_values(const unsigned int c,
                                         const Point<dim>  &xi,
                                         double            *support) const
  {
    FEValues<dim> fe_values(background.mapping(),
                            *elements->element,
                            Quadrature<dim>(xi),
                            update_values | update_gradients);
    fe_values.reinit(background.cell(c));

    const unsigned int n = n_nodes_of(c);
    std::fill(support, support + support_size(c), 0.);
    for (const unsigned int v : fe_values.dof_indices())
      for (unsigned int a = 0; a < n; ++a)
        {
          const double weight =
            hanging_index[c] == BackgroundGrid<dim>::nowhere ?
              double(a == v) :
              hanging[hanging_index[c]][v * n + a];
          support[a] += weight * fe_values.shape_value(v, 0);
          for (unsigned int d = 0; d < dim; ++d)
            support[n + a * dim + d] += weight * fe_values.shape_grad(v, 0)[d];
        }
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
  } // namespace



  template <int dim>
  std::vector<std::pair<unsigned int, Tensor<1, dim>>>
  Basis<dim>::boundary_nodes(const types::boundary_id boundary_id) const
  {
    // Each rank sums over its own cells only; the exchange completes the sums
    // and tells ranks that touch the boundary with a corner alone.
    const unsigned int                         marker = dim;
    LinearAlgebra::distributed::Vector<double> sums[dim + 1];
    for (auto &sum : sums)
      sum.reinit(elements->dofs.locally_owned_dofs(),
                 elements->relevant,
                 background.communicator());

    std::vector<types::global_dof_index> indices(
      elements->element->n_dofs_per_cell());
    for (const auto &cell : elements->dofs.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == boundary_id)
            {
              cell->get_dof_indices(indices);
              const auto           face   = cell->face(f);
              const Tensor<1, dim> normal = outward_normal<dim>(cell, face);
              for (const unsigned int v : face->vertex_indices())
                for (const unsigned int w : cell->vertex_indices())
                  if (cell->vertex_index(w) == face->vertex_index(v) &&
                      !elements->hanging.is_constrained(indices[w]))
                    {
                      for (unsigned int d = 0; d < dim; ++d)
                        sums[d](indices[w]) += normal[d];
                      sums[marker](indices[w]) += 1.;
                    }
            }
    for (auto &sum : sums)
      {
        sum.compress(VectorOperation::add);
        sum.update_ghost_values();
      }

    std::vector<std::pair<unsigned int, Tensor<1, dim>>> nodes;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      if (sums[marker](global_indices[node]) > 0)
        {
          Tensor<1, dim> normal;
          for (unsigned int d = 0; d < dim; ++d)
            normal[d] = sums[d](global_indices[node]);
          nodes.emplace_back(node, normal);
        }
    return nodes;
  }

  template class Basis<2>;
  template class Basis<3>;
} // namespace Impoint
