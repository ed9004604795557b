#include <impoint/enforcement/implicit_boundary.h>
#include <impoint/enforcement/kinds.h>
#include <impoint/enforcement/lagrange_multiplier.h>
#include <impoint/enforcement/nitsche.h>
#include <impoint/enforcement/penalty.h>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      template <typename Class, int dim, auto... options>
      std::unique_ptr<Method<dim>>
      make(const ConditionParameters              &parameters,
           PrescribedMotion<dim>                   motion,
           std::unique_ptr<BoundaryParticles<dim>> particles)
      {
        return std::make_unique<Class>(parameters,
                                       std::move(motion),
                                       std::move(particles),
                                       options...);
      }



      /** The row of a class, whose constructor takes these options, too. */
      template <template <int> class Class, auto... options>
      Kind row(const std::string &name,
               const std::string &help,
               const TractionFrom traction)
      {
        return {name,
                help,
                traction,
                {make<Class<2>, 2, options...>, make<Class<3>, 3, options...>}};
      }
    } // namespace



    const std::vector<Kind> &kinds()
    {
      static const std::vector<Kind> table = {
        row<Penalty, false>("penalty",
                            "on each particle's gap (P Eqs. 42-43)",
                            TractionFrom::gap),
        row<Penalty, true>("projected penalty",
                           "on the mean gap of each cell, which does not lock",
                           TractionFrom::gap),
        row<LagrangeMultiplier, false>("lagrange multiplier",
                                       "one for each cell (L)",
                                       TractionFrom::multipliers),
        row<LagrangeMultiplier, true>(
          "augmented Lagrangian",
          "the same, from a penalty factor of yours",
          TractionFrom::multipliers),
        row<ImplicitBoundary>("implicit boundary",
                              "displacements that vanish at the boundary by "
                              "construction (I)",
                              TractionFrom::functions),
        row<Nitsche>("nitsche",
                     "by the traction of the material itself, which the "
                     "particles carry",
                     TractionFrom::material)};
      return table;
    }



    const Kind &kind(const std::string &name)
    {
      for (const Kind &row : kinds())
        if (row.name == name)
          return row;
      AssertThrow(false, ExcMessage("No enforcement is called '" + name + "'"));
      return kinds().front();
    }
  } // namespace Enforcement
} // namespace Impoint
