#include <impoint/enforcement/penalty.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      // In units of E/h: the largest factor that enters a matrix as it is, and
      // the one at which larger ones are augmented.
      constexpr double largest_plain_factor = 1e8;
      constexpr double augmentation_factor  = 1e8;

      // What the V-cycle of the preconditioner bears, in units of E/h.
      constexpr double moderate_factor = 10.;

      constexpr double small_cut_value = 0.01; // epsilon of P Eq. 53
    }                                          // namespace



    template <int dim>
    Penalty<dim>::Penalty(const ConditionParameters              &parameters,
                          PrescribedMotion<dim>                   motion,
                          std::unique_ptr<BoundaryParticles<dim>> particles,
                          const bool                              projected)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , projected(projected)
      , slip(parameters.constraint == "slip")
    {}



    template <int dim>
    double Penalty<dim>::unit(const unsigned int r) const
    {
      const auto &grid = this->current.active->basis().grid();
      return this->current.young / grid.size(this->boundary->ranges()[r].cell);
    }



    template <int dim>
    double Penalty<dim>::beta(const unsigned int r) const
    {
      return this->condition.factor_unit == "Pa/m" ?
               this->condition.factor :
               this->condition.factor * unit(r);
    }



    template <int dim>
    bool Penalty<dim>::is_augmented(const unsigned int r) const
    {
      return beta(r) > largest_plain_factor * unit(r);
    }



    template <int dim>
    double Penalty<dim>::gamma(const unsigned int r, const Patch &patch) const
    {
      if (!is_augmented(r))
        return beta(r);
      // A multiplier's error falls with gamma times the area: a small patch
      // gets the stiffness of a whole cell.
      const double h = this->current.active->basis().grid().size(
        this->boundary->ranges()[r].cell);
      const double whole = Utilities::fixed_power<dim - 1>(h);
      return augmentation_factor * unit(r) * std::max(1., whole / patch.area);
    }



    template <int dim>
    bool Penalty<dim>::augmented() const
    {
      for (unsigned int r = 0; r < this->boundary->ranges().size(); ++r)
        if (is_augmented(r))
          return true;
      return false;
    }



    template <int dim>
    void Penalty<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      if (slip && this->active_now)
        average_normals();
    }



    /** Normals at the nodes, P Eq. 54; decides whether they are needed. */
    template <int dim>
    void Penalty<dim>::average_normals()
    {
      nodal_normals      = this->condition.normals == "nodal";
      const auto &active = *this->current.active;
      const auto &slots  = this->boundary->slots();
      if (this->condition.normals == "automatic")
        {
          // Flat walls need no averages: all normals alike on all ranks.
          Tensor<1, dim> lowest, highest;
          for (unsigned int d = 0; d < dim; ++d)
            {
              lowest[d]  = 2;
              highest[d] = -2;
            }
          for (unsigned int b = 0; b < this->boundary->n(); ++b)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double n = this->boundary->vector(b, slots.normal)[d];
                lowest[d]      = std::min(lowest[d], n);
                highest[d]     = std::max(highest[d], n);
              }
          const MPI_Comm comm = active.basis().grid().communicator();
          for (unsigned int d = 0; d < dim; ++d)
            nodal_normals |= Utilities::MPI::max(highest[d], comm) -
                               Utilities::MPI::min(lowest[d], comm) >
                             1e-10;
        }
      if (!nodal_normals)
        return;

      LinearAlgebra::distributed::Vector<double> sums(active.unknowns());
      for (const auto &range : this->boundary->ranges())
        {
          const unsigned int k = active.position(range.cell);
          if (k == BackgroundGrid<dim>::nowhere)
            continue;
          const auto nodes = active.nodes(k);
          for (unsigned int b = range.begin; b < range.end; ++b)
            for (unsigned int a = 0; a < nodes.size(); ++a)
              for (unsigned int d = 0; d < dim; ++d)
                sums.local_element(nodes[a] * dim + d) +=
                  this->boundary->vector(b, slots.normal)[d] *
                  this->boundary->area(b) * this->boundary->support(b)[a];
        }
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
    void Penalty<dim>::shape_values(const unsigned int b,
                                    const unsigned int n,
                                    double            *N) const
    {
      const double *support = this->boundary->support(b);
      std::copy(support, support + n, N);
      if (!this->condition.small_cut_rule)
        return;
      double sum = 0;
      for (unsigned int a = 0; a < n; ++a)
        sum += N[a] = std::max(N[a], small_cut_value);
      for (unsigned int a = 0; a < n; ++a)
        N[a] /= sum;
    }



    template <int dim>
    Tensor<1, dim>
    Penalty<dim>::direction(const unsigned int b,
                            const unsigned int compact_node) const
    {
      return nodal_normals ?
               node_normals[compact_node] :
               this->boundary->vector(b, this->boundary->slots().normal);
    }



    template <int dim>
    void Penalty<dim>::make_patch(const unsigned int r, Patch &patch) const
    {
      const auto &active = *this->current.active;
      const auto &slots  = this->boundary->slots();
      const auto  nodes =
        active.nodes(active.position(this->boundary->ranges()[r].cell));
      const unsigned int n = nodes.size();
      double             N[64];

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
      for (unsigned int b = patch.begin; b < patch.end; ++b)
        {
          const double weight = this->boundary->area(b) / patch.area;
          shape_values(b, n, N);
          const Tensor<1, dim> wall =
            this->boundary->vector(b, slots.increment);
          patch.gap += weight * this->boundary->vector(b, slots.gap);
          patch.multiplier +=
            weight * this->boundary->vector(b, slots.multiplier);
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
    void Penalty<dim>::for_patches(const unsigned int r,
                                   const Function    &function) const
    {
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
    Tensor<1, dim> Penalty<dim>::gap(const Patch       &patch,
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
    Tensor<1, dim> Penalty<dim>::traction(const unsigned int r,
                                          const Patch       &patch,
                                          const double      *u) const
    {
      const unsigned int n = this->current.active->basis().n_nodes_of(
        this->boundary->ranges()[r].cell);
      const double factor = gamma(r, patch);
      if (!is_augmented(r))
        return factor * gap(patch, n, u);
      return (patch.multiplier + factor * gap(patch, n, u)) /
             (1. + factor / beta(r));
    }



    template <int dim>
    void Penalty<dim>::add(const unsigned int r,
                           const Strength     strength,
                           CellSystem        &system) const
    {
      for_patches(r, [&](const Patch &patch) {
        const unsigned int   n         = system.n;
        const Tensor<1, dim> t         = traction(r, patch, system.u);
        double               stiffness = gamma(r, patch);
        if (is_augmented(r))
          stiffness /= 1. + stiffness / beta(r);
        if (strength == Strength::moderate)
          stiffness = std::min(stiffness, moderate_factor * unit(r));
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int d = 0; d < dim; ++d)
            system.residual[a * dim + d] +=
              patch.area *
              (slip ? patch.rows[a][d] * t[0] : patch.values[a] * t[d]);
        if (system.matrix == nullptr)
          return;
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            {
              double      *block = system.matrix + (a * n + b) * dim * dim;
              const double scale = stiffness * patch.area;
              for (unsigned int i = 0; i < dim; ++i)
                if (!slip)
                  block[i * dim + i] +=
                    scale * patch.values[a] * patch.values[b];
                else
                  for (unsigned int j = 0; j < dim; ++j)
                    block[i * dim + j] +=
                      scale * patch.rows[a][i] * patch.rows[b][j];
            }
      });
    }



    template <int dim>
    void Penalty<dim>::update_multipliers(const unsigned int r, const double *u)
    {
      if (!is_augmented(r))
        return;
      for_patches(r, [&](const Patch &patch) {
        const Tensor<1, dim> t = traction(r, patch, u);
        for (unsigned int b = patch.begin; b < patch.end; ++b)
          this->boundary->set_vector(b, this->boundary->slots().multiplier, t);
      });
    }



    template <int dim>
    void Penalty<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto &slots = this->boundary->slots();
      const auto &range = this->boundary->ranges()[r];
      if (u == nullptr)
        {
          // What comes here next is met without a gap.
          for (unsigned int b = range.begin; b < range.end; ++b)
            for (const unsigned int slot :
                 {slots.force, slots.gap, slots.multiplier})
              this->boundary->set_vector(b, slot, Tensor<1, dim>());
          return;
        }
      const auto        &active = *this->current.active;
      const auto         nodes  = active.nodes(active.position(range.cell));
      const unsigned int n      = nodes.size();
      double             N[64];
      for_patches(r, [&](const Patch &patch) {
        // What the wall does to the material is minus what the residual holds.
        const Tensor<1, dim> t = traction(r, patch, u);
        for (unsigned int b = patch.begin; b < patch.end; ++b)
          {
            shape_values(b, n, N);
            Tensor<1, dim>       force;
            Tensor<1, dim>       total = this->boundary->vector(b, slots.gap);
            const Tensor<1, dim> wall =
              this->boundary->vector(b, slots.increment);
            if (slip)
              {
                total[0] -= this->boundary->vector(b, slots.normal) * wall;
                for (unsigned int a = 0; a < n; ++a)
                  {
                    const Tensor<1, dim> held = N[a] * direction(b, nodes[a]);
                    force -= this->boundary->area(b) * t[0] * held;
                    for (unsigned int d = 0; d < dim; ++d)
                      total[0] += held[d] * u[a * dim + d];
                  }
              }
            else
              {
                force = -this->boundary->area(b) * t;
                total += this->displacement(b, n, u) - wall;
              }
            this->boundary->set_vector(b, slots.force, force);
            this->boundary->set_vector(b, slots.gap, total);
          }
      });
    }

    template class Penalty<2>;
    template class Penalty<3>;
  } // namespace Enforcement
} // namespace Impoint
