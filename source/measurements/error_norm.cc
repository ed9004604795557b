#include <impoint/measurements/error_norm.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace Measurements
  {
    ErrorNorm::ErrorNorm(const std::string               &kind,
                         const double                     scale,
                         const std::vector<double>       &weights,
                         const std::vector<unsigned int> &wanted)
      : mean(kind == "volume mean")
      , maximum(kind == "maximum")
      , scale(scale)
      , weights(weights)
      , wanted(wanted)
      , sums(2 * wanted.size() + 2, 0.)
    {}



    double ErrorNorm::norm(const double      *values,
                           const unsigned int component) const
    {
      if (component != whole)
        return std::abs(values[component]);
      double square = 0;
      for (unsigned int k = 0; k < weights.size(); ++k)
        square += weights[k] * values[k] * values[k];
      return std::sqrt(square);
    }



    // Round-off in an expression must not make a zero relative.
    double ErrorNorm::denominator(const double exact,
                                  const double exact_whole) const
    {
      const double relative = exact > 1e-12 * exact_whole ? exact : exact_whole;
      return scale > 0 ? scale : (relative > 0 ? relative : 1.);
    }



    void ErrorNorm::add(const double *values,
                        const double *exact,
                        const double  volume)
    {
      std::vector<double> difference(values, values + weights.size());
      for (unsigned int k = 0; k < weights.size(); ++k)
        difference[k] -= exact[k];

      const double exact_whole = norm(exact, whole);
      const auto   put = [&](const unsigned int at, const double value) {
        if (maximum)
          sums[at] = std::max(sums[at], value);
        else
          sums[at] += volume * (mean ? value : value * value);
      };
      const unsigned int n = wanted.size();
      for (unsigned int i = 0; i < n; ++i)
        {
          const double error       = norm(difference.data(), wanted[i]);
          const double exact_value = norm(exact, wanted[i]);
          put(i, mean ? error / denominator(exact_value, exact_whole) : error);
          put(n + i, exact_value);
        }
      put(2 * n, exact_whole);
      sums[2 * n + 1] += volume;
    }



    std::vector<double> ErrorNorm::errors(const MPI_Comm communicator) const
    {
      std::vector<double> total = sums;
      if (maximum)
        Utilities::MPI::max(sums, communicator, total);
      else
        Utilities::MPI::sum(sums, communicator, total);

      const unsigned int n      = wanted.size();
      const double       volume = total[2 * n + 1];
      const auto         value  = [&](const unsigned int at) {
        return maximum ? total[at] : std::sqrt(total[at] / volume);
      };
      std::vector<double> result;
      for (unsigned int i = 0; i < n; ++i)
        result.push_back(mean ?
                           total[i] / volume :
                           value(i) / denominator(value(n + i), value(2 * n)));
      return result;
    }
  } // namespace Measurements
} // namespace Impoint
