#include <impoint/materials/st_venant_kirchhoff.h>

namespace Impoint
{
  namespace Materials
  {
    template <int dim>
    StVenantKirchhoff<dim>::StVenantKirchhoff(const ElasticModuli &moduli)
      : moduli(moduli)
    {}



    // F S F^T written in b alone: lambda tr E b + mu (b - 1) b
    template <int dim>
    void StVenantKirchhoff<dim>::respond(const Deformation<dim> &deformation,
                                         const double * /*old_history*/,
                                         double * /*history*/,
                                         const bool     tangent_wanted,
                                         Response<dim> &response) const
    {
      constexpr int        n = Voigt<dim>::n;
      const Tensor<2, dim> H = displacement_gradient(deformation.F);
      volume_change(H); // refuses det F <= 0, which this law doesn't notice

      const VoigtVector<dim> strain = left_strain(H);
      const Tensor<2, dim>   excess = to_tensor<dim>(strain);
      Tensor<2, dim>         b      = excess;
      for (int i = 0; i < dim; ++i)
        b[i][i] += 1;
      const double pressure = 0.5 * moduli.lambda * voigt_trace<dim>(strain);

      for (int k = 0; k < n; ++k)
        {
          const int i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
          response.stress[k] =
            pressure * b[i][j] + moduli.mu * (excess[i] * b[j]);
        }
      response.stress_zz = pressure;

      if (!tangent_wanted)
        return;

      // F_iI F_jJ F_kK F_lL C_IJKL
      for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column)
          {
            const int i = Voigt<dim>::row(row), j = Voigt<dim>::column(row);
            const int k = Voigt<dim>::row(column),
                      l = Voigt<dim>::column(column);
            response.tangent[row * n + column] =
              moduli.lambda * b[i][j] * b[k][l] +
              moduli.mu * (b[i][k] * b[j][l] + b[i][l] * b[j][k]);
          }
    }



    template <int dim>
    double
    StVenantKirchhoff<dim>::energy(const Deformation<dim> &deformation,
                                   const Response<dim> & /*response*/) const
    {
      // powers of E have the traces of powers of (b - 1)/2
      const VoigtVector<dim> strain =
        left_strain(displacement_gradient(deformation.F));
      const double trace = voigt_trace<dim>(strain);
      return 0.125 * moduli.lambda * trace * trace +
             0.25 * moduli.mu * voigt_square<dim>(strain);
    }
  } // namespace Materials
} // namespace Impoint

template class Impoint::Materials::StVenantKirchhoff<2>;
template class Impoint::Materials::StVenantKirchhoff<3>;
