#ifndef impoint_terms_internal_force_h
#define impoint_terms_internal_force_h

#include <impoint/particles/material_points.h>
#include <impoint/terms/term.h>

namespace Impoint
{
  /**
   * Stress of the material points: first term of the residual P Eq. 15 and the
   * first two of the tangent P Eq. 16, written with the Kirchhoff stress and
   * the initial volume: v_p sigma = V_p tau.
   */
  template <int dim>
  class InternalForce : public Term<dim>
  {
  public:
    /** @p end_states, if not null, receives what each evaluation finds. */
    explicit InternalForce(const MaterialPoints<dim> &points,
                           EndStates<dim>            *end_states = nullptr);

    void add(const unsigned int k, CellSystem &system) const override;

  private:
    template <int n_static, bool symmetric>
    void add_cell(const unsigned int k, CellSystem &system) const;

    template <int n_static>
    void add_constant(const unsigned int k, CellSystem &system) const;

    bool one_constant_tangent(const unsigned int k) const;

    void store_place(const unsigned int p, const int n, const double *u) const;

    void respond(const unsigned int           p,
                 const Tensor<2, dim>        &grad_u,
                 const bool                   tangent_wanted,
                 Materials::Deformation<dim> &deformation,
                 Materials::Response<dim>    &response) const;

    const MaterialPoints<dim> &points;
    EndStates<dim>            *end_states;
  };
} // namespace Impoint

#endif
