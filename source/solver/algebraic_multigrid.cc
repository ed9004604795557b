#include <impoint/solver/algebraic_multigrid.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <mpi.h>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>

namespace Impoint
{
  using namespace dealii;

  template <int dim>
  struct AlgebraicMultigrid<dim>::Implementation
  {
    static constexpr unsigned int n_modes = dim * (dim + 1) / 2;

    Implementation(const unsigned int n_nodes, const NodeExchange &nodes)
      : nodes(nodes)
      , n_nodes(n_nodes)
      , map(-1,
            static_cast<int>(n_nodes * dim),
            0,
            Epetra_MpiComm(nodes.communicator()))
    {}

    void set_modes(const std::vector<Point<dim>> &points);

    const NodeExchange                nodes;
    const unsigned int                n_nodes; // owned
    Epetra_Map                        map;
    std::unique_ptr<Epetra_CrsMatrix> matrix;
    TrilinosWrappers::PreconditionAMG hierarchy;
    std::vector<double>               modes; // one after the other
  };

  template <int dim>
  void AlgebraicMultigrid<dim>::Implementation::set_modes(
    const std::vector<Point<dim>> &points)
  {
    // about the centre, so that rotations and translations are comparable
    Tensor<1, dim> centre;
    for (unsigned int node = 0; node < n_nodes; ++node)
      centre += points[node];
    centre = Utilities::MPI::sum(centre, nodes.communicator()) /
             Utilities::MPI::sum(double(n_nodes), nodes.communicator());

    const std::size_t size = std::size_t(n_nodes) * dim;
    // of no nodes, too, a place: ML takes a null pointer for no modes given
    modes.assign(std::max<std::size_t>(n_modes * size, 1), 0.);
    for (std::size_t node = 0; node < n_nodes; ++node)
      {
        const Tensor<1, dim> arm  = Tensor<1, dim>(points[node]) - centre;
        double              *mode = &modes[node * dim];
        for (unsigned int d = 0; d < dim; ++d, mode += size)
          mode[d] = 1;
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = d + 1; e < dim; ++e, mode += size)
            {
              mode[d] = -arm[e];
              mode[e] = arm[d];
            }
      }
  }

  template <int dim>
  AlgebraicMultigrid<dim>::AlgebraicMultigrid(
    const BlockPattern            &pattern,
    const NodeExchange            &nodes,
    const std::vector<Point<dim>> &points)
    : implementation(std::make_unique<Implementation>(pattern.n_rows(), nodes))
  {
    implementation->set_modes(points);
  }

  template <int dim>
  AlgebraicMultigrid<dim>::~AlgebraicMultigrid() = default;

  template <int dim>
  void AlgebraicMultigrid<dim>::new_matrix(const BlockMatrix<dim> &matrix)
  {
    const BlockPattern &pattern = *matrix.pattern;
    std::vector<int>    n_entries(pattern.n_rows() * dim);
    for (std::size_t row = 0; row < n_entries.size(); ++row)
      n_entries[row] =
        (pattern.row_start[row / dim + 1] - pattern.row_start[row / dim]) * dim;
    auto copy = std::make_unique<Epetra_CrsMatrix>(Copy,
                                                   implementation->map,
                                                   n_entries.data(),
                                                   true);

    std::vector<int>    columns;
    std::vector<double> values;
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      for (unsigned int component = 0; component < dim; ++component)
        {
          columns.clear();
          values.clear();
          for (std::size_t k = pattern.row_start[row];
               k < pattern.row_start[row + 1];
               ++k)
            for (unsigned int d = 0; d < dim; ++d)
              {
                columns.push_back(
                  implementation->nodes.global_number(pattern.columns[k]) *
                    dim +
                  d);
                values.push_back(
                  matrix.values[(k * dim + component) * dim + d]);
              }
          copy->InsertGlobalValues(implementation->map.GID(
                                     static_cast<int>(row * dim + component)),
                                   columns.size(),
                                   values.data(),
                                   columns.data());
        }
    copy->FillComplete();

    Teuchos::ParameterList parameters;
    parameters.set("ML output", 0);
    parameters.set("PDE equations", dim);
    parameters.set("prec type", "MGV");
    parameters.set("aggregation: type", "Uncoupled");
    parameters.set("aggregation: threshold", 0.);
    parameters.set("smoother: type", "symmetric block Gauss-Seidel");
    parameters.set("smoother: sweeps", 1);
    parameters.set("coarse: type", "Amesos-KLU");
    parameters.set("coarse: max size", 600);
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension",
                   static_cast<int>(Implementation::n_modes));
    parameters.set("null space: vectors", implementation->modes.data());
    implementation->hierarchy.initialize(*copy, parameters);
    implementation->matrix = std::move(copy); // the hierarchy refers to it
  }

  template <int dim>
  void AlgebraicMultigrid<dim>::vmult(const std::vector<double> &r,
                                      std::vector<double>       &z) const
  {
    z.resize(r.size());
    const Epetra_Vector right(View,
                              implementation->map,
                              const_cast<double *>(r.data()));
    Epetra_Vector       solution(View, implementation->map, z.data());
    const int           status =
      implementation->hierarchy.trilinos_operator().ApplyInverse(right,
                                                                 solution);
    (void)status;
    Assert(status == 0, ExcInternalError());
  }

  template class AlgebraicMultigrid<2>;
  template class AlgebraicMultigrid<3>;
} // namespace Impoint
