#include <impoint/solver/quantile.h>
#include <impoint/solver/slivers.h>

#include <algorithm>

namespace Impoint
{
  using namespace dealii;

  namespace
  {
    /** The largest diagonal entry of a node among its free unknowns (conforming
     * conditions leave rows with nothing but a diagonal of any size); negative
     * if none is free. */
    template <int dim>
    double free_diagonal(const BlockMatrix<dim> &matrix, const unsigned int row)
    {
      double diagonal[dim] = {};
      bool   coupled[dim]  = {};
      for (std::size_t k = matrix.pattern->row_start[row];
           k < matrix.pattern->row_start[row + 1];
           ++k)
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double entry = matrix.values[(k * dim + r) * dim + c];
              if (matrix.pattern->columns[k] == row && r == c)
                diagonal[r] = entry;
              else if (entry != 0)
                coupled[r] = true;
            }
      double largest = -1;
      for (unsigned int d = 0; d < dim; ++d)
        if (coupled[d])
          largest = std::max(largest, diagonal[d]);
      return largest;
    }
  } // namespace

  template <int dim>
  std::vector<char> find_slivers(const BlockMatrix<dim> &matrix,
                                 const NodeExchange     &nodes,
                                 const double            part)
  {
    std::vector<double> diagonal(matrix.pattern->n_rows());
    for (unsigned int node = 0; node < diagonal.size(); ++node)
      diagonal[node] = free_diagonal(matrix, node);

    const double threshold =
      part * quantile(diagonal, 0.5, nodes.communicator());
    std::vector<char> found(diagonal.size() + nodes.n_ghosts());
    for (unsigned int node = 0; node < diagonal.size(); ++node)
      found[node] = diagonal[node] >= 0 && diagonal[node] < threshold;
    nodes.share(found);
    return found;
  }

  template std::vector<char>
  find_slivers(const BlockMatrix<2> &, const NodeExchange &, const double);
  template std::vector<char>
  find_slivers(const BlockMatrix<3> &, const NodeExchange &, const double);
} // namespace Impoint
