#include <impoint/particles/material_points.h>

#include <algorithm>
#include <cstring>

namespace Impoint
{
  template <int dim>
  MaterialPoints<dim>::Slots::Slots(const CarriedState &carried)
    : x(layout.add("position", dim))
    , u(layout.add("displacement", dim))
    , F(layout.add("deformation gradient", dim * dim))
    , stress(layout.add("stress", Voigt<dim>::n + (dim == 2 ? 1 : 0)))
    , mass(layout.add("mass", 1))
    , volume(layout.add("volume", 1))
    , body(layout.add("body", 1))
    , v(layout.add("velocity", carried.dynamic ? dim : 0))
    , a(layout.add("acceleration", carried.dynamic ? dim : 0))
    , start(layout.add("start", carried.keeps_grid ? dim : 0))
    , initial_stress(layout.add("initial stress",
                                carried.initial_stress ?
                                  Voigt<dim>::n + (dim == 2 ? 1 : 0) :
                                  0))
    , history(layout.add("history", carried.n_history))
  {}



  template <int dim>
  MaterialPoints<dim>::MaterialPoints(
    const Basis<dim>                      &basis,
    const CarriedState                    &carried,
    std::vector<std::shared_ptr<Material>> materials)
    : PointCloud<dim>(basis,
                      Slots(carried).layout,
                      carried.keeps_grid ? Slots(carried).start : 0)
    , slot(carried)
    , carried_state(carried)
    , materials(std::move(materials))
  {
    AssertThrow(carried.n_history <= Materials::max_history,
                ExcIndexRange(carried.n_history,
                              0,
                              Materials::max_history + 1));
    for (const auto &material : this->materials)
      {
        all_small_strain &= material->small_strain();
        all_constant &= material->constant_tangent();
        all_symmetric &= material->symmetric_tangent();
        all_equally_stiff &= material->young() == young();
      }
  }



  template <int dim>
  const Materials::Material<dim> &MaterialPoints<dim>::stiffest_material() const
  {
    return **std::max_element(materials.begin(),
                              materials.end(),
                              [](const auto &a, const auto &b) {
                                return a->young() < b->young();
                              });
  }



  namespace
  {
    // A constant second Piola-Kirchhoff stress has no part in the Lie
    // derivative of the Kirchhoff stress: the tangent stays as it is.
    template <int dim>
    void add_initial_stress(const double             *initial,
                            const Tensor<2, dim>     &F,
                            Materials::Response<dim> &response)
    {
      for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
        {
          const unsigned int i = Voigt<dim>::row(k), j = Voigt<dim>::column(k);
          for (unsigned int l = 0; l < Voigt<dim>::n; ++l)
            {
              const unsigned int r = Voigt<dim>::row(l),
                                 s = Voigt<dim>::column(l);
              response.stress[k] +=
                F[i][r] * initial[l] * F[j][s] +
                (r == s ? 0. : F[i][s] * initial[l] * F[j][r]);
            }
        }
      if constexpr (dim == 2)
        response.stress_zz += initial[Voigt<dim>::n];
    }
  } // namespace



  template <int dim>
  void MaterialPoints<dim>::respond(const unsigned int           p,
                                    const Tensor<2, dim>        &grad_u,
                                    const bool                   tangent_wanted,
                                    Materials::Deformation<dim> &deformation,
                                    Materials::Response<dim>    &response,
                                    double *new_history) const
  {
    const double *state = this->data(p);
    if (carried_state.keeps_grid)
      {
        // grad_u is that by the places at the start of the run
        const Tensor<2, dim> F_old = deformation_gradient(p);
        deformation.F              = F_old + grad_u;
        deformation.grad_increment =
          material(p).small_strain() ? grad_u : grad_u * invert(F_old);
      }
    else
      {
        deformation.grad_increment = grad_u;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            {
              double sum = state[slot.F + i * dim + j];
              for (unsigned int k = 0; k < dim; ++k)
                sum += grad_u[i][k] * state[slot.F + k * dim + j];
              deformation.F[i][j] = sum;
            }
      }
    MaterialState old;
    old.body   = body(p);
    old.stress = state + slot.stress;
    if (carried_state.initial_stress)
      old.initial_stress = state + slot.initial_stress;
    if (carried_state.n_history > 0)
      old.history = state + slot.history;
    respond(old, tangent_wanted, deformation, response, new_history);
  }



  template <int dim>
  void MaterialPoints<dim>::respond(const MaterialState         &old,
                                    const bool                   tangent_wanted,
                                    Materials::Deformation<dim> &deformation,
                                    Materials::Response<dim>    &response,
                                    double *new_history) const
  {
    for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
      deformation.old_stress[k] = old.stress[k];
    if constexpr (dim == 2)
      deformation.old_stress_zz = old.stress[Voigt<dim>::n];

    const Material &material = material_of_body(old.body);
    material.respond(
      deformation, old.history, new_history, tangent_wanted, response);

    if (old.initial_stress != nullptr && !material.starts_from_stress())
      add_initial_stress<dim>(old.initial_stress, deformation.F, response);
  }



  template <int dim>
  void MaterialPoints<dim>::set_end_state(const unsigned int p,
                                          const double      *end_state)
  {
    constexpr unsigned int n_fixed = EndStates<dim>::n_fixed;
    double                *state   = this->data(p);
    AssertDimension(slot.stress, slot.F + dim * dim);
    std::memcpy(state + slot.F, end_state, n_fixed * sizeof(double));
    for (unsigned int i = 0; i < carried_state.n_history; ++i)
      state[slot.history + i] = end_state[n_fixed + i];
  }

  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace Impoint
