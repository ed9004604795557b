#include <impoint/solver/spectrum.h>

#include <deal.II/lac/tridiagonal_matrix.h>

#include <algorithm>
#include <vector>

namespace Impoint
{
  namespace
  {
    double largest_eigenvalue(const std::vector<double> &diagonal,
                              const std::vector<double> &beside)
    {
      TridiagonalMatrix<double> matrix(diagonal.size(), true);
      for (unsigned int i = 0; i < diagonal.size(); ++i)
        {
          matrix(i, i) = diagonal[i];
          if (i > 0)
            matrix(i, i - 1) = beside[i - 1];
        }
      matrix.compute_eigenvalues();
      return matrix.eigenvalue(diagonal.size() - 1);
    }
  } // namespace



  double largest_eigenvalue(
    const std::function<void(const LinearAlgebra::distributed::Vector<double> &,
                             LinearAlgebra::distributed::Vector<double> &)>
                                                     &apply,
    const LinearAlgebra::distributed::Vector<double> &start)
  {
    constexpr unsigned int most_steps = 200, looks_back = 5;
    constexpr double       tolerance = 1e-6;
    using Vector = LinearAlgebra::distributed::Vector<double>;

    std::vector<double> diagonal, beside, found;
    Vector              v(start), last(start), next(start);
    v /= start.l2_norm();
    last = 0.;
    while (diagonal.size() < std::min<std::size_t>(most_steps, start.size()))
      {
        apply(v, next);
        if (!beside.empty())
          next.add(-beside.back(), last);
        diagonal.push_back(next * v);
        next.add(-diagonal.back(), v);
        found.push_back(largest_eigenvalue(diagonal, beside));
        const std::size_t n    = found.size();
        const double      rest = next.l2_norm();
        if (rest <= 1e-14 * found.back() ||
            (n > looks_back && found[n - 1] - found[n - 1 - looks_back] <
                                 tolerance * found[n - 1]))
          break;
        beside.push_back(rest);
        last.swap(v);
        v.equ(1. / rest, next);
      }
    return found.empty() ? 0. : found.back();
  }
} // namespace Impoint
