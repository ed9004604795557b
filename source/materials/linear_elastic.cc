#include <impoint/materials/linear_elastic.h>

namespace Impoint
{
  namespace Materials
  {
    template <int dim>
    LinearElastic<dim>::LinearElastic(const ElasticModuli &moduli)
      : moduli(moduli)
    {
      set_elastic_matrix<dim>(moduli.lambda, moduli.mu, tangent);
    }



    template <int dim>
    void LinearElastic<dim>::respond(const Deformation<dim> &deformation,
                                     const double * /*old_history*/,
                                     double * /*history*/,
                                     const bool     tangent_wanted,
                                     Response<dim> &response) const
    {
      const VoigtVector<dim> strain =
        engineering_strain<dim>(deformation.grad_increment);
      const double pressure = moduli.lambda * voigt_trace<dim>(strain);

      for (int k = 0; k < Voigt<dim>::n; ++k)
        response.stress[k] = deformation.old_stress[k] +
                             (k < dim ? pressure + 2 * moduli.mu * strain[k] :
                                        moduli.mu * strain[k]);
      response.stress_zz = deformation.old_stress_zz + pressure;

      if (tangent_wanted)
        response.tangent = tangent;
    }



    // of the strain that the stress stands for, as the total strain isn't kept
    template <int dim>
    double LinearElastic<dim>::energy(const Deformation<dim> & /*deformation*/,
                                      const Response<dim> &response) const
    {
      const double zz     = dim == 2 ? response.stress_zz : 0;
      const double trace  = voigt_trace<dim>(response.stress) + zz;
      const double square = voigt_square<dim>(response.stress) + zz * zz;
      return (square - trace * trace / 3) / (4 * moduli.mu) +
             trace * trace / (18 * moduli.bulk);
    }
  } // namespace Materials
} // namespace Impoint

template class Impoint::Materials::LinearElastic<2>;
template class Impoint::Materials::LinearElastic<3>;
