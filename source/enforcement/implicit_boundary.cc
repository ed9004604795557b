#include <impoint/enforcement/acoustic_tensor.h>
#include <impoint/enforcement/implicit_boundary.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // What the V-cycle of the preconditioner bears, in units of E/h.
      constexpr double moderate_factor = 10.;

    } // namespace



    template <int dim>
    ImplicitBoundary<dim>::ImplicitBoundary(
      const ConditionParameters              &parameters,
      PrescribedMotion<dim>                   motion,
      std::unique_ptr<BoundaryParticles<dim>> particles)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , slip(parameters.constraint == "slip")
    {}



    template <int dim>
    double ImplicitBoundary<dim>::inverse_width(const unsigned int r) const
    {
      const auto &grid = this->current.active->basis().grid();
      return 4. / (3. * this->condition.band_width *
                   grid.size(this->boundary->ranges()[r].cell));
    }



    template <int dim>
    typename ImplicitBoundary<dim>::CellState
    ImplicitBoundary<dim>::cell_state(const unsigned int r) const
    {
      const auto        &active = *this->current.active;
      const auto        &points = *this->current.points;
      const unsigned int k = active.position(this->boundary->ranges()[r].cell);
      CellState          state;
      if (k >= active.n_material_cells())
        {
          // without material, and so without a traction
          state.tangent = points.stiffest_material().elastic_tangent();
          return state;
        }
      const auto &range  = points.ranges()[k];
      double      volume = 0;
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          const double  part   = points.data(p)[points.slots().volume];
          const double *stress = points.data(p) + points.slots().stress;
          volume += part;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              state.stress[i][j] += part * stress[Voigt<dim>::position(i, j)];
        }
      state.stress /= volume;
      double area = 0;
      for (unsigned int b = this->boundary->ranges()[r].begin;
           b < this->boundary->ranges()[r].end;
           ++b)
        area += this->boundary->area(b);
      state.filled  = std::min(1., volume * 0.75 * inverse_width(r) / area);
      state.tangent = points.material(range.begin).elastic_tangent();
      return state;
    }



    template <int dim>
    void ImplicitBoundary<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      states.assign(this->boundary->ranges().size(), CellState());
      if (this->active_now && slip)
        normals.reinit(this->condition.normals, *this, *step.active);
      if (this->active_now)
        for_active_ranges(*this,
                          *step.active,
                          [&](const unsigned int r, const unsigned int) {
                            states[r] = cell_state(r);
                          });
    }



    template <int dim>
    void ImplicitBoundary<dim>::evaluate(const unsigned int r,
                                         const unsigned int b,
                                         const unsigned int n,
                                         const double      *u,
                                         Condition         &condition) const
    {
      const auto          &slots   = this->boundary->slots();
      const CellState     &state   = states[r];
      const Tensor<1, dim> outward = this->boundary->vector(b, slots.normal);
      const Tensor<1, dim> normal  = -outward;
      const Tensor<2, dim> one     = unit_symmetric_tensor<dim>();
      const Tensor<2, dim> across  = outer_product(normal, normal);
      const Tensor<2, dim> weight =
        state.filled * (slip ? one - 0.5 * across : 0.5 * one);

      condition.held     = slip ? across : one;
      condition.acoustic = condition.held *
                           acoustic_tensor(normal, state.tangent, normal) *
                           condition.held;
      // a slip boundary carries its gap along the normal in component 0
      Tensor<1, dim> total = this->boundary->vector(b, slots.gap);
      if (slip)
        total = total[0] * outward;
      condition.share.resize(n);
      const double *N     = this->boundary->support(b);
      const auto    nodes = this->current.active->nodes(
        this->current.active->position(this->boundary->ranges()[r].cell));
      condition.gap =
        condition.held * (total - this->boundary->vector(b, slots.increment));
      for (unsigned int a = 0; a < n; ++a)
        {
          condition.share[a] =
            N[a] *
            (slip ?
               outer_product(outward,
                             normals.direction(*this->boundary, b, nodes[a])) :
               one);
          Tensor<1, dim> u_a;
          for (unsigned int d = 0; d < dim; ++d)
            u_a[d] = u[a * dim + d];
          condition.gap += condition.share[a] * u_a;
        }
      condition.traction =
        condition.held * (0.5 * state.filled * state.stress * normal) +
        inverse_width(r) * condition.acoustic * condition.gap;

      condition.flux.resize(n);
      const double *gradients = this->boundary->support(b) + n;
      for (unsigned int a = 0; a < n; ++a)
        {
          Tensor<1, dim> gradient, u_a;
          for (unsigned int d = 0; d < dim; ++d)
            {
              gradient[d] = gradients[a * dim + d];
              u_a[d]      = u[a * dim + d];
            }
          condition.flux[a] = condition.held *
                              acoustic_tensor(normal, state.tangent, gradient) *
                              weight;
          condition.traction += condition.flux[a] * u_a;
        }
    }



    template <int dim>
    void ImplicitBoundary<dim>::add(const unsigned int r,
                                    const Strength     strength,
                                    CellSystem        &system) const
    {
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n     = system.n;
      const bool         exact = strength == Strength::exact;
      const double h = this->current.active->basis().grid().size(range.cell);
      const double stiffness =
        exact ? inverse_width(r) :
                std::min(inverse_width(r), moderate_factor / h);
      Condition condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          evaluate(r, b, n, system.u, condition);
          const double area = this->boundary->area(b);
          for (unsigned int a = 0; a < n; ++a)
            {
              const Tensor<1, dim> force =
                area * (transpose(condition.share[a]) * condition.traction +
                        transpose(condition.flux[a]) * condition.gap);
              for (unsigned int d = 0; d < dim; ++d)
                system.residual[a * dim + d] += force[d];
            }
          if (system.matrix == nullptr)
            continue;
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int c = 0; c < n; ++c)
              {
                Tensor<2, dim> block = stiffness *
                                       transpose(condition.share[a]) *
                                       condition.acoustic * condition.share[c];
                if (exact)
                  block += transpose(condition.share[a]) * condition.flux[c] +
                           transpose(condition.flux[a]) * condition.share[c];
                double *to = system.matrix + (a * n + c) * dim * dim;
                for (unsigned int i = 0; i < dim; ++i)
                  for (unsigned int j = 0; j < dim; ++j)
                    to[i * dim + j] += area * block[i][j];
              }
        }
    }



    template <int dim>
    void ImplicitBoundary<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto        &slots = this->boundary->slots();
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n =
        this->current.active->basis().n_nodes_of(range.cell);
      Condition condition;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          if (u == nullptr)
            {
              // what comes here next is met without a gap
              this->boundary->set_vector(b, slots.force, Tensor<1, dim>());
              this->boundary->set_vector(b, slots.gap, Tensor<1, dim>());
              continue;
            }
          evaluate(r, b, n, u, condition);
          Tensor<1, dim> gap = condition.gap;
          if (slip)
            {
              gap    = Tensor<1, dim>();
              gap[0] = condition.gap * this->boundary->vector(b, slots.normal);
            }
          this->boundary->set_vector(
            b, slots.force, -this->boundary->area(b) * condition.traction);
          this->boundary->set_vector(b, slots.gap, gap);
        }
    }

    template class ImplicitBoundary<2>;
    template class ImplicitBoundary<3>;
  } // namespace Enforcement
} // namespace Impoint
