#include <impoint/solver/held_nodes.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Impoint
{
  /** P K P + diagonal (1 - P) with the projector P onto what nodes are free to
   * do: P Eqs. 29, 32, 35 without turning unknowns into other frames, which
   * would hide rigid motions from whoever reads the matrix. */
  template <int dim>
  void eliminate(const std::vector<Enforcement::HeldNode<dim>> &held,
                 const unsigned int                             n_owned_nodes,
                 const double                                   diagonal,
                 BlockMatrix<dim>                              &matrix)
  {
    if (held.empty())
      return;
    constexpr unsigned int    none = BackgroundGrid<dim>::nowhere;
    const Tensor<2, dim>      one(unit_symmetric_tensor<dim>());
    const auto               &pattern = *matrix.pattern;
    std::vector<unsigned int> held_at(pattern.n_rows(), none);
    for (unsigned int i = 0; i < held.size(); ++i)
      held_at[held[i].node] = i;

    const auto treat = [&](const unsigned int row, const std::size_t q) {
      const unsigned int column = pattern.columns[q];
      const unsigned int i = held_at[row], j = held_at[column];
      if (i == none && j == none)
        return;
      double        *values = matrix.values.data() + q * dim * dim;
      Tensor<2, dim> block;
      for (unsigned int r = 0; r < dim; ++r)
        for (unsigned int s = 0; s < dim; ++s)
          block[r][s] = values[r * dim + s];
      if (i != none)
        block = held[i].projector() * block;
      if (j != none)
        block = block * held[j].projector();
      if (row == column && row < n_owned_nodes)
        block += diagonal * (one - held[i].projector());
      for (unsigned int r = 0; r < dim; ++r)
        for (unsigned int s = 0; s < dim; ++s)
          values[r * dim + s] = block[r][s];
    };
    for (unsigned int row = 0; row < pattern.n_rows(); ++row)
      for (std::size_t q = pattern.row_start[row];
           q < pattern.row_start[row + 1];
           ++q)
        treat(row, q);
  }



  template <int dim>
  void cut(const std::vector<Enforcement::HeldNode<dim>> &held,
           const bool                                     with_values,
           LinearAlgebra::distributed::Vector<double>    &vector)
  {
    for (const auto &node : held)
      {
        Tensor<1, dim> value;
        for (unsigned int d = 0; d < dim; ++d)
          value[d] = vector.local_element(node.node * dim + d);
        value = node.projector() * value;
        if (with_values)
          value += node.prescribed();
        for (unsigned int d = 0; d < dim; ++d)
          vector.local_element(node.node * dim + d) = value[d];
      }
  }

#define IMPOINT_INSTANTIATE(dim)                                           \
  template void eliminate(const std::vector<Enforcement::HeldNode<dim>> &, \
                          const unsigned int,                              \
                          const double,                                    \
                          BlockMatrix<dim> &);                             \
  template void cut(const std::vector<Enforcement::HeldNode<dim>> &,       \
                    const bool,                                            \
                    LinearAlgebra::distributed::Vector<double> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
