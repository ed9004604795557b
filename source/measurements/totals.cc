#include <impoint/measurements/named_values.h>
#include <impoint/measurements/totals.h>

#include <cstring>

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
    TotalsSum<dim>::TotalsSum(const MaterialPoints<dim> &points)
      : points(points)
    {}



    template <int dim>
    void TotalsSum<dim>::add(const typename PointCloud<dim>::Range &range)
    {
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          const double mass = points.data(p)[points.slots().mass];
          sums.mass += mass;
          for (unsigned int d = 0; d < dim; ++d)
            sums.centre[d] += mass * points.data(p)[points.slots().x + d];
          sums.strain_energy += strain_energy(p);
        }
      if (points.carried().dynamic)
        for (unsigned int p = range.begin; p < range.end; ++p)
          add_motion(p);
    }



    template <int dim>
    void TotalsSum<dim>::add_motion(const unsigned int p)
    {
      const double        *state    = points.data(p);
      const auto          &slots    = points.slots();
      const Tensor<1, dim> velocity = points.vector(p, slots.v);
      const Tensor<1, dim> momentum = state[slots.mass] * velocity;
      sums.momentum += momentum;
      add_moment(points.vector(p, slots.x), momentum, sums.spin);
      sums.kinetic_energy += 0.5 * (momentum * velocity);
    }



    /** Of the point as it stands. */
    template <int dim>
    double TotalsSum<dim>::strain_energy(const unsigned int p)
    {
      const double *state = points.data(p);
      const auto   &slots = points.slots();
      // at once: the material waits for numbers that are stored one by one
      std::memcpy(deformation.F.begin_raw(),
                  state + slots.F,
                  dim * dim * sizeof(double));
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



    template <int dim>
    Totals<dim> TotalsSum<dim>::of_all_ranks(const MPI_Comm communicator) const
    {
      Totals<dim> totals = sums;
      add_ranks(totals, communicator);
      totals.centre /= totals.mass;
      return totals;
    }



    template <int dim>
    Totals<dim> totals(const MaterialPoints<dim> &points,
                       const MPI_Comm             communicator)
    {
      TotalsSum<dim> sum(points);
      for (const auto &range : points.ranges())
        sum.add(range);
      return sum.of_all_ranks(communicator);
    }



    template class TotalsSum<2>;
    template class TotalsSum<3>;
    template Tensor<1, 3> moment(const Tensor<1, 2> &, const Tensor<1, 2> &);
    template Tensor<1, 3> moment(const Tensor<1, 3> &, const Tensor<1, 3> &);
    template Totals<2>    totals(const MaterialPoints<2> &, const MPI_Comm);
    template Totals<3>    totals(const MaterialPoints<3> &, const MPI_Comm);
  } // namespace Measurements
} // namespace Impoint
