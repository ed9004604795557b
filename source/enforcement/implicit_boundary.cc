#include <impoint/enforcement/acoustic_tensor.h>
#include <impoint/enforcement/implicit_boundary.h>
#include <impoint/enforcement/particle_springs.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    ImplicitBoundary<dim>::ImplicitBoundary(
      const ConditionParameters              &parameters,
      PrescribedMotion<dim>                   motion,
      std::unique_ptr<BoundaryParticles<dim>> particles)
      : Method<dim>(parameters, std::move(motion), std::move(particles))
      , slip(parameters.constraint == Constraint::slip)
    {}



    template <int dim>
    double ImplicitBoundary<dim>::band_width(const unsigned int r) const
    {
      const auto &grid = this->current.active->basis().grid();
      return this->condition.band_width *
             grid.size(this->boundary->ranges()[r].cell);
    }



    /** Part of a cell's material, of @p volume, that K2 in the mean of range
     * @p r can lean on: a corner of size s sees (s/h)^(dim p - 1) of the
     * gradient that the boundary beside it sees of the farthest function. */
    template <int dim>
    double ImplicitBoundary<dim>::seen_by_material(const unsigned int r,
                                                   const double volume) const
    {
      const auto &basis = this->current.active->basis();
      if (holds_each_particle(r) ||
          (basis.grid().simplicial() && basis.degree() == 1))
        return volume;
      const double     h = basis.grid().size(this->boundary->ranges()[r].cell);
      constexpr double corner = 0.01; // larger ones hold K2 well enough
      const double     part =
        volume / this->boundary->thickness() / Utilities::fixed_power<dim>(h);
      const double power = 2. * basis.degree() - 2. / dim;
      return part < corner ? volume * std::pow(part, power) : volume;
    }



    template <int dim>
    typename ImplicitBoundary<dim>::CellState
    ImplicitBoundary<dim>::cell_state(const unsigned int r) const
    {
      const auto        &active = *this->current.active;
      const auto        &points = *this->current.points;
      const unsigned int k = active.position(this->boundary->ranges()[r].cell);
      CellState          state;
      if (k >= active.n_material_cells())
        {
          // without material, and so without a traction
          state.tangent =
            this->current.stiffness->material(this->boundary->ranges()[r].cell)
              .elastic_tangent();
          return state;
        }
      const auto &range  = points.ranges()[k];
      double      volume = 0;
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          const double  part   = points.data(p)[points.slots().volume];
          const double *stress = points.data(p) + points.slots().stress;
          volume += part;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              state.stress[i][j] += part * stress[Voigt<dim>::position(i, j)];
        }
      state.stress /= volume;
      // of a band without material before it nothing is asked
      const double area = this->boundary->held_area_of_range(r);
      if (area > 0)
        state.filled =
          std::min(1., seen_by_material(r, volume) / (band_width(r) * area));
      state.tangent = points.material(range.begin).elastic_tangent();
      return state;
    }



    template <int dim>
    void ImplicitBoundary<dim>::begin_step(const Step<dim> &step)
    {
      Method<dim>::begin_step(step);
      states.assign(this->boundary->ranges().size(), CellState());
      if (this->active_now && slip)
        normals.reinit(this->condition.normals, *this, *step.active);
      if (!this->active_now)
        return;
      for_active_ranges(*this,
                        *step.active,
                        [&](const unsigned int r, const unsigned int) {
                          states[r] = cell_state(r);
                        });
      link_patches = shared.template collect<Patch>(
        *step.active,
        this->begin_link(),
        [](const unsigned int n) { return Patch(n); },
        [&](const unsigned int r) { return mean(r); });
    }



    /** Whether the cell's functions can follow each particle of range @p r. */
    template <int dim>
    bool ImplicitBoundary<dim>::bears_each_particle(
      const unsigned int      r,
      const ActiveNodes<dim> &active) const
    {
      // what differs by less does not matter beside delta
      constexpr double   alike = 1e-6;
      const auto        &slots = this->boundary->slots();
      const auto        &range = this->boundary->ranges()[r];
      const unsigned int n     = active.basis().n_nodes_of(range.cell);
      const auto         all   = [&](const auto &holds) {
        for (unsigned int b = range.begin; b < range.end; ++b)
          if (!holds(b))
            return false;
        return true;
      };
      if (active.basis().grid().simplicial())
        {
          for (unsigned int a = 0; a < n; ++a)
            if (all([&](const unsigned int b) {
                  return std::abs(this->boundary->support(b)[a]) < alike;
                }))
              return true;
          return false;
        }
      for (unsigned int d = 0; d < dim; ++d)
        if (all([&](const unsigned int b) {
              // of the cell's coordinate d, the sum of half of the functions
              Tensor<1, dim>       gradient;
              const double        *gradients = this->boundary->support(b) + n;
              const Tensor<1, dim> normal =
                this->boundary->vector(b, slots.normal);
              for (unsigned int a = 0; a < n; ++a)
                if ((a >> d) & 1)
                  for (unsigned int i = 0; i < dim; ++i)
                    gradient[i] += gradients[a * dim + i];
              const Tensor<1, dim> along =
                gradient - (gradient * normal) * normal;
              return along.norm() < alike * gradient.norm();
            }))
          return true;
      return false;
    }



    template <int dim>
    bool ImplicitBoundary<dim>::holds_each_particle(const unsigned int r) const
    {
      return bears_each[r] || shared.is_lonely(r);
    }



    template <int dim>
    void ImplicitBoundary<dim>::make_links(const ActiveNodes<dim> &active,
                                           Links                  &links)
    {
      const Superfluous choice = this->condition.superfluous;
      const auto       &ranges = this->boundary->ranges();
      bears_each.assign(ranges.size(), true);
      for_active_ranges(
        *this, active, [&](const unsigned int r, const unsigned int) {
          bears_each[r] =
            choice == Superfluous::keep ||
            (choice == Superfluous::automatic &&
             ConstrainedCells<dim>::nodes_are_vertices(active.basis(),
                                                       ranges[r].cell) &&
             bears_each_particle(r, active));
        });
      shared.find_groups(*this->boundary, active, [&](const unsigned int r) {
        return !bears_each[r];
      });
      shared.append_links(links);
    }



    template <int dim>
    BandPatch<dim> ImplicitBoundary<dim>::alone(const unsigned int r,
                                                const unsigned int b) const
    {
      const auto          &slots   = this->boundary->slots();
      const CellState     &state   = states[r];
      const Tensor<1, dim> outward = this->boundary->vector(b, slots.normal);
      const Tensor<2, dim> one     = unit_symmetric_tensor<dim>();
      const Tensor<2, dim> weight =
        state.filled *
        (slip ? one - 0.5 * outer_product(outward, outward) : 0.5 * one);
      // what is held, of a vector: the whole or its part along the normal
      Tensor<1, dim> first;
      first[0]                  = 1.;
      const Tensor<2, dim> held = slip ? outer_product(first, outward) : one;

      const auto nodes = this->current.active->nodes(
        this->current.active->position(this->boundary->ranges()[r].cell));
      Patch patch(nodes.size());
      patch.area      = this->boundary->held_area(b);
      patch.start_gap = this->boundary->vector(b, slots.gap) -
                        held * this->boundary->vector(b, slots.increment);
      patch.start_traction =
        -0.5 * state.filled * (held * (state.stress * outward));
      patch.stiffness = 4. / (3. * band_width(r)) * held *
                        acoustic_tensor(outward, state.tangent, outward) *
                        transpose(held);
      const double *N         = this->boundary->support(b);
      const double *gradients = N + nodes.size();
      for (unsigned int a = 0; a < nodes.size(); ++a)
        {
          patch.share[a] =
            N[a] *
            (slip ?
               outer_product(first,
                             normals.direction(*this->boundary, b, nodes[a])) :
               one);
          Tensor<1, dim> gradient;
          for (unsigned int d = 0; d < dim; ++d)
            gradient[d] = gradients[a * dim + d];
          patch.flux[a] = -1. * held *
                          acoustic_tensor(outward, state.tangent, gradient) *
                          weight;
        }
      return patch;
    }



    /** Of all particles of range @p r. */
    template <int dim>
    BandPatch<dim> ImplicitBoundary<dim>::mean(const unsigned int r) const
    {
      const auto &range = this->boundary->ranges()[r];
      Patch       patch(this->current.active->basis().n_nodes_of(range.cell));
      std::vector<unsigned int> places(patch.n_nodes);
      std::iota(places.begin(), places.end(), 0);
      for (unsigned int b = range.begin; b < range.end; ++b)
        patch.add_part(alone(r, b), places);
      patch.divide_by_area();
      return patch;
    }



    template <int dim>
    void ImplicitBoundary<dim>::add_patch(const Patch   &patch,
                                          const Strength strength,
                                          CellSystem    &system) const
    {
      // moderate_factor / h over 4 / (3 delta)
      const double part =
        strength == Strength::moderate ?
          std::min(1., 0.75 * moderate_factor * this->condition.band_width) :
          1.;
      patch.add(part, strength == Strength::exact, system);
    }



    /** Of particles whose cell is held by a mean [Pa/m]: softer than what the
     * preconditioner can bear. */
    template <int dim>
    double ImplicitBoundary<dim>::spring(const unsigned int r) const
    {
      if (holds_each_particle(r))
        return 0;
      const unsigned int cell = this->boundary->ranges()[r].cell;
      return spring_beside_means(this->current) *
             this->current.stiffness->young(cell) /
             this->current.active->basis().grid().size(cell);
    }



    template <int dim>
    void ImplicitBoundary<dim>::add_springs(const unsigned int r,
                                            CellSystem        &system) const
    {
      const double k = spring(r);
      if (k == 0)
        return;
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        if (this->boundary->held_area(b) > 0)
          {
            Patch spring = alone(r, b);
            spring.flux.assign(spring.n_nodes, {});
            spring.start_traction = {};
            spring.stiffness      = k * unit_symmetric_tensor<dim>();
            spring.add(1., false, system);
          }
    }



    template <int dim>
    void ImplicitBoundary<dim>::add(const unsigned int r,
                                    const Strength     strength,
                                    CellSystem        &system) const
    {
      add_springs(r, system);
      if (shared.contains(r) || this->boundary->held_area_of_range(r) == 0)
        return;
      if (!holds_each_particle(r))
        return add_patch(mean(r), strength, system);
      const auto &range = this->boundary->ranges()[r];
      for (unsigned int b = range.begin; b < range.end; ++b)
        add_patch(alone(r, b), strength, system);
    }



    template <int dim>
    void ImplicitBoundary<dim>::add_link(const unsigned int l,
                                         const Strength     strength,
                                         CellSystem        &system) const
    {
      add_patch(link_patches[l], strength, system);
    }



    template <int dim>
    void ImplicitBoundary<dim>::end_links(
      const typename Method<dim>::LinkDisplacements &displacements)
    {
      std::vector<Tensor<1, dim>> tractions, gaps;
      std::vector<double>         u;
      for (unsigned int l = 0; l < link_patches.size(); ++l)
        {
          displacements(l, u);
          tractions.push_back(link_patches[l].traction(u.data()));
          gaps.push_back(link_patches[l].gap(u.data()));
        }
      const MPI_Comm comm = this->current.active->basis().grid().communicator();
      shared_tractions    = shared.distribute(tractions, comm);
      shared_gaps         = shared.distribute(gaps, comm);
    }



    /** Particles remember the gap that is held: the mean where it alone is (see
     * GapMethod). */
    template <int dim>
    void ImplicitBoundary<dim>::end_step(const unsigned int r, const double *u)
    {
      const auto    &slots = this->boundary->slots();
      const auto    &range = this->boundary->ranges()[r];
      Tensor<1, dim> traction, gap;
      if (u != nullptr && shared.contains(r))
        {
          traction = shared_tractions[r];
          gap      = shared_gaps[r];
        }
      else if (u != nullptr && !holds_each_particle(r) &&
               this->boundary->held_area_of_range(r) > 0)
        {
          const Patch patch = mean(r);
          traction          = patch.traction(u);
          gap               = patch.gap(u);
        }
      const double k = u != nullptr ? spring(r) : 0.;
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          // what comes here next is met without a gap
          Tensor<1, dim> force;
          if (u != nullptr)
            {
              const Patch patch = alone(r, b);
              if (holds_each_particle(r) || k > 0)
                gap = patch.gap(u);
              if (holds_each_particle(r))
                traction = patch.traction(u);
              force = -patch.area * patch.total(traction + k * gap);
            }
          this->boundary->set_vector(b, slots.force, force);
          this->boundary->set_vector(b, slots.gap, gap);
        }
    }

    template class ImplicitBoundary<2>;
    template class ImplicitBoundary<3>;
  } // namespace Enforcement
} // namespace Impoint
