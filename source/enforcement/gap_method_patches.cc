#include <impoint/enforcement/gap_method.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    void GapMethod<dim>::shape_values(const unsigned int r,
                                      const unsigned int b,
                                      const unsigned int n,
                                      double            *N) const
    {
      const double *support = this->boundary->support(b);
      std::copy(support, support + n, N);
      if (!raises_small_values(r))
        return;
      double sum = 0;
      for (unsigned int a = 0; a < n; ++a)
        sum += N[a] = std::max(N[a], small_cut_value);
      for (unsigned int a = 0; a < n; ++a)
        N[a] /= sum;
    }



    /** Whether the particle pressed on the material at the end of the last
     * step: then it keeps its gap. */
    template <int dim>
    bool GapMethod<dim>::is_closed(const unsigned int b) const
    {
      const auto          &slots = this->boundary->slots();
      const Tensor<1, dim> held  = this->boundary->vector(b, slots.multiplier);
      const Tensor<1, dim> gap   = this->boundary->vector(b, slots.gap);
      if (normal_only)
        return held[0] > 0 || gap[0] > 0;
      const Tensor<1, dim> normal = this->boundary->vector(b, slots.normal);
      return held * normal > 0 || gap * normal > 0;
    }



    template <int dim>
    bool GapMethod<dim>::is_near(const unsigned int b) const
    {
      return !this->condition.releasing || near[b];
    }



    /** How far the material is away. */
    template <int dim>
    double GapMethod<dim>::away(const unsigned int b) const
    {
      return is_near(b) ? 0. : proximity[b].edge;
    }



    template <int dim>
    bool GapMethod<dim>::is_in(const Patch &patch, const unsigned int b) const
    {
      return this->boundary->held_area(b) > 0 && away(b) <= patch.reach;
    }



    /** Gap with the material where it is and the wall where it will be. */
    template <int dim>
    Tensor<1, dim> GapMethod<dim>::start_gap(const unsigned int b) const
    {
      const auto          &slots  = this->boundary->slots();
      const Tensor<1, dim> normal = this->boundary->vector(b, slots.normal);
      const Tensor<1, dim> wall   = this->boundary->vector(b, slots.increment);
      Tensor<1, dim>       gap    = this->boundary->vector(b, slots.gap);
      Tensor<1, dim>       first;
      first[0] = 1.;
      if (this->condition.releasing && proximity[b].depth > 0)
        {
          // no point stays beyond the wall
          const Tensor<1, dim> across = normal_only ? first : normal;
          gap += std::max(0., proximity[b].depth - gap * across) * across;
        }
      if (normal_only)
        gap[0] -= normal * wall + away(b);
      else
        gap -= wall + away(b) * normal;
      return gap;
    }



    template <int dim>
    void GapMethod<dim>::add_particle(const unsigned int r,
                                      const unsigned int b,
                                      const double       weight,
                                      Patch             &patch) const
    {
      const auto nodes = this->current.active->nodes(
        this->current.active->position(this->boundary->ranges()[r].cell));
      double N[largest_support];
      shape_values(r, b, nodes.size(), N);
      patch.start_gap += weight * start_gap(b);
      patch.multiplier += weight * multiplier[b];
      patch.normal +=
        weight * this->boundary->vector(b, this->boundary->slots().normal);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        if (normal_only)
          patch.rows[a] +=
            weight * N[a] * normals.direction(*this->boundary, b, nodes[a]);
        else
          patch.values[a] += weight * N[a];
    }



    template <int dim>
    typename GapMethod<dim>::Patch
    GapMethod<dim>::make_patch(const unsigned int r,
                               const unsigned int begin,
                               const unsigned int end) const
    {
      Patch patch(normal_only,
                  this->current.active->basis().n_nodes_of(
                    this->boundary->ranges()[r].cell));
      patch.begin = begin;
      patch.end   = end;
      // where nothing touches, what will touch first, at about the same time
      constexpr double same = 0.05; // [h]
      for (unsigned int b = begin; b < end; ++b)
        if (this->boundary->held_area(b) > 0)
          patch.nearest = std::min(patch.nearest, away(b));
      patch.reach = patch.nearest;
      if (patch.nearest > 0)
        patch.reach +=
          same * this->current.active->basis().grid().smallest_size();
      for (unsigned int b = begin; b < end; ++b)
        if (is_in(patch, b))
          patch.area += this->boundary->held_area(b);
      for (unsigned int b = begin; b < end; ++b)
        if (is_in(patch, b))
          add_particle(r, b, this->boundary->held_area(b) / patch.area, patch);
      if (normal_only)
        {
          patch.normal    = Tensor<1, dim>();
          patch.normal[0] = 1.;
        }
      else
        patch.normal /= patch.normal.norm();

      set_law(r, patch);
      if (jumps.acts())
        {
          patch.start_gap += jumps.shift(r);
          patch.law.compliance += jumps.compliance(r);
        }
      return patch;
    }



    template <int dim>
    void GapMethod<dim>::set_law(const unsigned int r, Patch &patch) const
    {
      patch.law           = law(r, patch.area);
      patch.law.releasing = this->condition.releasing;
      patch.law.friction  = friction();
    }



    template <int dim>
    typename GapMethod<dim>::Patch
    GapMethod<dim>::alone(const unsigned int r, const unsigned int b) const
    {
      Patch patch(normal_only,
                  this->current.active->basis().n_nodes_of(
                    this->boundary->ranges()[r].cell));
      add_particle(r, b, 1., patch);
      return patch;
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
