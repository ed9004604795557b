#ifndef impoint_enforcement_kinds_h
#define impoint_enforcement_kinds_h

#include <impoint/enforcement/enforcement.h>

#include <tuple>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    using MethodMaker = std::unique_ptr<Method<dim>> (*)(
      const ConditionParameters              &parameters,
      PrescribedMotion<dim>                   motion,
      std::unique_ptr<BoundaryParticles<dim>> particles);

    /** From what a method has the traction; the first two can press and not
     * pull, and rub, the others always hold. */
    enum class TractionFrom
    {
      gap,
      multipliers, // that make the gap vanish
      functions,   // of displacement, altered near the boundary
      material     // whose state the particles carry
    };

    /** What the entry 'Enforcement' may be: a row of the table of methods. Its
     * help text and what is refused follow from it. */
    struct Kind
    {
      std::string  name;
      std::string  help;
      TractionFrom traction;

      std::tuple<MethodMaker<2>, MethodMaker<3>> make;
    };

    const std::vector<Kind> &kinds();

    const Kind &kind(const std::string &name);
  } // namespace Enforcement
} // namespace Impoint

#endif
