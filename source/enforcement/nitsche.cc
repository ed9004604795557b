#include <impoint/base/exceptions.h>
#include <impoint/enforcement/nitsche.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // What holds accelerations, as a penalty in units of n.C.n/h.
      constexpr double constraint_factor = 1e4;



      /** Of the adjoint terms: 0, if they are left out. */
      template <int dim>
      double sign_of(const NitscheForm             form,
                     const BoundaryParticles<dim> &particles)
      {
        if (form == NitscheForm::incomplete ||
            (form == NitscheForm::automatic &&
             particles.carried().n_history > 0))
          return 0.;
        return form == NitscheForm::non_symmetric ? -1. : 1.;
      }
    } // namespace



    template <int dim>
    Nitsche<dim>::Nitsche(const ConditionParameters              &parameters,
                          PrescribedMotion<dim>                   motion,
                          std::unique_ptr<BoundaryParticles<dim>> particles)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , slip(parameters.constraint == Constraint::slip)
      , chooses_motion(parameters.motion == Moves::automatic)
      , sign(sign_of(parameters.nitsche_form, *this->boundary))
    {}



    template <int dim>
    bool Nitsche<dim>::is_symmetric() const
    {
      return sign > 0;
    }



    template <int dim>
    void Nitsche<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      if (!this->active_now)
        return;
      if (slip)
        normals.reinit(this->condition.normals, *this, *step.active);
      // Beside a curved wall the normal of a particle that follows the material
      // is soon another than the wall's where it is.
      if (slip && chooses_motion &&
          !one_normal(*this->boundary,
                      step.active->basis().grid().communicator()))
        this->condition.motion = Moves::with_value;
      const auto &points = *step.points;
      widths.assign(this->boundary->ranges().size(), 0.);
      for_active_ranges(*this,
                        *step.active,
                        [&](const unsigned int r, const unsigned int k) {
                          const double area =
                            this->boundary->held_area_of_range(r);
                          double volume = 0;
                          if (k < step.active->n_material_cells())
                            for (unsigned int p = points.ranges()[k].begin;
                                 p < points.ranges()[k].end;
                                 ++p)
                              volume += points.data(p)[points.slots().volume];
                          if (area > 0)
                            widths[r] = volume / area;
                        });
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
          const double area = this->boundary->held_area(b);
          if (area == 0)
            continue;
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
          const double part = strength == Strength::constraint ?
                                constraint_factor / factor() :
                                condition.moderate;
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
          const double area = this->boundary->held_area(b);
          if (u != nullptr && area > 0)
            {
              evaluate(r, b, n, u, false, condition);
              const Tensor<1, dim> normal =
                this->boundary->vector(b, slots.normal);
              const Tensor<1, dim> traction =
                condition.closed.stress * condition.normal;
              const Tensor<1, dim> pull =
                condition.stiffness * condition.gap - traction;
              // minus what the residual holds, whatever the nodes' normals are
              for (unsigned int a = 0; a < n; ++a)
                force -= area * (transpose(condition.share[a]) * pull);
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
      double    new_history[Materials::max_history];
      Condition condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          deform(b, n, u, condition);
          Side         &as_is     = condition.as_is;
          double       *state     = this->boundary->data(b);
          const auto    n_history = this->boundary->carried().n_history;
          const double *old_history =
            n_history > 0 ? state + slots.history : new_history;
          std::copy(old_history, old_history + n_history, new_history);
          try
            {
              this->current.points->respond(material(b),
                                            false,
                                            as_is.deformation,
                                            as_is.response,
                                            new_history);
            }
          catch (const StepFailed &)
            {
              // Newton's method had an answer wherever the condition acts;
              // where it doesn't, the stress is that of the last answer.
              Assert(!this->is_active(), ExcInternalError());
              continue;
            }
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              state[slots.F + i * dim + j] = as_is.deformation.F[i][j];
          std::copy(as_is.response.stress.begin(),
                    as_is.response.stress.end(),
                    state + slots.stress);
          if (dim == 2)
            state[slots.stress + Voigt<dim>::n] = as_is.response.stress_zz;
          if (n_history > 0)
            std::copy(new_history,
                      new_history + n_history,
                      state + slots.history);
        }
    }

    template class Nitsche<2>;
    template class Nitsche<3>;
  } // namespace Enforcement
} // namespace Impoint
