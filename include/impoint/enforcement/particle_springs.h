#ifndef impoint_enforcement_particle_springs_h
#define impoint_enforcement_particle_springs_h

#include <impoint/enforcement/enforcement.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Stiffness, in units of E/h, of springs that hold each particle's own gap
     * where a method acts on means: without forces where the condition holds,
     * so that what is exact without them is exact with them.
     *
     * One mean a cell is a good constraint of linear functions, and less than
     * what functions of higher degree can bear, so that these turn and bend at
     * the wall: the cantilever of paper P on quadratic splines, its inclined
     * clamp along two and a half cells, errs by 1e-2 with multipliers alone, by
     * 8e-5 (Nitsche's method: 9e-5) with these springs. Stiffer ones lock where
     * walls are inclined or curved: ten times as stiff, errors there are 2 to
     * 10 times as large; a tenth leaves coarse clamps at 4e-4. Cubic ones want
     * ten times those of quadratic ones.
     *
     * What moves flows past a wall for thousands of steps, and its particles'
     * gaps would grow apart unseen by their mean: sand on triangles sank by
     * 0.07 h. Linear functions lock from about a hundred times this factor.
     */
    template <int dim>
    double spring_beside_means(const Step<dim> &step)
    {
      constexpr double   soft = 1., firm = 5.;
      const unsigned int p = step.active->basis().degree();
      return p > 1        ? firm * Utilities::fixed_power<6>(double(p)) :
             step.dynamic ? soft :
                            0.;
    }
  } // namespace Enforcement
} // namespace Impoint

#endif
