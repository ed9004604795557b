#include <impoint/base/exceptions.h>
#include <impoint/materials/hencky.h>

#include <cmath>

namespace Impoint
{
  namespace Materials
  {
    template <int dim>
    Hencky<dim>::Hencky(const ElasticModuli &moduli)
      : moduli(moduli)
    {}



    template <int dim>
    void Hencky<dim>::respond(const Deformation<dim> &deformation,
                              const double * /*old_history*/,
                              double * /*history*/,
                              const bool     tangent_wanted,
                              Response<dim> &response) const
    {
      const Tensor<2, dim> H = displacement_gradient(deformation.F);
      const double pressure  = moduli.lambda * log_one_plus(volume_change(H));

      // b - 1 instead of b: relative accuracy for small strains as well
      const Spectrum<dim>     b_minus_one = spectrum<dim>(left_strain(H));
      std::array<double, dim> tau;
      for (int a = 0; a < dim; ++a)
        {
          if (!(b_minus_one.values[a] > -1))
            throw StepFailed("a principal stretch of a material point is zero "
                             "to round-off");
          tau[a] = pressure + moduli.mu * log_one_plus(b_minus_one.values[a]);
        }

      response.stress    = from_principal<dim>(tau, b_minus_one.directions);
      response.stress_zz = pressure;
      if (tangent_wanted)
        response.tangent = tangent(b_minus_one, tau);
    }



    // c_abab = (tau_a b_b - tau_b b_a) / (b_a - b_b). With tau_a - tau_b =
    // mu ln (b_a / b_b) and x = b_a / b_b - 1 it is mu ln(1 + x) / x - tau_b,
    // which needs no distance between b_a and b_b.
    template <int dim>
    VoigtMatrix<dim>
    Hencky<dim>::tangent(const Spectrum<dim>           &b_minus_one,
                         const std::array<double, dim> &tau) const
    {
      std::array<std::array<double, dim>, dim> normal;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          normal[a][b] =
            moduli.lambda + (a == b ? 2 * (moduli.mu - tau[a]) : 0);

      std::array<double, Voigt<dim>::n - dim> shear;
      for (int k = dim; k < Voigt<dim>::n; ++k)
        {
          const int    a = Voigt<dim>::row(k), b = Voigt<dim>::column(k);
          const double difference =
            b_minus_one.values[a] - b_minus_one.values[b];
          shear[k - dim] =
            moduli.mu *
              log1p_quotient(difference / (1 + b_minus_one.values[b])) -
            tau[b];
        }
      return from_principal<dim>(normal, shear, b_minus_one.directions);
    }



    // from F: the stress may hold a prescribed initial part
    template <int dim>
    double Hencky<dim>::energy(const Deformation<dim> &deformation,
                               const Response<dim> & /*response*/) const
    {
      const Tensor<2, dim> H          = displacement_gradient(deformation.F);
      const double         log_volume = log_one_plus(volume_change(H));

      double shear = 0;
      for (const double excess : spectrum<dim>(left_strain(H)).values)
        shear += log_one_plus(excess) * log_one_plus(excess) / 4;
      return 0.5 * moduli.lambda * log_volume * log_volume + moduli.mu * shear;
    }
  } // namespace Materials
} // namespace Impoint

template class Impoint::Materials::Hencky<2>;
template class Impoint::Materials::Hencky<3>;
