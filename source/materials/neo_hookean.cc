#include <impoint/materials/neo_hookean.h>

#include <cmath>

namespace Impoint
{
  namespace Materials
  {
    template <int dim>
    NeoHookean<dim>::NeoHookean(const ElasticModuli &moduli)
      : moduli(moduli)
    {}



    template <int dim>
    void NeoHookean<dim>::respond(const Deformation<dim> &deformation,
                                  const double * /*old_history*/,
                                  double * /*history*/,
                                  const bool     tangent_wanted,
                                  Response<dim> &response) const
    {
      const Tensor<2, dim>   H      = displacement_gradient(deformation.F);
      const VoigtVector<dim> strain = left_strain(H);
      const double pressure = moduli.lambda * log_one_plus(volume_change(H));

      for (int k = 0; k < Voigt<dim>::n; ++k)
        response.stress[k] = moduli.mu * strain[k] + (k < dim ? pressure : 0);
      response.stress_zz = pressure;

      if (tangent_wanted)
        set_elastic_matrix<dim>(moduli.lambda,
                                moduli.mu - pressure,
                                response.tangent);
    }



    template <int dim>
    double NeoHookean<dim>::energy(const Deformation<dim> &deformation,
                                   const Response<dim> & /*response*/) const
    {
      const Tensor<2, dim> H          = displacement_gradient(deformation.F);
      const double         log_volume = log_one_plus(volume_change(H));
      return 0.5 * moduli.mu *
               (voigt_trace<dim>(left_strain(H)) - 2 * log_volume) +
             0.5 * moduli.lambda * log_volume * log_volume;
    }
  } // namespace Materials
} // namespace Impoint

template class Impoint::Materials::NeoHookean<2>;
template class Impoint::Materials::NeoHookean<3>;
