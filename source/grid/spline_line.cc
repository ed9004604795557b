#include <impoint/grid/spline_line.h>

namespace Impoint
{
  namespace
  {
    /**
     * The recursion of Cox and de Boor for the polynomial pieces on the knot
     * span @p span of @p line, whose knots are @p h apart. Its k-th step takes
     * the place places[k - 1]: equal places give values, the inner knots of a
     * function of a finer line its coefficients (the algorithm of Oslo).
     */
    void recurse(const SplineLine &line,
                 const int         h,
                 const int         span,
                 const int         degree,
                 const double     *places,
                 double           *values)
    {
      values[0] = 1;
      for (int k = 1; k <= degree; ++k)
        {
          const double x    = places[k - 1];
          double       rest = 0;
          for (int r = 0; r < k; ++r)
            {
              const double left  = x - h * line.knot(span + 1 - k + r);
              const double right = h * line.knot(span + 1 + r) - x;
              const double part  = values[r] / (left + right);
              values[r]          = rest + right * part;
              rest               = left * part;
            }
          values[k] = rest;
        }
    }
  } // namespace



  void SplineLine::evaluate(const int    cell,
                            const double t,
                            double      *values,
                            double      *derivatives) const
  {
    const int    span               = cell + degree;
    const double x                  = cell + t;
    const double places[max_degree] = {x, x, x};
    double       lower[max_degree];
    recurse(*this, 1, span, degree - 1, places, lower);
    recurse(*this, 1, span, degree, places, values);
    for (int r = 0; r <= degree; ++r)
      {
        derivatives[r] = 0;
        if (r > 0)
          derivatives[r] +=
            degree * lower[r - 1] / (knot(span + r) - knot(span + r - degree));
        if (r < degree)
          derivatives[r] -= degree * lower[r] /
                            (knot(span + r + 1) - knot(span + r + 1 - degree));
      }
  }



  double SplineLine::greville_place(const int i) const
  {
    double sum = 0;
    for (int k = 1; k <= degree; ++k)
      sum += knot(i + k);
    return sum / degree;
  }



  int SplineLine::refine(const SplineLine &coarse,
                         const int         i,
                         int              &first,
                         double           *weights) const
  {
    const int coarse_cell = knot(i) / 2;
    double    places[max_degree], all[max_degree + 1];
    for (int k = 1; k <= degree; ++k)
      places[k - 1] = knot(i + k);
    recurse(coarse, 2, coarse_cell + degree, degree, places, all);

    int begin = 0, end = degree + 1;
    while (all[begin] == 0)
      ++begin;
    while (all[end - 1] == 0)
      --end;
    first = coarse_cell + begin;
    for (int r = begin; r < end; ++r)
      weights[r - begin] = all[r];
    return end - begin;
  }
} // namespace Impoint
