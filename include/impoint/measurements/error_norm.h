#ifndef impoint_measurements_error_norm_h
#define impoint_measurements_error_norm_h

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

namespace Impoint
{
  namespace Measurements
  {
    using namespace dealii;

    /**
     * Error of many vectors or tensors, each with a volume, against exact ones.
     *
     * "volume mean": sum V |a - exact| / |exact| / sum V (I Eqs. 29-30); "L2":
     * root of sum V |a - exact|^2 over that of sum V |exact|^2; "maximum":
     * largest |a - exact| over largest |exact|. A component whose exact value
     * is zero is divided by the norm of all components; where that is zero, by
     * one. A scale that is not zero takes the place of exact values.
     */
    class ErrorNorm
    {
    public:
      /** An error of all components instead of one. */
      static constexpr unsigned int whole = static_cast<unsigned int>(-1);

      /**
       * @p weights: of the components' squares in the norm of all; @p wanted:
       * components (or whole) of which the error is asked.
       */
      ErrorNorm(const std::string               &kind,
                const double                     scale,
                const std::vector<double>       &weights,
                const std::vector<unsigned int> &wanted);

      void add(const double *values, const double *exact, const double volume);

      /** The errors wanted, of all ranks. Collective. */
      std::vector<double> errors(const MPI_Comm communicator) const;

    private:
      double norm(const double *values, const unsigned int component) const;
      double denominator(const double exact, const double exact_whole) const;

      const bool                mean, maximum;
      const double              scale;
      std::vector<double>       weights;
      std::vector<unsigned int> wanted;

      // n wanted errors, n exact values, exact value of the whole, volume
      std::vector<double> sums;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
