#include <impoint/base/exceptions.h>
#include <impoint/materials/elastoplastic.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace Materials
  {
    double Softening::strength(const double plastic_strain) const
    {
      return residual == 1 ?
               1 :
               residual + (1 - residual) * std::exp(-plastic_strain / strain);
    }



    template <int dim>
    Elastoplastic<dim>::Elastoplastic(
      const ElasticModuli                &moduli,
      std::unique_ptr<const YieldSurface> surface,
      const Softening                    &softening,
      const bool                          closes_gaps)
      : moduli(moduli)
      , surface(std::move(surface))
      , softening(softening)
      , closes_gaps(closes_gaps)
    {}



    namespace
    {
      double volume_strain(const std::array<double, 3> &strain)
      {
        return strain[0] + strain[1] + strain[2];
      }



      /** Principal stresses; in 2D the third is that out of plane. */
      template <int dim>
      std::array<double, 3>
      three_values(const std::array<double, dim> &in_plane, const double zz)
      {
        std::array<double, 3> values = {{0, 0, zz}};
        for (int a = 0; a < dim; ++a)
          values[a] = in_plane[a];
        return values;
      }
    } // namespace



    template <int dim>
    void Elastoplastic<dim>::initialise(const Response<dim> &initial,
                                        double              *history) const
    {
      const Spectrum<dim> stress = spectrum<dim>(initial.stress);
      const auto          elastic =
        elastic_strain(moduli,
                       three_values<dim>(stress.values, initial.stress_zz));
      history[n_elastic] = history[n_elastic + 1] = 0;
      store(elastic, elastic, stress.directions, history);
    }



    // b = f b_n f^T with f = 1 + G, less 1: G + G^T + G G^T + f (b_n - 1) f^T
    template <int dim>
    VoigtVector<dim>
    Elastoplastic<dim>::trial_b(const Tensor<2, dim> &grad_increment,
                                const double         *old_history) const
    {
      VoigtVector<dim> old;
      for (int k = 0; k < Voigt<dim>::n; ++k)
        old[k] = old_history[k];
      Tensor<2, dim> f = grad_increment;
      for (int i = 0; i < dim; ++i)
        f[i][i] += 1;
      const Tensor<2, dim> f_b = f * to_tensor<dim>(old);

      VoigtVector<dim> result = left_strain(grad_increment);
      for (int k = 0; k < Voigt<dim>::n; ++k)
        result[k] += f_b[Voigt<dim>::row(k)] * f[Voigt<dim>::column(k)];
      return result;
    }



    template <int dim>
    std::array<double, 3>
    Elastoplastic<dim>::trial_strain(const Spectrum<dim> &b_minus_one,
                                     const double         b_zz_minus_one) const
    {
      std::array<double, 3> strain =
        three_values<dim>(b_minus_one.values, b_zz_minus_one);
      for (double &value : strain)
        {
          if (!(value > -1))
            throw StepFailed("a principal stretch of a material point is zero "
                             "to round-off");
          value = 0.5 * log_one_plus(value);
        }
      return strain;
    }



    template <int dim>
    void Elastoplastic<dim>::store(const std::array<double, 3> &elastic,
                                   const std::array<double, 3> &trial,
                                   const Tensor<2, dim>        &directions,
                                   double                      *history) const
    {
      std::array<double, dim> b_minus_one;
      for (int a = 0; a < dim; ++a)
        b_minus_one[a] = exp_minus_one(2 * elastic[a]);
      const auto b = from_principal<dim>(b_minus_one, directions);
      for (int k = 0; k < Voigt<dim>::n; ++k)
        history[k] = b[k];
      if (dim == 2)
        history[Voigt<dim>::n] = exp_minus_one(2 * elastic[2]);

      const double volume = volume_strain(trial) - volume_strain(elastic);
      double       square = 0;
      for (int a = 0; a < 3; ++a)
        {
          const double deviator = trial[a] - elastic[a] - volume / 3;
          square += deviator * deviator;
        }
      history[n_elastic] += std::sqrt(2. / 3 * square);
    }



    template <int dim>
    void Elastoplastic<dim>::respond(const Deformation<dim> &deformation,
                                     const double           *old_history,
                                     double                 *history,
                                     const bool              tangent_wanted,
                                     Response<dim>          &response) const
    {
      volume_change(deformation.grad_increment); // refuses det f <= 0
      const VoigtVector<dim> b =
        trial_b(deformation.grad_increment, old_history);
      const Spectrum<dim> b_minus_one = spectrum<dim>(b);
      auto                trial =
        trial_strain(b_minus_one, dim == 2 ? old_history[Voigt<dim>::n] : 0.);
      const double opening = old_history[n_elastic + 1];
      for (double &strain : trial)
        strain += opening / 3;

      PrincipalReturn result;
      surface->return_map(trial,
                          softening.strength(old_history[n_elastic]),
                          result);

      std::array<double, dim> in_plane;
      std::copy_n(result.stress.begin(), dim, in_plane.begin());
      response.stress = from_principal<dim>(in_plane, b_minus_one.directions);
      response.stress_zz = dim == 2 ? result.stress[2] : 0.;
      if (tangent_wanted)
        response.tangent = tangent(b_minus_one, result);

      using Region       = PrincipalReturn::Region;
      history[n_elastic] = old_history[n_elastic];
      if (result.region == Region::elastic && opening == 0)
        {
          for (int k = 0; k < Voigt<dim>::n; ++k)
            history[k] = b[k];
          if (dim == 2)
            history[Voigt<dim>::n] = old_history[Voigt<dim>::n];
          history[n_elastic + 1] = 0;
          return;
        }
      const auto elastic = elastic_strain(moduli, result.stress);
      store(elastic, trial, b_minus_one.directions, history);
      history[n_elastic + 1] =
        closes_gaps && result.region == Region::apex ?
          std::max(0., volume_strain(trial) - volume_strain(elastic)) :
          0.;
    }



    // c_aabb = dtau_a/deps_b - 2 tau_a delta_ab and c_abab = (tau_a b_b - tau_b
    // b_a) / (b_a - b_b). With the secant s = (tau_a - tau_b) / (eps_a - eps_b)
    // and x = b_a / b_b - 1 the latter is s/2 ln(1 + x) / x - tau_b, which
    // needs no distance between b_a and b_b.
    template <int dim>
    VoigtMatrix<dim>
    Elastoplastic<dim>::tangent(const Spectrum<dim>   &b_minus_one,
                                const PrincipalReturn &result) const
    {
      std::array<std::array<double, dim>, dim> normal;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          normal[a][b] =
            result.tangent[a][b] - (a == b ? 2 * result.stress[a] : 0);

      std::array<double, Voigt<dim>::n - dim> shear;
      for (int k = dim; k < Voigt<dim>::n; ++k)
        {
          const int    a = Voigt<dim>::row(k), b = Voigt<dim>::column(k);
          const double x = (b_minus_one.values[a] - b_minus_one.values[b]) /
                           (1 + b_minus_one.values[b]);
          shear[k - dim] =
            0.5 * result.secant[pair_of(a, b)] * log1p_quotient(x) -
            result.stress[b];
        }
      return from_principal<dim>(normal, shear, b_minus_one.directions);
    }



    // (1 + nu) / (2 E) tau : tau - nu / (2 E) (tr tau)^2
    template <int dim>
    double Elastoplastic<dim>::energy(const Deformation<dim> & /*deformation*/,
                                      const Response<dim> &response) const
    {
      const double zz     = dim == 2 ? response.stress_zz : 0.;
      const double trace  = voigt_trace<dim>(response.stress) + zz;
      const double square = voigt_square<dim>(response.stress) + zz * zz;
      return square / (4 * moduli.mu) -
             moduli.lambda * trace * trace / (12 * moduli.mu * moduli.bulk);
    }
  } // namespace Materials
} // namespace Impoint

template class Impoint::Materials::Elastoplastic<2>;
template class Impoint::Materials::Elastoplastic<3>;
