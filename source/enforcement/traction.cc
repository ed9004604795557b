#include <impoint/enforcement/traction.h>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    Traction<dim>::Traction(const ConditionParameters              &parameters,
                            PrescribedMotion<dim>                   motion,
                            std::unique_ptr<BoundaryParticles<dim>> particles,
                            Expression<dim>                         traction)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , traction(std::move(traction))
    {}



    template <int dim>
    Tensor<1, dim> Traction<dim>::force(const unsigned int b) const
    {
      const Point<dim> start(
        this->boundary->vector(b, this->boundary->slots().start));
      return this->boundary->area(b) *
             traction.vector(start, this->current.end);
    }



    template <int dim>
    void Traction<dim>::add(const unsigned int r,
                            const Strength,
                            CellSystem &system) const
    {
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          const Tensor<1, dim> load = force(b);
          for (unsigned int a = 0; a < system.n; ++a)
            for (unsigned int d = 0; d < dim; ++d)
              system.residual[a * dim + d] -=
                this->boundary->support(b)[a] * load[d];
        }
    }



    template <int dim>
    void Traction<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        this->boundary->set_vector(b,
                                   this->boundary->slots().force,
                                   u != nullptr ? force(b) : Tensor<1, dim>());
    }

    template class Traction<2>;
    template class Traction<3>;
  } // namespace Enforcement
} // namespace Impoint
