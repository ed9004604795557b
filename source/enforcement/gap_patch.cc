#include <impoint/enforcement/gap_patch.h>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    GapPatch<dim>::GapPatch(const bool normal_only, const unsigned int n_nodes)
      : normal_only(normal_only)
      , n_nodes(n_nodes)
      , values(n_nodes, 0.)
      , rows(n_nodes)
    {
      Assert(n_nodes <= largest_support, ExcInternalError());
    }



    template <int dim>
    Tensor<1, dim> GapPatch<dim>::gap(const double *u) const
    {
      Tensor<1, dim> result = start_gap;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          if (normal_only)
            result[0] += rows[a][d] * u[a * dim + d];
          else
            result[d] += values[a] * u[a * dim + d];
      return result;
    }



    template <int dim>
    Tensor<1, dim> GapPatch<dim>::trial(const double *u) const
    {
      const Tensor<1, dim> t = law.gamma * gap(u);
      return law.augmented ?
               (multiplier + t) / (1. + law.gamma * law.compliance) :
               t;
    }



    template <int dim>
    typename GapPatch<dim>::Answer
    GapPatch<dim>::answer(const Contact &contact) const
    {
      Answer result;
      result.traction = contact.trial;
      result.slope    = law.cut(contact.touch, normal, result.traction);
      return result;
    }



    template <int dim>
    void GapPatch<dim>::add_force(const Tensor<1, dim> &traction,
                                  CellSystem           &system) const
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          system.residual[a * dim + d] +=
            area *
            (normal_only ? rows[a][d] * traction[0] : values[a] * traction[d]);
    }



    template <int dim>
    void GapPatch<dim>::add_stiffness(const Tensor<2, dim> &stiffness,
                                      CellSystem           &system) const
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes; ++b)
          {
            double *block = system.matrix + (a * n_nodes + b) * dim * dim;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                block[i * dim + j] +=
                  area * (normal_only ?
                            rows[a][i] * stiffness[0][0] * rows[b][j] :
                            values[a] * stiffness[i][j] * values[b]);
          }
    }



    template <int dim>
    Tensor<1, dim> GapPatch<dim>::total(const Tensor<1, dim> &traction) const
    {
      Tensor<1, dim> sum;
      for (unsigned int a = 0; a < n_nodes; ++a)
        sum += normal_only ? traction[0] * rows[a] : values[a] * traction;
      return sum;
    }

    template struct GapPatch<2>;
    template struct GapPatch<3>;
  } // namespace Enforcement
} // namespace Impoint
