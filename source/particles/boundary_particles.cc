#include <impoint/base/voigt.h>
#include <impoint/particles/boundary_particles.h>

namespace Impoint
{
  namespace
  {
    // Kirchhoff stress, Voigt; then its zz in 2D
    template <int dim>
    constexpr unsigned int n_stress = Voigt<dim>::n + (dim == 2 ? 1 : 0);
  } // namespace



  template <int dim>
  BoundaryParticles<dim>::Slots::Slots(const CarriedByBoundary &carried)
    : x(layout.add("position", dim))
    , start(layout.add("start", dim))
    , normal(layout.add("normal", dim))
    , area(layout.add("area", 1))
    , held(layout.add("held area", 1))
    , gap(layout.add("gap", dim))
    , increment(layout.add("increment", dim))
    , multiplier(layout.add("multiplier", dim))
    , force(layout.add("force", dim))
    , u(layout.add("displacement", carried.keeps_grid ? dim : 0))
    , start_normal(layout.add("start normal", carried.material ? dim : 0))
    , F(layout.add("deformation gradient", carried.material ? dim * dim : 0))
    , stress(layout.add("stress", carried.material ? n_stress<dim> : 0))
    , body(layout.add("body", carried.material ? 1 : 0))
    , initial_stress(layout.add("initial stress",
                                carried.material && carried.initial_stress ?
                                  n_stress<dim> :
                                  0))
    , history(layout.add("history", carried.material ? carried.n_history : 0))
    , couple(layout.add("couple", carried.material ? (dim == 2 ? 1 : 3) : 0))
  {}



  template <int dim>
  BoundaryParticles<dim>::BoundaryParticles(
    const Basis<dim>                               &basis,
    const std::string                              &name,
    const std::vector<SeededBoundaryParticle<dim>> &seeds,
    const double                                    thickness,
    const CarriedByBoundary                        &carried)
    : PointCloud<dim>(basis,
                      Slots(carried).layout,
                      carried.keeps_grid ? Slots(carried).start : 0)
    , boundary_name(name)
    , body_thickness(thickness)
    , carried_state(carried)
    , slot(carried)
  {
    std::vector<typename PointCloud<dim>::NewParticle> particles;
    for (const auto &seed : seeds)
      {
        std::vector<double> state(slot.layout.n_doubles(), 0.);
        for (unsigned int d = 0; d < dim; ++d)
          {
            state[slot.x + d]      = seed.x[d];
            state[slot.start + d]  = seed.x[d];
            state[slot.normal + d] = seed.normal[d];
            if (carried.material)
              {
                state[slot.start_normal + d]  = seed.normal[d];
                state[slot.F + d * (dim + 1)] = 1.;
              }
          }
        state[slot.area] = seed.area * thickness;
        state[slot.held] = state[slot.area];
        particles.push_back(
          {seed.cell, types::particle_index(seed.number), std::move(state)});
      }
    this->insert(particles);
  }



  template <int dim>
  double BoundaryParticles<dim>::held_area_of_range(const unsigned int r) const
  {
    const auto &range = this->ranges()[r];
    double      sum   = 0;
    for (unsigned int b = range.begin; b < range.end; ++b)
      sum += held_area(b);
    return sum;
  }



  template <int dim>
  HalfSpace<dim>
  BoundaryParticles<dim>::material_side(const unsigned int r) const
  {
    const auto    &range = this->ranges()[r];
    double         sum   = 0;
    Tensor<1, dim> centre;
    HalfSpace<dim> side;
    for (unsigned int b = range.begin; b < range.end; ++b)
      {
        sum += area(b);
        centre += area(b) * Tensor<1, dim>(this->position(b));
        side.normal += area(b) * vector(b, slot.normal);
      }
    side.point = Point<dim>(centre / sum);
    side.normal /= sum;
    return side;
  }

  template class BoundaryParticles<2>;
  template class BoundaryParticles<3>;
} // namespace Impoint
