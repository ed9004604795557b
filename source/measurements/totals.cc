#include <impoint/measurements/named_values.h>
#include <impoint/measurements/totals.h>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      /** Per initial volume, S0 : E: the potential of the initial stress that
       * MaterialPoints::respond() adds. */
      template <int dim>
      double initial_stress_energy(const MaterialPoints<dim> &points,
                                   const unsigned int         p)
      {
        const Tensor<2, dim> F = points.deformation_gradient(p);
        const Tensor<2, dim> E =
          0.5 * (transpose(F) * F - unit_symmetric_tensor<dim>());
        double energy = 0;
        for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
          {
            const unsigned int i = Voigt<dim>::row(k),
                               j = Voigt<dim>::column(k);
            energy += (i == j ? 1. : 2.) * E[i][j] *
                      points.data(p)[points.slots().initial_stress + k];
          }
        return energy;
      }



      /** Strain energy of points as they stand. */
      template <int dim>
      class StrainEnergy
      {
      public:
        explicit StrainEnergy(const MaterialPoints<dim> &points)
          : points(points)
          , slots(points.slots())
        {}

        double operator()(const unsigned int p)
        {
          const double *state = points.data(p);
          for (unsigned int i = 0; i < dim * dim; ++i)
            deformation.F[i / dim][i % dim] = state[slots.F + i];
          for (int k = 0; k < Voigt<dim>::n; ++k)
            response.stress[k] = state[slots.stress + k];
          if constexpr (dim == 2)
            response.stress_zz = state[slots.stress + Voigt<dim>::n];
          double density = points.material(p).energy(deformation, response);
          if (points.carried().initial_stress &&
              !points.material(p).starts_from_stress())
            density += initial_stress_energy(points, p);
          return state[slots.volume] * density;
        }

      private:
        const MaterialPoints<dim>                 &points;
        const typename MaterialPoints<dim>::Slots &slots;
        Materials::Deformation<dim>                deformation;
        Materials::Response<dim>                   response;
      };



      /** Of dim 2 the z component only. */
      template <int dim>
      void add_moment(const Tensor<1, dim> &arm,
                      const Tensor<1, dim> &force,
                      Tensor<1, 3>         &sum)
      {
        for (unsigned int i = dim == 2 ? 2 : 0; i < 3; ++i)
          {
            const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
            sum[i] += arm[j] * force[k] - arm[k] * force[j];
          }
      }



      /** Adds what the other ranks have. */
      template <int dim>
      void add_ranks(Totals<dim> &totals, const MPI_Comm communicator)
      {
        std::vector<double *> numbers = {&totals.mass,
                                         &totals.kinetic_energy,
                                         &totals.strain_energy};
        for (unsigned int d = 0; d < dim; ++d)
          {
            numbers.push_back(&totals.centre[d]);
            numbers.push_back(&totals.momentum[d]);
          }
        for (unsigned int d = 0; d < 3; ++d)
          numbers.push_back(&totals.spin[d]);

        std::vector<double> sums;
        for (const double *number : numbers)
          sums.push_back(*number);
        sum_over_ranks(sums, communicator);
        for (unsigned int i = 0; i < sums.size(); ++i)
          *numbers[i] = sums[i];
      }
    } // namespace



    template <int dim>
    Tensor<1, 3> moment(const Tensor<1, dim> &arm, const Tensor<1, dim> &force)
    {
      Tensor<1, 3> product;
      add_moment(arm, force, product);
      return product;
    }



    template <int dim>
    Totals<dim> totals(const MaterialPoints<dim> &points,
                       const MPI_Comm             communicator)
    {
      const auto       &slots   = points.slots();
      const bool        dynamic = points.carried().dynamic;
      Totals<dim>       sums;
      StrainEnergy<dim> strain_energy(points);
      for (unsigned int p = 0; p < points.n(); ++p)
        {
          const double         mass = points.data(p)[slots.mass];
          const Tensor<1, dim> place(points.position(p));
          sums.mass += mass;
          sums.centre += mass * place;
          sums.strain_energy += strain_energy(p);
          if (!dynamic)
            continue;
          const Tensor<1, dim> velocity = points.vector(p, slots.v);
          const Tensor<1, dim> momentum = mass * velocity;
          sums.momentum += momentum;
          add_moment(place, momentum, sums.spin);
          sums.kinetic_energy += 0.5 * (momentum * velocity);
        }
      add_ranks(sums, communicator);
      sums.centre /= sums.mass;
      return sums;
    }



    template Tensor<1, 3> moment(const Tensor<1, 2> &, const Tensor<1, 2> &);
    template Tensor<1, 3> moment(const Tensor<1, 3> &, const Tensor<1, 3> &);
    template Totals<2>    totals(const MaterialPoints<2> &, const MPI_Comm);
    template Totals<3>    totals(const MaterialPoints<3> &, const MPI_Comm);
  } // namespace Measurements
} // namespace Impoint
