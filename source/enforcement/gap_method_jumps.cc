#include <impoint/enforcement/gap_method.h>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    bool GapMethod<dim>::stabilises() const
    {
      return this->condition.has_multipliers() && is_linear() &&
             this->condition.superfluous == Superfluous::stabilise;
    }



    template <int dim>
    void GapMethod<dim>::tell_multipliers()
    {
      const auto                 &ranges = this->boundary->ranges();
      std::vector<Tensor<1, dim>> means(ranges.size());
      for (unsigned int r = 0; r < ranges.size(); ++r)
        {
          const double area = this->boundary->held_area_of_range(r);
          if (area == 0)
            continue;
          for (unsigned int b = ranges[r].begin; b < ranges[r].end; ++b)
            means[r] += this->boundary->held_area(b) / area * multiplier[b];
        }
      jumps.exchange(means);
    }



    template <int dim>
    bool GapMethod<dim>::exchange_multipliers()
    {
      if (jumps.acts())
        tell_multipliers();
      return jumps.acts();
    }



    template <int dim>
    void GapMethod<dim>::add_exchange(const unsigned int r,
                                      CellSystem        &system) const
    {
      const auto &range = this->boundary->ranges()[r];
      const Patch patch = make_patch(r, range.begin, range.end);
      patch.add_force(patch.law.stiffness() * jumps.change(r), system);
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
