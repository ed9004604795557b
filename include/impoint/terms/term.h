#ifndef impoint_terms_term_h
#define impoint_terms_term_h

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
