#ifndef impoint_materials_elastic_moduli_h
#define impoint_materials_elastic_moduli_h

#include <impoint/base/tensor_functions.h>

namespace Impoint
{
  namespace Materials
  {
    /** The constants of isotropic elasticity [Pa]. */
    struct ElasticModuli
    {
      /** @p young > 0 [Pa], -1 < @p poisson < 1/2. */
      ElasticModuli(const double young, const double poisson)
        : young(young)
        , lambda(young * poisson / ((1 + poisson) * (1 - 2 * poisson)))
        , mu(young / (2 * (1 + poisson)))
        , bulk(young / (3 * (1 - 2 * poisson)))
      {}

      double young;
      double lambda;
      double mu;
      double bulk;
    };

    /** Sets @p matrix to lambda 1 x 1 + 2 mu I: stress from engineering strain.
     * In place, as a copy takes longer than the rest of a neo-Hookean point. */
    template <int dim>
    inline void set_elastic_matrix(const double      lambda,
                                   const double      mu,
                                   VoigtMatrix<dim> &matrix)
    {
      constexpr int n = Voigt<dim>::n;
      matrix.fill(0);
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          matrix[i * n + j] = i == j ? lambda + 2 * mu : lambda;
      for (int k = dim; k < n; ++k)
        matrix[k * n + k] = mu;
    }
  } // namespace Materials
} // namespace Impoint

#endif
