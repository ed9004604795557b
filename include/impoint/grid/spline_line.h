#ifndef impoint_grid_spline_line_h
#define impoint_grid_spline_line_h

namespace Impoint
{
  /**
   * B-splines of degree p on a line of n cells of length 1. Knots are the
   * cells' ends, the first and the last of them p + 1 times; function i lives
   * on the cells i - p ... i, of those that there are.
   *
   * The space is that of the uniform splines with functions centred outside of
   * the line; repeated end knots only choose another basis of it, one in which
   * a single function is not zero at either end.
   */
  class SplineLine
  {
  public:
    static constexpr int max_degree = 3;

    SplineLine(const int degree, const int n_cells)
      : degree(degree)
      , n_cells(n_cells)
    {}

    int n_functions() const
    {
      return n_cells + degree;
    }

    /** Knot @p k = 0 ... n_cells + 2 degree. */
    int knot(const int k) const
    {
      const int place = k - degree;
      return place < 0 ? 0 : (place > n_cells ? n_cells : place);
    }

    /** Functions cell ... cell + degree at @p t in [0, 1] of the cell, and
     * their derivatives. */
    void evaluate(const int    cell,
                  const double t,
                  double      *values,
                  double      *derivatives) const;

    /** Where the coefficient of function @p i of x is x: mean of the inner
     * knots. */
    double greville_place(const int i) const;

    /** Coefficients on this line, for function @p i, of the functions of a
     * coarser line with cells of length 2: one after the other from @p first
     * on. Returns how many there are. */
    int refine(const SplineLine &coarse,
               const int         i,
               int              &first,
               double           *weights) const;

    int degree, n_cells;
  };
} // namespace Impoint

#endif
