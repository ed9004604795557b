#include <impoint/particles/boundary_particles.h>

namespace Impoint
{
  template <int dim>
  BoundaryParticles<dim>::Slots::Slots()
    : x(layout.add("position", dim))
    , start(layout.add("start", dim))
    , normal(layout.add("normal", dim))
    , area(layout.add("area", 1))
    , gap(layout.add("gap", dim))
    , increment(layout.add("increment", dim))
    , multiplier(layout.add("multiplier", dim))
    , force(layout.add("force", dim))
  {}



  template <int dim>
  BoundaryParticles<dim>::BoundaryParticles(
    const Basis<dim>                               &basis,
    const std::string                              &name,
    const std::vector<SeededBoundaryParticle<dim>> &seeds,
    const double                                    thickness)
    : PointCloud<dim>(basis, Slots().layout)
    , boundary_name(name)
    , body_thickness(thickness)
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
          }
        state[slot.area] = seed.area * thickness;
        particles.push_back(
          {seed.cell, types::particle_index(seed.number), std::move(state)});
      }
    this->insert(particles);
  }

  template class BoundaryParticles<2>;
  template class BoundaryParticles<3>;
} // namespace Impoint
