#include <impoint/grid/finite_elements.h>
#include <impoint/grid/linear_functions.h>

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  template <int dim>
  struct FiniteElements<dim>::Elements
  {
    std::unique_ptr<FiniteElement<dim>> element;
    DoFHandler<dim>                     dofs;
    AffineConstraints<double>           hanging;
  };



  template <int dim>
  FiniteElements<dim>::FiniteElements(const BackgroundGrid<dim> &grid,
                                      const unsigned int         degree)
    : CellFunctions<dim>(grid)
    , degree(degree)
    , elements(std::make_unique<Elements>())
  {
    if (grid.simplicial())
      elements->element = std::make_unique<FE_SimplexP<dim>>(degree);
    else
      elements->element = std::make_unique<FE_Q<dim>>(degree);
    n_functions = elements->element->n_dofs_per_cell();
    elements->dofs.reinit(grid.triangulation());
    elements->dofs.distribute_dofs(*elements->element);
    describe_functions();
    number_nodes();
    list_cell_nodes();
    if (degree == 1 && grid.lattice().exists)
      place_on_lattice();
  }



  template <int dim>
  FiniteElements<dim>::~FiniteElements() = default;



  /** Reads off the element's support points in which order it has its quadratic
   * functions. */
  template <int dim>
  void FiniteElements<dim>::describe_functions()
  {
    if (degree == 1)
      return;
    for (const Point<dim> &x : elements->element->get_unit_support_points())
      if (!this->grid.simplicial())
        {
          factors.emplace_back();
          for (unsigned int d = 0; d < dim; ++d)
            factors.back()[d] = static_cast<unsigned char>(2 * x[d] + 0.5);
        }
      else
        {
          double first = 1; // barycentric coordinate of vertex 0
          for (unsigned int d = 0; d < dim; ++d)
            first -= x[d];
          std::vector<unsigned char> vertices;
          for (unsigned int v = 0; v <= dim; ++v)
            if ((v == 0 ? first : x[v - 1]) > 0.25)
              vertices.push_back(v);
          ends.push_back({{vertices.front(), vertices.back()}});
        }
  }



  template <int dim>
  void FiniteElements<dim>::number_nodes()
  {
    const auto    &dofs  = elements->dofs;
    auto          &lists = this->node_lists;
    const IndexSet owned = dofs.locally_owned_dofs();
    IndexSet       relevant;
    DoFTools::extract_locally_relevant_dofs(dofs, relevant);
    elements->hanging.reinit(relevant);
    DoFTools::make_hanging_node_constraints(dofs, elements->hanging);
    elements->hanging.close();

    relevant.fill_index_vector(lists.global_indices);
    lists.owners =
      Utilities::MPI::compute_index_owner(owned,
                                          relevant,
                                          this->grid.communicator());
  }



  template <int dim>
  void FiniteElements<dim>::list_cell_nodes()
  {
    const auto                          &dofs    = elements->dofs;
    const auto                          &element = *elements->element;
    auto                                &lists   = this->node_lists;
    std::vector<types::global_dof_index> indices(n_functions);

    lists.points.resize(lists.global_indices.size());
    lists.first_node.assign(1, 0);
    hanging_index.assign(this->grid.n_cells(), BackgroundGrid<dim>::nowhere);
    for (const auto &cell : dofs.active_cell_iterators())
      {
        if (!cell->is_artificial())
          {
            cell->get_dof_indices(indices);
            bool hangs = false;
            for (unsigned int v = 0; v < n_functions; ++v)
              {
                lists.points[lists.node_of(indices[v])] =
                  v < cell->n_vertices() ?
                    cell->vertex(v) :
                    this->grid.mapping().transform_unit_to_real_cell(
                      cell, element.unit_support_point(v));
                hangs |= elements->hanging.is_constrained(indices[v]);
              }
            if (hangs)
              {
                hanging_index[cell->active_cell_index()] = hanging.size();
                list_hanging_cell(indices);
              }
            else
              for (const auto index : indices)
                lists.cell_nodes.push_back(lists.node_of(index));
          }
        lists.first_node.push_back(lists.cell_nodes.size());
      }
  }



  template <int dim>
  void FiniteElements<dim>::list_hanging_cell(
    const std::vector<types::global_dof_index> &indices)
  {
    auto                                       &lists = this->node_lists;
    std::vector<std::map<unsigned int, double>> rows(n_functions);
    std::map<unsigned int, unsigned int>        column;
    for (unsigned int v = 0; v < n_functions; ++v)
      {
        if (const auto *entries =
              elements->hanging.get_constraint_entries(indices[v]))
          for (const auto &entry : *entries)
            rows[v][lists.node_of(entry.first)] = entry.second;
        else
          rows[v][lists.node_of(indices[v])] = 1.;
        for (const auto &entry : rows[v])
          column.emplace(entry.first, 0);
      }
    unsigned int n_columns = 0;
    for (auto &entry : column)
      {
        entry.second = n_columns++;
        lists.cell_nodes.push_back(entry.first);
      }
    hanging.emplace_back(n_functions * n_columns, 0.);
    for (unsigned int v = 0; v < n_functions; ++v)
      for (const auto &entry : rows[v])
        hanging.back()[v * n_columns + column[entry.first]] = entry.second;
  }



  template <int dim>
  void FiniteElements<dim>::place_on_lattice()
  {
    for (const Point<dim> &point : this->node_lists.points)
      {
        const Tensor<1, dim> at = this->grid.lattice().coordinates(point);
        this->node_lists.lattice.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          this->node_lists.lattice.back()[d] =
            static_cast<int>(std::lround(at[d]));
      }
  }



  template <int dim>
  void FiniteElements<dim>::quadratic_tensor_functions(const Point<dim> &xi,
                                                       double           *values,
                                                       double *gradients) const
  {
    double N[dim][3], dN[dim][3];
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double t = xi[d];
        N[d][0]        = (1 - t) * (1 - 2 * t);
        N[d][1]        = 4 * t * (1 - t);
        N[d][2]        = t * (2 * t - 1);
        dN[d][0]       = 4 * t - 3;
        dN[d][1]       = 4 - 8 * t;
        dN[d][2]       = 4 * t - 1;
      }
    for (unsigned int v = 0; v < n_functions; ++v)
      {
        values[v] = 1;
        for (unsigned int e = 0; e < dim; ++e)
          {
            values[v] *= N[e][factors[v][e]];
            double product = dN[e][factors[v][e]];
            for (unsigned int d = 0; d < dim; ++d)
              if (d != e)
                product *= N[d][factors[v][d]];
            gradients[v * dim + e] = product;
          }
      }
  }



  template <int dim>
  void FiniteElements<dim>::quadratic_simplex_functions(const Point<dim> &xi,
                                                        double *values,
                                                        double *gradients) const
  {
    double lambda[dim + 1], slope[dim + 1][dim];
    linear_functions<dim, true>(xi, lambda, &slope[0][0]);
    for (unsigned int v = 0; v < n_functions; ++v)
      {
        const unsigned int i = ends[v][0], j = ends[v][1];
        if (i == j)
          values[v] = lambda[i] * (2 * lambda[i] - 1);
        else
          values[v] = 4 * lambda[i] * lambda[j];
        for (unsigned int d = 0; d < dim; ++d)
          gradients[v * dim + d] =
            i == j ? (4 * lambda[i] - 1) * slope[i][d] :
                     4 * (slope[i][d] * lambda[j] + lambda[i] * slope[j][d]);
      }
  }



  template <int dim>
  void FiniteElements<dim>::reference_functions(const Point<dim> &xi,
                                                double           *values,
                                                double *gradients) const
  {
    if (degree == 1 && this->grid.simplicial())
      linear_functions<dim, true>(xi, values, gradients);
    else if (degree == 1)
      linear_functions<dim, false>(xi, values, gradients);
    else if (this->grid.simplicial())
      quadratic_simplex_functions(xi, values, gradients);
    else
      quadratic_tensor_functions(xi, values, gradients);
  }



  template <int dim>
  void FiniteElements<dim>::evaluate_by_fe_values(const unsigned int c,
                                                  const Point<dim>  &xi,
                                                  double            *values,
                                                  double *gradients) const
  {
    FEValues<dim> fe_values(this->grid.mapping(),
                            *elements->element,
                            Quadrature<dim>(xi),
                            update_values | update_gradients);
    fe_values.reinit(this->grid.cell(c));
    for (const unsigned int v : fe_values.dof_indices())
      {
        values[v] = fe_values.shape_value(v, 0);
        for (unsigned int d = 0; d < dim; ++d)
          gradients[v * dim + d] = fe_values.shape_grad(v, 0)[d];
      }
  }



  template <int dim>
  void FiniteElements<dim>::evaluate(const unsigned int c,
                                     const Point<dim>  &xi,
                                     double            *support) const
  {
    const unsigned int n     = this->node_lists.n_nodes_of(c);
    const bool         hangs = hanging_index[c] != BackgroundGrid<dim>::nowhere;
    double             own_values[most_functions];
    double             own_gradients[most_functions * dim];
    double            *values    = hangs ? own_values : support;
    double            *gradients = hangs ? own_gradients : support + n;
    if (this->grid.is_affine(c))
      {
        double reference[most_functions * dim];
        reference_functions(xi, values, reference);
        const Tensor<2, dim> &inverse = this->grid.inverse_jacobian_of(c);
        for (unsigned int v = 0; v < n_functions; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            {
              double sum = 0;
              for (unsigned int e = 0; e < dim; ++e)
                sum += inverse[e][d] * reference[v * dim + e];
              gradients[v * dim + d] = sum;
            }
      }
    else
      evaluate_by_fe_values(c, xi, values, gradients);
    if (!hangs)
      return;

    const std::vector<double> &weights = hanging[hanging_index[c]];
    std::fill(support, support + (dim + 1) * n, 0.);
    for (unsigned int v = 0; v < n_functions; ++v)
      for (unsigned int a = 0; a < n; ++a)
        {
          const double weight = weights[v * n + a];
          support[a] += weight * values[v];
          for (unsigned int d = 0; d < dim; ++d)
            support[n + a * dim + d] += weight * gradients[v * dim + d];
        }
  }



  template <int dim>
  void FiniteElements<dim>::evaluate_all(const unsigned int                 c,
                                         const ArrayView<const Point<dim>> &xi,
                                         double *supports) const
  {
    if (degree > 1 || !this->grid.is_affine(c) ||
        hanging_index[c] != BackgroundGrid<dim>::nowhere)
      return CellFunctions<dim>::evaluate_all(c, xi, supports);
    const Tensor<2, dim> &inverse = this->grid.inverse_jacobian_of(c);
    if (this->grid.simplicial())
      linear_supports<dim, true>(inverse, xi, supports);
    else
      linear_supports<dim, false>(inverse, xi, supports);
  }



  template <int dim>
  std::vector<unsigned int>
  FiniteElements<dim>::nodes_on_face(const unsigned int c,
                                     const unsigned int f) const
  {
    const typename DoFHandler<dim>::active_cell_iterator cell(
      &this->grid.triangulation(),
      this->grid.cell(c)->level(),
      this->grid.cell(c)->index(),
      &elements->dofs);
    std::vector<types::global_dof_index> indices(
      elements->element->n_dofs_per_face(f));
    cell->face(f)->get_dof_indices(indices);
    std::vector<unsigned int> nodes;
    for (const auto index : indices)
      if (!elements->hanging.is_constrained(index))
        nodes.push_back(this->node_lists.node_of(index));
    return nodes;
  }

  template class FiniteElements<2>;
  template class FiniteElements<3>;
} // namespace Impoint
