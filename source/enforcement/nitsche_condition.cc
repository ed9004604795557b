#include <impoint/base/tensor_functions.h>
#include <impoint/enforcement/acoustic_tensor.h>
#include <impoint/enforcement/nitsche.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // In cell sizes: no sliver of material is taken for thinner. With a
      // ghost penalty neighbours hold it, too: its factor takes this part.
      constexpr double smallest_width = 1e-13;
    } // namespace



    /** Of n.C.n/h. That of a trace inequality grows with the square of the
     * degree. */
    template <int dim>
    double Nitsche<dim>::factor() const
    {
      const double degree = this->current.active->basis().degree();
      return this->condition.nitsche_factor > 0 ?
               this->condition.nitsche_factor :
               std::max(10., 5. * degree * degree);
    }



    template <int dim>
    MaterialState Nitsche<dim>::material(const unsigned int b) const
    {
      const auto   &slots   = this->boundary->slots();
      const auto   &carried = this->boundary->carried();
      const double *state   = this->boundary->data(b);
      MaterialState result;
      result.body   = static_cast<unsigned int>(state[slots.body]);
      result.F      = state + slots.F;
      result.stress = state + slots.stress;
      if (carried.initial_stress)
        result.initial_stress = state + slots.initial_stress;
      if (carried.n_history > 0)
        result.history = state + slots.history;
      return result;
    }



    template <int dim>
    Tensor<2, dim>
    Nitsche<dim>::deformation_gradient(const unsigned int b) const
    {
      const double  *entry = material(b).F;
      Tensor<2, dim> F;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          F[i][j] = *entry++;
      return F;
    }



    /** F and, of finite strains, gradients by the places at the start of the
     * run. */
    template <int dim>
    void Nitsche<dim>::deform(const unsigned int b,
                              const unsigned int n,
                              const double      *u,
                              Condition         &condition) const
    {
      const auto          &points    = *this->current.points;
      const auto           material  = this->material(b);
      const double        *gradients = this->boundary->support(b) + n;
      const Tensor<2, dim> F_old     = deformation_gradient(b);
      condition.finite = !points.material_of_body(material.body).small_strain();
      const bool transforms =
        condition.finite && !this->boundary->carried().keeps_grid;

      auto &nodes = condition.as_is.gradients;
      nodes.resize(n);
      Tensor<2, dim> grad_u;
      for (unsigned int a = 0; a < n; ++a)
        {
          Tensor<1, dim> u_a;
          for (unsigned int d = 0; d < dim; ++d)
            {
              nodes[a][d] = gradients[a * dim + d];
              u_a[d]      = u[a * dim + d];
            }
          if (transforms)
            nodes[a] = nodes[a] * F_old;
          grad_u += outer_product(u_a, nodes[a]);
        }
      auto &deformation = condition.as_is.deformation;
      deformation.F     = F_old + grad_u;
      deformation.grad_increment =
        condition.finite ? grad_u * invert(F_old) : grad_u;
    }



    /** The gap, and how the condition holds it. */
    template <int dim>
    void Nitsche<dim>::evaluate_gap(const unsigned int r,
                                    const unsigned int b,
                                    const unsigned int n,
                                    const double      *u,
                                    Condition         &condition) const
    {
      const auto          &slots  = this->boundary->slots();
      const auto          &active = *this->current.active;
      const unsigned int   cell   = this->boundary->ranges()[r].cell;
      const double        *N      = this->boundary->support(b);
      const auto           nodes  = active.nodes(active.position(cell));
      const Tensor<1, dim> normal = this->boundary->vector(b, slots.normal);
      const Tensor<1, dim> increment =
        this->boundary->vector(b, slots.increment);
      const Tensor<2, dim> one  = unit_symmetric_tensor<dim>();
      const Tensor<2, dim> held = slip ? outer_product(normal, normal) : one;

      // a slip boundary carries its gap along the normal in component 0
      Tensor<1, dim> total = this->boundary->vector(b, slots.gap);
      if (slip)
        total = total[0] * normal;
      condition.gap = total - held * increment;
      condition.share.resize(n);
      for (unsigned int a = 0; a < n; ++a)
        {
          condition.share[a] =
            N[a] *
            (slip ?
               outer_product(normal,
                             normals.direction(*this->boundary, b, nodes[a])) :
               one);
          Tensor<1, dim> u_a;
          for (unsigned int d = 0; d < dim; ++d)
            u_a[d] = u[a * dim + d];
          condition.gap += condition.share[a] * u_a;
        }
      const auto          &points = *this->current.points;
      const auto          &body   = points.material_of_body(material(b).body);
      const double         h      = active.basis().grid().size(cell);
      const Tensor<1, dim> stretched =
        body.small_strain() ? normal :
                              this->boundary->vector(b, slots.start_normal) *
                                invert(deformation_gradient(b));
      // a cell of today, by the places at the start
      const double whole =
        this->boundary->carried().keeps_grid ? h : h * stretched.norm();
      const double width =
        widths[r] > 0 ?
          std::min(whole,
                   std::max(std::max(smallest_width,
                                     this->current.ghost_penalty) *
                              whole,
                            widths[r])) :
          whole;
      condition.stiffness =
        factor() / width * held *
        acoustic_tensor(stretched, body.elastic_tangent(), stretched) * held;
      condition.moderate =
        std::min(1., moderate_factor / factor() * width / whole);
      // F^ differs from F by a tenth at most where the wall moves first
      condition.length = 10. * std::max(h, increment.norm());
    }



    template <int dim>
    void Nitsche<dim>::evaluate(const unsigned int r,
                                const unsigned int b,
                                const unsigned int n,
                                const double      *u,
                                const bool         tangent_wanted,
                                Condition         &condition) const
    {
      deform(b, n, u, condition);
      evaluate_gap(r, b, n, u, condition);
      Side                &as_is = condition.as_is, &closed = condition.closed;
      const Tensor<1, dim> normal =
        this->boundary->vector(b, this->boundary->slots().start_normal);
      const Tensor<2, dim> closing =
        outer_product(condition.gap, normal) / condition.length;
      closed.deformation   = as_is.deformation;
      closed.deformation.F = as_is.deformation.F - closing;
      closed.deformation.grad_increment -=
        condition.finite ? closing * invert(deformation_gradient(b)) : closing;

      double new_history[Materials::max_history];
      for (Side *side : {&as_is, &closed})
        {
          this->current.points->respond(material(b),
                                        tangent_wanted,
                                        side->deformation,
                                        side->response,
                                        new_history);
          side->stress  = to_tensor<dim>(side->response.stress);
          side->inverse = condition.finite ?
                            invert(side->deformation.F) :
                            Tensor<2, dim>(unit_symmetric_tensor<dim>());
        }
      condition.normal = normal * closed.inverse;
      closed.gradients.resize(n);
      for (unsigned int a = 0; a < n; ++a)
        {
          const Tensor<1, dim> gradient = as_is.gradients[a];
          as_is.gradients[a]            = gradient * as_is.inverse;
          closed.gradients[a]           = gradient * closed.inverse;
        }
    }



    template <int dim>
    Tensor<2, dim> Nitsche<dim>::Side::change(const Tensor<2, dim> &l,
                                              const bool geometric) const
    {
      const VoigtVector<dim> strain = engineering_strain<dim>(l);
      VoigtVector<dim>       rate   = {};
      for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
        for (unsigned int m = 0; m < Voigt<dim>::n; ++m)
          rate[k] += response.tangent[k * Voigt<dim>::n + m] * strain[m];
      Tensor<2, dim> result = to_tensor<dim>(rate);
      if (geometric)
        result += l * stress;
      return result;
    }



    template <int dim>
    std::array<Tensor<2, dim>, 2>
    Nitsche<dim>::Condition::variation(const unsigned int a,
                                       const unsigned int i) const
    {
      Tensor<1, dim> unit;
      unit[i] = 1.;
      return {{outer_product(unit, as_is.gradients[a]),
               outer_product(unit, closed.gradients[a]) -
                 outer_product(share[a] * unit, normal) / length}};
    }

    template class Nitsche<2>;
    template class Nitsche<3>;
  } // namespace Enforcement
} // namespace Impoint
