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
      if (normal_only)
        normal[0] = 1.;
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



    template <int dim>
    void GapPatch<dim>::add_part(const GapPatch                  &part,
                                 const std::vector<unsigned int> &places)
    {
      if (part.area == 0 || part.nearest > reach)
        return;
      if (nearest > part.reach)
        *this = GapPatch(normal_only, n_nodes);
      if (part.nearest < nearest)
        {
          nearest = part.nearest;
          reach   = part.reach;
        }
      area += part.area;
      start_gap += part.area * part.start_gap;
      multiplier += part.area * part.multiplier;
      normal += part.area * part.normal;
      for (unsigned int a = 0; a < part.n_nodes; ++a)
        {
          values[places[a]] += part.area * part.values[a];
          rows[places[a]] += part.area * part.rows[a];
        }
    }



    template <int dim>
    void GapPatch<dim>::divide_by_area()
    {
      start_gap /= area;
      multiplier /= area;
      normal /= normal.norm();
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          values[a] /= area;
          rows[a] /= area;
        }
    }



    template <int dim>
    void GapPatch<dim>::pack(std::vector<double> &numbers) const
    {
      numbers.insert(numbers.end(), {area, nearest, reach});
      for (unsigned int d = 0; d < dim; ++d)
        {
          numbers.push_back(start_gap[d]);
          numbers.push_back(multiplier[d]);
          numbers.push_back(normal[d]);
        }
      for (unsigned int a = 0; a < n_nodes; ++a)
        if (normal_only)
          numbers.insert(numbers.end(), rows[a].begin_raw(), rows[a].end_raw());
        else
          numbers.push_back(values[a]);
    }



    template <int dim>
    const double *GapPatch<dim>::unpack(const double *numbers)
    {
      area    = *numbers++;
      nearest = *numbers++;
      reach   = *numbers++;
      for (unsigned int d = 0; d < dim; ++d)
        {
          start_gap[d]  = *numbers++;
          multiplier[d] = *numbers++;
          normal[d]     = *numbers++;
        }
      for (unsigned int a = 0; a < n_nodes; ++a)
        if (normal_only)
          for (unsigned int d = 0; d < dim; ++d)
            rows[a][d] = *numbers++;
        else
          values[a] = *numbers++;
      return numbers;
    }

    template struct GapPatch<2>;
    template struct GapPatch<3>;
  } // namespace Enforcement
} // namespace Impoint
