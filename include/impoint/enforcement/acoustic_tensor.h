#ifndef impoint_enforcement_acoustic_tensor_h
#define impoint_enforcement_acoustic_tensor_h

#include <impoint/base/voigt.h>

#include <deal.II/base/tensor.h>

namespace Impoint
{
  namespace Enforcement
  {
    using namespace dealii;

    /** (v.C.w)_ij = v_k C_kilj w_l; with v = w a normal the stiffness of
     * plane waves along it. */
    template <int dim>
    Tensor<2, dim> acoustic_tensor(const Tensor<1, dim>   &v,
                                   const VoigtMatrix<dim> &C,
                                   const Tensor<1, dim>   &w)
    {
      Tensor<2, dim> result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int l = 0; l < dim; ++l)
              result[i][j] += v[k] *
                              C[Voigt<dim>::position(k, i) * Voigt<dim>::n +
                                Voigt<dim>::position(l, j)] *
                              w[l];
      return result;
    }
  } // namespace Enforcement
} // namespace Impoint

#endif
