#ifndef impoint_enforcement_traction_law_h
#define impoint_enforcement_traction_law_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

namespace Impoint
{
  using namespace dealii;

  namespace Enforcement
  {
    /** What a boundary does where it is. */
    enum class Touch : char
    {
      open,
      sticks,
      slides
    };

    /**
     * The traction that a boundary puts against a gap g: t = (lambda + gamma g)
     * / (1 + gamma c), with a multiplier lambda if augmented and a compliance
     * c. A releasing boundary takes no tension (P Eq. 55); Coulomb friction
     * bounds the tangential part by mu times the normal one.
     */
    struct TractionLaw
    {
      double gamma      = 0; // [Pa/m]
      double compliance = 0; // [m/Pa]
      bool   augmented  = false;
      bool   releasing  = false;
      double friction   = -1; // mu; negative: without bound

      double stiffness() const
      {
        return gamma / (1. + gamma * compliance);
      }

      /** What becomes of the traction @p t without bounds. */
      template <int dim>
      Touch touch(const Tensor<1, dim> &normal, const Tensor<1, dim> &t) const
      {
        const double pressure = normal * t;
        if (releasing && !(pressure > 0))
          return Touch::open;
        if (friction >= 0 && (t - pressure * normal).norm() > bound(pressure))
          return Touch::slides;
        return Touch::sticks;
      }

      /**
       * Cuts the traction @p t to what @p touch allows; returns the derivative
       * of what is left by what was, not symmetric where it slides.
       */
      template <int dim>
      Tensor<2, dim> cut(const Touch           touch,
                         const Tensor<1, dim> &normal,
                         Tensor<1, dim>       &t) const
      {
        const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
        if (touch == Touch::open)
          {
            t = Tensor<1, dim>();
            return Tensor<2, dim>();
          }
        if (touch != Touch::slides)
          return one;
        const double         pressure = normal * t;
        const Tensor<1, dim> along    = t - pressure * normal;
        const double         length   = along.norm();
        if (length == 0)
          return one;
        const double         part   = bound(pressure) / length;
        const Tensor<2, dim> across = outer_product(normal, normal);
        const Tensor<1, dim> way    = along / length;
        Tensor<2, dim>       change =
          across + part * (one - across - outer_product(way, way));
        if (pressure > 0)
          change += friction * outer_product(way, normal);
        t = pressure * normal + part * along;
        return change;
      }

    private:
      double bound(const double pressure) const
      {
        return pressure > 0 ? friction * pressure : 0.;
      }
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
