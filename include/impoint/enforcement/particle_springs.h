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
     * the wall: the cantilever of paper P on quadratic splines, its clamp along
     * two and a half cells, errs by 1e-2 with multipliers alone, by 1.5e-4 (as
     * with Nitsche's method) with springs of 1e3; those of cubic ones take
     * three times that. With ten times as much they begin to lock where walls
     * are inclined.
     *
     * What moves flows past a wall for thousands of steps, and its particles'
     * gaps would grow apart unseen by their mean: sand on triangles sank by
     * 0.07 h. Linear functions lock from about a hundred times this factor.
     */
    template <int dim>
    double spring_beside_means(const Step<dim> &step)
    {
      constexpr double   soft = 1., firm = 125.;
      const unsigned int p = step.active->basis().degree();
      return p > 1        ? firm * Utilities::fixed_power<3>(double(p)) :
             step.dynamic ? soft :
                            0.;
    }
  } // namespace Enforcement
} // namespace Impoint

#endif
