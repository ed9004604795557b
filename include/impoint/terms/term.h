#ifndef impoint_terms_term_h
#define impoint_terms_term_h

#include <vector>

namespace Impoint
{
  /**
   * The part of the linear system that one active cell contributes to.
   * Displacements are those of the step. Unknown i of the cell's node a is
   * a * dim + i; block (a, b) of the matrix occupies dim * dim doubles,
   * row-major, at (a * n + b) * dim * dim.
   */
  struct CellSystem
  {
    unsigned int  n        = 0;       // nodes
    const double *u        = nullptr; // n * dim
    double       *residual = nullptr; // n * dim
    double       *matrix   = nullptr; // null: the residual alone is wanted
  };

  /** Adds the force of factor times the n x n @p matrix, the same for all
   * components, on @p values of the nodes, which change by @p alpha times the
   * displacements. */
  template <int dim>
  void add_for_components(const std::vector<double> &matrix,
                          const double               factor,
                          const double              *values,
                          const double               alpha,
                          CellSystem                &system)
  {
    const unsigned int n = system.n;
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < n; ++b)
        {
          const double entry = factor * matrix[a * n + b];
          for (unsigned int d = 0; d < dim; ++d)
            {
              system.residual[a * dim + d] += entry * values[b * dim + d];
              if (system.matrix)
                system.matrix[(a * n + b) * dim * dim + d * dim + d] +=
                  alpha * entry;
            }
        }
  }

  /** Adds to the residual and tangent of the points that share a cell. */
  template <int dim>
  class Term
  {
  public:
    virtual ~Term() = default;

    /** @p k is the place of a material cell among the active ones. */
    virtual void add(const unsigned int k, CellSystem &system) const = 0;
  };
} // namespace Impoint

#endif
