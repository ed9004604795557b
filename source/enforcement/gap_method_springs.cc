#include <impoint/enforcement/gap_method.h>
#include <impoint/enforcement/particle_springs.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    double GapMethod<dim>::spring(const unsigned int r) const
    {
      if (!projected || !is_linear())
        return 0;
      return std::min(spring_beside_means(this->current) * unit(r), factor(r));
    }



    template <int dim>
    void GapMethod<dim>::add_springs(const unsigned int r,
                                     const Strength     strength,
                                     CellSystem        &system) const
    {
      const double k = spring(r);
      if (k == 0 || !takes_part(r))
        return;
      const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
      const auto          &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        if (this->boundary->held_area(b) > 0)
          {
            Patch patch     = alone(r, b);
            patch.area      = this->boundary->held_area(b);
            patch.law.gamma = k;
            add_patch(patch, {patch.trial(system.u), one}, r, strength, system);
          }
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
