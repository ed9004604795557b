#include <impoint/base/tensor_functions.h>
#include <impoint/enforcement/nitsche.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // What the V-cycle of the preconditioner bears, in units of n.C.n/h.
      constexpr double moderate_factor = 10.;

      // In cell sizes: no sliver of material is taken for thinner.
      constexpr double smallest_width = 1e-4;

      // l in cell sizes, or in increments of the wall: F^ differs from F by a
      // tenth at most where the wall moves first.
      constexpr double length_factor = 10.;



      /** v.C.w = v_k C_kilj w_l */
      template <int dim>
      Tensor<2, dim> acoustic_tensor(const VoigtMatrix<dim> &C,
                                     const Tensor<1, dim>   &v)
      {
        Tensor<2, dim> result;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = 0; l < dim; ++l)
                result[i][j] += v[k] *
                                C[Voigt<dim>::position(k, i) * Voigt<dim>::n +
                                  Voigt<dim>::position(l, j)] *
                                v[l];
        return result;
      }
    } // namespace



    template <int dim>
    Nitsche<dim>::Nitsche(const ConditionParameters              &parameters,
                          PrescribedMotion<dim>                   motion,
                          std::unique_ptr<BoundaryParticles<dim>> particles)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , slip(parameters.constraint == "slip")
      , sign(parameters.nitsche_form == "symmetric" ? 1. : -1.)
    {}



    template <int dim>
    bool Nitsche<dim>::is_symmetric() const
    {
      return sign > 0;
    }



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
    void Nitsche<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      if (!this->active_now)
        return;
      if (slip)
        normals.reinit(this->condition.normals, *this, *step.active);
      const auto &points = *step.points;
      widths.assign(this->boundary->ranges().size(), 0.);
      for_active_ranges(
        *this, *step.active, [&](const unsigned int r, const unsigned int k) {
          const auto  &range = this->boundary->ranges()[r];
          const double h     = step.active->basis().grid().size(range.cell);
          double       area = 0, volume = 0;
          for (unsigned int b = range.begin; b < range.end; ++b)
            area += this->boundary->area(b);
          if (k < step.active->n_material_cells())
            for (unsigned int p = points.ranges()[k].begin;
                 p < points.ranges()[k].end;
                 ++p)
              volume += points.data(p)[points.slots().volume];
          // what has no material has no sliver of it
          widths[r] =
            volume > 0 ?
              std::min(h, std::max(smallest_width * h, volume / area)) :
              h;
        });
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
      const auto &body =
        this->current.points->material_of_body(material(b).body);
      condition.stiffness =
        factor() / widths[r] * held *
        acoustic_tensor<dim>(body.elastic_tangent(), normal) * held;
      condition.length =
        length_factor *
        std::max(active.basis().grid().size(cell), increment.norm());
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

      double new_history[64];
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



    template <int dim>
    void Nitsche<dim>::add_residual(const double     area,
                                    const Condition &condition,
                                    CellSystem      &system) const
    {
      const Side          &as_is = condition.as_is, &closed = condition.closed;
      const Tensor<1, dim> pull =
        condition.stiffness * condition.gap - closed.stress * condition.normal;
      for (unsigned int a = 0; a < system.n; ++a)
        {
          const Tensor<1, dim> force =
            area * (transpose(condition.share[a]) * pull +
                    sign * condition.length *
                      (closed.stress * closed.gradients[a] -
                       as_is.stress * as_is.gradients[a]));
          for (unsigned int i = 0; i < dim; ++i)
            system.residual[a * dim + i] += force[i];
        }
    }



    template <int dim>
    void Nitsche<dim>::add_matrix(const double     area,
                                  const Condition &condition,
                                  CellSystem      &system) const
    {
      const Side &as_is = condition.as_is, &closed = condition.closed;
      for (unsigned int c = 0; c < system.n; ++c)
        for (unsigned int j = 0; j < dim; ++j)
          {
            const auto           l      = condition.variation(c, j);
            const Tensor<2, dim> change = as_is.change(l[0], condition.finite);
            const Tensor<2, dim> change_closed =
              closed.change(l[1], condition.finite);
            Tensor<1, dim> unit;
            unit[j] = 1.;
            const Tensor<1, dim> pull =
              condition.stiffness * (condition.share[c] * unit) -
              change_closed * condition.normal;
            for (unsigned int a = 0; a < system.n; ++a)
              {
                const Tensor<1, dim> force =
                  area * (transpose(condition.share[a]) * pull +
                          sign * condition.length *
                            (change_closed * closed.gradients[a] -
                             change * as_is.gradients[a]));
                double *to = system.matrix + (a * system.n + c) * dim * dim + j;
                for (unsigned int i = 0; i < dim; ++i)
                  to[i * dim] += force[i];
              }
          }
    }



    template <int dim>
    void Nitsche<dim>::add(const unsigned int r,
                           const Strength     strength,
                           CellSystem        &system) const
    {
      const auto &range = this->boundary->ranges()[r];
      const bool  exact = strength == Strength::exact;
      Condition   condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          const double area = this->boundary->area(b);
          if (exact)
            {
              const bool tangent_wanted = system.matrix != nullptr;
              evaluate(r, b, system.n, system.u, tangent_wanted, condition);
              add_residual(area, condition, system);
              if (tangent_wanted)
                add_matrix(area, condition, system);
              continue;
            }
          evaluate_gap(r, b, system.n, system.u, condition);
          const double h =
            this->current.active->basis().grid().size(range.cell);
          const double part =
            std::min(1., moderate_factor / factor() * widths[r] / h);
          for (unsigned int a = 0; a < system.n; ++a)
            for (unsigned int c = 0; c < system.n; ++c)
              {
                const Tensor<2, dim> block =
                  part * area * transpose(condition.share[a]) *
                  condition.stiffness * condition.share[c];
                double *to = system.matrix + (a * system.n + c) * dim * dim;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = 0; j < dim; ++j)
                    to[i * dim + j] += block[i][j];
              }
        }
    }



    template <int dim>
    void Nitsche<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto        &slots = this->boundary->slots();
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n =
        this->current.active->basis().n_nodes_of(range.cell);
      Condition condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          Tensor<1, dim> force, gap;
          double        *couple = this->boundary->data(b) + slots.couple;
          std::fill(couple, couple + (dim == 2 ? 1 : 3), 0.);
          if (u != nullptr)
            {
              evaluate(r, b, n, u, false, condition);
              const double         area = this->boundary->area(b);
              const Tensor<1, dim> normal =
                this->boundary->vector(b, slots.normal);
              const Tensor<1, dim> traction =
                condition.closed.stress * condition.normal;
              force = traction - condition.stiffness * condition.gap;
              if (slip)
                force = (force * normal) * normal;
              force *= area;
              gap = condition.gap;
              if (slip)
                {
                  gap    = Tensor<1, dim>();
                  gap[0] = condition.gap * normal;
                }
              // of the forces at the gap's other end
              if (condition.finite)
                {
                  const Tensor<1, dim> at = -sign * area * condition.gap;
                  if constexpr (dim == 2)
                    *couple = at[0] * traction[1] - at[1] * traction[0];
                  else
                    {
                      const Tensor<1, dim> moment =
                        cross_product_3d(at, traction);
                      std::copy(moment.begin_raw(), moment.end_raw(), couple);
                    }
                }
            }
          this->boundary->set_vector(b, slots.force, force);
          this->boundary->set_vector(b, slots.gap, gap);
        }
    }



    template <int dim>
    void Nitsche<dim>::follow_material(const unsigned int r, const double *u)
    {
      Method<dim>::follow_material(r, u);
      const auto        &slots = this->boundary->slots();
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n =
        this->current.active->basis().n_nodes_of(range.cell);
      double    new_history[64];
      Condition condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          deform(b, n, u, condition);
          Side &as_is = condition.as_is;
          this->current.points->respond(
            material(b), false, as_is.deformation, as_is.response, new_history);
          double *state = this->boundary->data(b);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              state[slots.F + i * dim + j] = as_is.deformation.F[i][j];
          std::copy(as_is.response.stress.begin(),
                    as_is.response.stress.end(),
                    state + slots.stress);
          if (dim == 2)
            state[slots.stress + Voigt<dim>::n] = as_is.response.stress_zz;
          if (const unsigned int n_history =
                this->boundary->carried().n_history;
              n_history > 0)
            std::copy(new_history,
                      new_history + n_history,
                      state + slots.history);
        }
    }

    template class Nitsche<2>;
    template class Nitsche<3>;
  } // namespace Enforcement
} // namespace Impoint
