#include <impoint/enforcement/gap_method.h>
#include <impoint/enforcement/superfluous_constraints.h>

#include <deal.II/lac/la_parallel_vector.h>

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
    GapMethod<dim>::GapMethod(const ConditionParameters &parameters,
                              PrescribedMotion<dim>      motion,
                              std::unique_ptr<BoundaryParticles<dim>> particles,
                              const bool                              projected)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , projected(projected)
      , slip(parameters.constraint == "slip")
    {}



    template <int dim>
    double GapMethod<dim>::unit(const unsigned int r) const
    {
      const auto &grid = this->current.active->basis().grid();
      return this->current.young / grid.size(this->boundary->ranges()[r].cell);
    }



    template <int dim>
    double GapMethod<dim>::factor(const unsigned int r) const
    {
      return this->condition.factor_unit == "Pa/m" ?
               this->condition.factor :
               this->condition.factor * unit(r);
    }



    template <int dim>
    double GapMethod<dim>::enlarge(const double       gamma,
                                   const unsigned int r,
                                   const double       area) const
    {
      const double h = this->current.active->basis().grid().size(
        this->boundary->ranges()[r].cell);
      return gamma * std::max(1., Utilities::fixed_power<dim - 1>(h) / area);
    }



    template <int dim>
    bool GapMethod<dim>::takes_part(const unsigned int r) const
    {
      return left_out.empty() || !left_out[r];
    }



    template <int dim>
    bool GapMethod<dim>::removes_superfluous() const
    {
      return this->condition.superfluous == "remove" ||
             (this->condition.superfluous == "automatic" &&
              this->condition.enforcement == "lagrange multiplier");
    }



    template <int dim>
    bool GapMethod<dim>::augmented() const
    {
      for (unsigned int r = 0; r < this->boundary->ranges().size(); ++r)
        if (law(r, 1.).augmented)
          return true;
      return false;
    }



    template <int dim>
    void GapMethod<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      if (!this->active_now)
        return;
      before.clear();
      multipliers.resize(this->boundary->n());
      for (unsigned int b = 0; b < multipliers.size(); ++b)
        multipliers[b] =
          this->boundary->vector(b, this->boundary->slots().multiplier);
      if (slip)
        average_normals();
      left_out.clear();
      if (removes_superfluous())
        left_out = superfluous_constraints(*this->boundary, *step.active);
    }



    /** Whether all normals of all ranks are alike: a flat wall. */
    template <int dim>
    bool GapMethod<dim>::one_normal() const
    {
      Tensor<1, dim> lowest, highest;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lowest[d]  = 2;
          highest[d] = -2;
        }
      for (unsigned int b = 0; b < this->boundary->n(); ++b)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double n =
              this->boundary->vector(b, this->boundary->slots().normal)[d];
            lowest[d]  = std::min(lowest[d], n);
            highest[d] = std::max(highest[d], n);
          }
      const MPI_Comm comm = this->current.active->basis().grid().communicator();
      double         largest_difference = 0;
      for (unsigned int d = 0; d < dim; ++d)
        largest_difference = std::max(largest_difference,
                                      Utilities::MPI::max(highest[d], comm) -
                                        Utilities::MPI::min(lowest[d], comm));
      return largest_difference < 1e-10;
    }



    /** Normals at the nodes, P Eq. 54, where they are needed. */
    template <int dim>
    void GapMethod<dim>::average_normals()
    {
      nodal_normals = this->condition.normals == "nodal" ||
                      (this->condition.normals == "automatic" && !one_normal());
      if (!nodal_normals)
        return;

      const auto &active = *this->current.active;
      const auto &slots  = this->boundary->slots();
      LinearAlgebra::distributed::Vector<double> sums(active.unknowns());
      for_active_ranges(*this,
                        active,
                        [&](const unsigned int r, const unsigned int k) {
                          const auto &range = this->boundary->ranges()[r];
                          const auto  nodes = active.nodes(k);
                          for (unsigned int b = range.begin; b < range.end; ++b)
                            for (unsigned int a = 0; a < nodes.size(); ++a)
                              for (unsigned int d = 0; d < dim; ++d)
                                sums.local_element(nodes[a] * dim + d) +=
                                  this->boundary->vector(b, slots.normal)[d] *
                                  this->boundary->area(b) *
                                  this->boundary->support(b)[a];
                        });
      sums.compress(VectorOperation::add);
      sums.update_ghost_values();
      node_normals.assign(active.n_nodes(), Tensor<1, dim>());
      for (unsigned int i = 0; i < active.n_nodes(); ++i)
        {
          for (unsigned int d = 0; d < dim; ++d)
            node_normals[i][d] = sums.local_element(i * dim + d);
          if (node_normals[i].norm() > 0)
            node_normals[i] /= node_normals[i].norm();
        }
    }



    template <int dim>
    bool GapMethod<dim>::raises_small_values(const unsigned int) const
    {
      return this->condition.small_cut_rule;
    }



    template <int dim>
    void GapMethod<dim>::shape_values(const unsigned int b,
                                      const bool         raise_small,
                                      const unsigned int n,
                                      double            *N) const
    {
      const double *support = this->boundary->support(b);
      std::copy(support, support + n, N);
      if (!raise_small)
        return;
      double sum = 0;
      for (unsigned int a = 0; a < n; ++a)
        sum += N[a] = std::max(N[a], small_cut_value);
      for (unsigned int a = 0; a < n; ++a)
        N[a] /= sum;
    }



    template <int dim>
    Tensor<1, dim>
    GapMethod<dim>::direction(const unsigned int b,
                              const unsigned int compact_node) const
    {
      return nodal_normals ?
               node_normals[compact_node] :
               this->boundary->vector(b, this->boundary->slots().normal);
    }



    template <int dim>
    void GapMethod<dim>::make_patch(const unsigned int r, Patch &patch) const
    {
      const auto &active = *this->current.active;
      const auto &slots  = this->boundary->slots();
      const auto  nodes =
        active.nodes(active.position(this->boundary->ranges()[r].cell));
      const unsigned int n           = nodes.size();
      const bool         raise_small = raises_small_values(r);
      double             N[largest_support];
      Assert(n <= largest_support, ExcInternalError());

      patch.area       = 0;
      patch.gap        = Tensor<1, dim>();
      patch.multiplier = Tensor<1, dim>();
      for (unsigned int a = 0; a < n; ++a)
        {
          patch.values[a] = 0;
          patch.rows[a]   = Tensor<1, dim>();
        }
      for (unsigned int b = patch.begin; b < patch.end; ++b)
        patch.area += this->boundary->area(b);
      patch.law = law(r, patch.area);
      for (unsigned int b = patch.begin; b < patch.end; ++b)
        {
          const double weight = this->boundary->area(b) / patch.area;
          shape_values(b, raise_small, n, N);
          const Tensor<1, dim> wall =
            this->boundary->vector(b, slots.increment);
          patch.gap += weight * this->boundary->vector(b, slots.gap);
          patch.multiplier += weight * multipliers[b];
          if (slip)
            patch.gap[0] -=
              weight * (this->boundary->vector(b, slots.normal) * wall);
          else
            patch.gap -= weight * wall;
          for (unsigned int a = 0; a < n; ++a)
            if (slip)
              patch.rows[a] += weight * N[a] * direction(b, nodes[a]);
            else
              patch.values[a] += weight * N[a];
        }
    }



    template <int dim>
    template <typename Function>
    void GapMethod<dim>::for_patches(const unsigned int r,
                                     const Function    &function) const
    {
      if (!takes_part(r))
        return;
      const auto &range = this->boundary->ranges()[r];
      Patch       patch;
      patch.begin = range.begin;
      while (patch.begin < range.end)
        {
          patch.end = projected ? range.end : patch.begin + 1;
          make_patch(r, patch);
          function(patch);
          patch.begin = patch.end;
        }
    }



    template <int dim>
    Tensor<1, dim> GapMethod<dim>::gap(const Patch       &patch,
                                       const unsigned int n,
                                       const double      *u) const
    {
      Tensor<1, dim> result = patch.gap;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          if (slip)
            result[0] += patch.rows[a][d] * u[a * dim + d];
          else
            result[d] += patch.values[a] * u[a * dim + d];
      return result;
    }



    template <int dim>
    Tensor<1, dim> GapMethod<dim>::traction(const Patch       &patch,
                                            const unsigned int n,
                                            const double      *u) const
    {
      const Law           &law   = patch.law;
      const Tensor<1, dim> trial = law.gamma * gap(patch, n, u);
      return law.augmented ?
               (patch.multiplier + trial) / (1. + law.gamma * law.compliance) :
               trial;
    }



    template <int dim>
    void GapMethod<dim>::add_force(const Patch          &patch,
                                   const Tensor<1, dim> &t,
                                   CellSystem           &system) const
    {
      for (unsigned int a = 0; a < system.n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          system.residual[a * dim + d] +=
            patch.area *
            (slip ? patch.rows[a][d] * t[0] : patch.values[a] * t[d]);
    }



    template <int dim>
    void GapMethod<dim>::add_stiffness(const Patch &patch,
                                       const double stiffness,
                                       CellSystem  &system) const
    {
      const unsigned int n     = system.n;
      const double       scale = stiffness * patch.area;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          {
            double *block = system.matrix + (a * n + b) * dim * dim;
            for (unsigned int i = 0; i < dim; ++i)
              if (!slip)
                block[i * dim + i] += scale * patch.values[a] * patch.values[b];
              else
                for (unsigned int j = 0; j < dim; ++j)
                  block[i * dim + j] +=
                    scale * patch.rows[a][i] * patch.rows[b][j];
          }
    }



    template <int dim>
    void GapMethod<dim>::add(const unsigned int r,
                             const Strength     strength,
                             CellSystem        &system) const
    {
      for_patches(r, [&](const Patch &patch) {
        add_force(patch, traction(patch, system.n, system.u), system);
        double stiffness = patch.law.stiffness();
        if (strength == Strength::moderate)
          stiffness = std::min(stiffness, moderate_factor * unit(r));
        if (system.matrix != nullptr)
          add_stiffness(patch, stiffness, system);
      });
    }



    template <int dim>
    void GapMethod<dim>::update_multipliers(const unsigned int r,
                                            CellSystem        &system)
    {
      for_patches(r, [&](const Patch &patch) {
        if (!patch.law.augmented)
          return;
        const Tensor<1, dim> t = traction(patch, system.n, system.u);
        for (unsigned int b = patch.begin; b < patch.end; ++b)
          multipliers[b] = t;
        // at the same gap t changes by the multiplier's change over 1 + gamma c
        add_force(patch,
                  (t - patch.multiplier) /
                    (1. + patch.law.gamma * patch.law.compliance),
                  system);
      });
    }



    template <int dim>
    void GapMethod<dim>::remember_multipliers()
    {
      before = multipliers;
    }



    template <int dim>
    void GapMethod<dim>::cut_multipliers(const double fraction)
    {
      if (before.empty())
        return;
      if (fraction == 1.)
        after = multipliers;
      for (unsigned int b = 0; b < multipliers.size(); ++b)
        multipliers[b] = before[b] + fraction * (after[b] - before[b]);
    }



    template <int dim>
    void GapMethod<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto &slots = this->boundary->slots();
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          this->boundary->set_vector(b, slots.force, Tensor<1, dim>());
          this->boundary->set_vector(b, slots.multiplier, Tensor<1, dim>());
          if (u == nullptr) // what comes here next is met without a gap
            this->boundary->set_vector(b, slots.gap, Tensor<1, dim>());
        }
      if (u == nullptr)
        return;
      const auto nodes =
        this->current.active->nodes(this->current.active->position(range.cell));
      for_patches(r, [&](const Patch &patch) {
        const Tensor<1, dim> t = traction(patch, nodes.size(), u);
        for (unsigned int b = patch.begin; b < patch.end; ++b)
          store_force(r, b, patch.law.augmented, t);
      });
      for (unsigned int b = range.begin; b < range.end; ++b)
        store_gap(r, b, u);
    }



    /** What the wall does to the material is minus what the residual holds. */
    template <int dim>
    void GapMethod<dim>::store_force(const unsigned int    r,
                                     const unsigned int    b,
                                     const bool            is_multiplier,
                                     const Tensor<1, dim> &t)
    {
      const auto &slots = this->boundary->slots();
      const auto  nodes = this->current.active->nodes(
        this->current.active->position(this->boundary->ranges()[r].cell));
      Tensor<1, dim> force = -this->boundary->area(b) * t;
      if (slip)
        {
          double         N[largest_support];
          Tensor<1, dim> held;
          shape_values(b, raises_small_values(r), nodes.size(), N);
          for (unsigned int a = 0; a < nodes.size(); ++a)
            held += N[a] * direction(b, nodes[a]);
          force = -this->boundary->area(b) * t[0] * held;
        }
      this->boundary->set_vector(b, slots.force, force);
      if (is_multiplier)
        this->boundary->set_vector(b, slots.multiplier, t);
    }



    template <int dim>
    void GapMethod<dim>::store_gap(const unsigned int r,
                                   const unsigned int b,
                                   const double      *u)
    {
      const auto &slots = this->boundary->slots();
      const auto  nodes = this->current.active->nodes(
        this->current.active->position(this->boundary->ranges()[r].cell));
      Tensor<1, dim>       gap  = this->boundary->vector(b, slots.gap);
      const Tensor<1, dim> wall = this->boundary->vector(b, slots.increment);
      if (slip)
        {
          double N[largest_support];
          shape_values(b, raises_small_values(r), nodes.size(), N);
          gap[0] -= this->boundary->vector(b, slots.normal) * wall;
          for (unsigned int a = 0; a < nodes.size(); ++a)
            for (unsigned int d = 0; d < dim; ++d)
              gap[0] += N[a] * direction(b, nodes[a])[d] * u[a * dim + d];
        }
      else
        gap += this->displacement(b, nodes.size(), u) - wall;
      this->boundary->set_vector(b, slots.gap, gap);
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
