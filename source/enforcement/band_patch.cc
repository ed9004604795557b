#include <impoint/enforcement/band_patch.h>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      template <int dim>
      Tensor<1, dim> of_node(const double *u, const unsigned int a)
      {
        Tensor<1, dim> u_a;
        for (unsigned int d = 0; d < dim; ++d)
          u_a[d] = u[a * dim + d];
        return u_a;
      }
    } // namespace



    template <int dim>
    BandPatch<dim>::BandPatch(const unsigned int n_nodes)
      : n_nodes(n_nodes)
      , share(n_nodes)
      , flux(n_nodes)
    {}



    template <int dim>
    Tensor<1, dim> BandPatch<dim>::gap(const double *u) const
    {
      Tensor<1, dim> result = start_gap;
      for (unsigned int a = 0; a < n_nodes; ++a)
        result += share[a] * of_node<dim>(u, a);
      return result;
    }



    template <int dim>
    Tensor<1, dim> BandPatch<dim>::traction(const double *u) const
    {
      Tensor<1, dim> result = start_traction + stiffness * gap(u);
      for (unsigned int a = 0; a < n_nodes; ++a)
        result += flux[a] * of_node<dim>(u, a);
      return result;
    }



    template <int dim>
    void BandPatch<dim>::add(const double part,
                             const bool   with_flux,
                             CellSystem  &system) const
    {
      const Tensor<1, dim> t = traction(system.u), g = gap(system.u);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const Tensor<1, dim> force =
            area * (transpose(share[a]) * t + transpose(flux[a]) * g);
          for (unsigned int d = 0; d < dim; ++d)
            system.residual[a * dim + d] += force[d];
        }
      if (system.matrix == nullptr)
        return;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int c = 0; c < n_nodes; ++c)
          {
            Tensor<2, dim> block =
              part * transpose(share[a]) * stiffness * share[c];
            if (with_flux)
              block +=
                transpose(share[a]) * flux[c] + transpose(flux[a]) * share[c];
            double *to = system.matrix + (a * n_nodes + c) * dim * dim;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                to[i * dim + j] += area * block[i][j];
          }
    }



    template <int dim>
    Tensor<1, dim> BandPatch<dim>::total(const Tensor<1, dim> &t) const
    {
      Tensor<1, dim> sum;
      for (unsigned int a = 0; a < n_nodes; ++a)
        sum += transpose(share[a]) * t;
      return sum;
    }



    template <int dim>
    void BandPatch<dim>::add_part(const BandPatch                 &part,
                                  const std::vector<unsigned int> &places)
    {
      area += part.area;
      start_gap += part.area * part.start_gap;
      start_traction += part.area * part.start_traction;
      stiffness += part.area * part.stiffness;
      for (unsigned int a = 0; a < part.n_nodes; ++a)
        {
          share[places[a]] += part.area * part.share[a];
          flux[places[a]] += part.area * part.flux[a];
        }
    }



    template <int dim>
    void BandPatch<dim>::divide_by_area()
    {
      start_gap /= area;
      start_traction /= area;
      stiffness /= area;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          share[a] /= area;
          flux[a] /= area;
        }
    }



    template <int dim>
    void BandPatch<dim>::pack(std::vector<double> &numbers) const
    {
      const auto append = [&](const auto &tensor) {
        numbers.insert(numbers.end(), tensor.begin_raw(), tensor.end_raw());
      };
      numbers.push_back(area);
      append(start_gap);
      append(start_traction);
      append(stiffness);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          append(share[a]);
          append(flux[a]);
        }
    }



    template <int dim>
    const double *BandPatch<dim>::unpack(const double *numbers)
    {
      const auto take = [&](auto &tensor) {
        for (auto entry = tensor.begin_raw(); entry != tensor.end_raw();
             ++entry)
          *entry = *numbers++;
      };
      area = *numbers++;
      take(start_gap);
      take(start_traction);
      take(stiffness);
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          take(share[a]);
          take(flux[a]);
        }
      return numbers;
    }

    template struct BandPatch<2>;
    template struct BandPatch<3>;
  } // namespace Enforcement
} // namespace Impoint
