#include <impoint/base/parameter_file.h>
#include <impoint/particles/seeding.h>
#include <impoint/setup.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    /** The expressions of a body's initial state. */
    template <int dim>
    struct InitialState
    {
      InitialState(const ParameterFile &file, const BodyParameters &body)
        : velocity(file, body.section + "/Initial velocity", dim)
        , acceleration(file, body.section + "/Initial acceleration", dim)
        , n_stresses(n_stress_components(file.value(stress_path(body))))
        , stress(file, stress_path(body), n_stresses)
      {}

      static std::string stress_path(const BodyParameters &body)
      {
        return body.section + "/Initial stress";
      }

      /** In 2D the component zz may be left out. */
      static unsigned int n_stress_components(const std::string &text)
      {
        const unsigned int n = Voigt<dim>::n;
        return dim == 2 && std::count(text.begin(), text.end(), ';') == n ?
                 n + 1 :
                 n;
      }

      Materials::Response<dim> stress_at(const Point<dim> &x) const
      {
        Materials::Response<dim> result;
        if (stress.is_zero())
          return result;
        for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
          result.stress[k] = stress.value(x, 0., k);
        if (n_stresses > Voigt<dim>::n)
          result.stress_zz = stress.value(x, 0., Voigt<dim>::n);
        return result;
      }

      Expression<dim> velocity, acceleration;
      unsigned int    n_stresses;
      Expression<dim> stress;
    };
  } // namespace



  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> place_bodies(const ParameterFile &file,
                                                    const Scene<dim>    &scene,
                                                    const Basis<dim>    &basis)
  {
    std::vector<std::shared_ptr<Materials::Material<dim>>> materials;
    std::vector<InitialState<dim>>                         initial;
    CarriedState                                           carried;
    carried.dynamic = scene.time.is_dynamic();
    for (const auto &body : scene.bodies)
      {
        materials.push_back(
          Materials::create_material<dim>(file, body.section + "/Material"));
        initial.emplace_back(file, body);
        carried.n_history =
          std::max(carried.n_history, materials.back()->n_history());
        carried.initial_stress |= !initial.back().stress.is_zero() &&
                                  !materials.back()->starts_from_stress();
      }

    auto points =
      std::make_unique<MaterialPoints<dim>>(basis, carried, materials);
    const auto &slots = points->slots();
    const auto  comm  = basis.grid().communicator();
    std::vector<typename PointCloud<dim>::NewParticle> particles;
    std::size_t                                        first_number = 0;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const BodyParameters &body  = scene.bodies[b];
        const auto            seeds = seed_body(file, body, basis.grid());
        for (const auto &seed : seeds)
          {
            std::vector<double> state(slots.layout.n_doubles(), 0.);
            const double        volume =
              seed.volume * (dim == 2 ? body.thickness : 1.);
            const auto put = [&](const unsigned int    slot,
                                 const Tensor<1, dim> &value) {
              for (unsigned int d = 0; d < dim; ++d)
                state[slot + d] = value[d];
            };
            put(slots.x, seed.x);
            for (unsigned int d = 0; d < dim; ++d)
              state[slots.F + d * dim + d] = 1.;
            state[slots.volume] = volume;
            state[slots.mass]   = volume * body.density;
            state[slots.body]   = b;
            const auto stress   = initial[b].stress_at(seed.x);
            for (const unsigned int slot : {slots.stress, slots.initial_stress})
              if (slot != PropertyLayout::absent)
                {
                  std::copy(stress.stress.begin(),
                            stress.stress.end(),
                            state.begin() + slot);
                  if (dim == 2)
                    state[slot + Voigt<dim>::n] = stress.stress_zz;
                }
            if (carried.dynamic)
              {
                put(slots.v, initial[b].velocity.vector(seed.x, 0.));
                if (scene.time.initial == "expression")
                  put(slots.a, initial[b].acceleration.vector(seed.x, 0.));
              }
            if (carried.n_history > 0)
              materials[b]->initialise(stress, state.data() + slots.history);
            particles.push_back(
              {seed.cell,
               types::particle_index(first_number + seed.number),
               std::move(state)});
          }
        first_number += Utilities::MPI::sum(seeds.size(), comm);
      }
    points->insert(particles);
    return points;
  }



  template <int dim>
  typename NonlinearSystem<dim>::Methods
  place_boundaries(const ParameterFile &file,
                   const Scene<dim>    &scene,
                   const Basis<dim>    &basis)
  {
    typename NonlinearSystem<dim>::Methods methods;
    // Areas are those of the thickness that the bodies have.
    const double thickness = dim == 2 ? scene.bodies.front().thickness : 1.;
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      if (scene.boundaries[i].kind == "nonconforming")
        methods.push_back(Enforcement::create<dim>(
          file,
          scene.conditions[i],
          std::make_unique<BoundaryParticles<dim>>(
            basis,
            scene.boundaries[i].name,
            seed_boundary(file, scene.boundaries[i], basis.grid()),
            thickness)));
    return methods;
  }



  template <int dim>
  bool check_normals(const ParameterFile          &file,
                     const BoundaryParameters     &parameters,
                     const BoundaryParticles<dim> &boundary,
                     const MaterialPoints<dim>    &points,
                     const BackgroundGrid<dim>    &grid)
  {
    std::vector<std::array<double, 2 * dim + 1>> own;
    for (unsigned int b = 0; b < boundary.n(); ++b)
      {
        own.emplace_back();
        for (unsigned int d = 0; d < dim; ++d)
          {
            own.back()[d] = boundary.position(b)[d];
            own.back()[dim + d] =
              boundary.vector(b, boundary.slots().normal)[d];
          }
        own.back()[2 * dim] = boundary.area(b);
      }
    std::vector<unsigned int> n_in_cell(grid.n_cells() + 1, 0);
    for (const auto &range : points.ranges())
      n_in_cell[range.cell] = range.end - range.begin;
    std::vector<unsigned int> begin_of_cell(grid.n_cells(), 0);
    for (const auto &range : points.ranges())
      begin_of_cell[range.cell] = range.begin;

    double wrong = 0, judged = 0;
    for (const auto &part :
         Utilities::MPI::all_gather(grid.communicator(), own))
      {
        // volume-weighted distance to the material on the outer side, and all
        std::vector<double> sides(2 * part.size() + 1, 0.);
        for (unsigned int i = 0; i < part.size(); ++i)
          {
            const double   reach = 2. * grid.smallest_size();
            Point<dim>     x, lower, upper;
            Tensor<1, dim> normal;
            for (unsigned int d = 0; d < dim; ++d)
              {
                x[d]      = part[i][d];
                normal[d] = part[i][dim + d];
                lower[d]  = x[d] - reach;
                upper[d]  = x[d] + reach;
              }
            for (const unsigned int c : grid.cells_near(lower, upper))
              for (unsigned int k = 0; k < n_in_cell[c]; ++k)
                {
                  const unsigned int   p    = begin_of_cell[c] + k;
                  const Tensor<1, dim> away = points.position(p) - x;
                  if (away.norm() > reach)
                    continue;
                  const double volume = points.data(p)[points.slots().volume];
                  sides[2 * i] += volume * (away * normal);
                  sides[2 * i + 1] += volume;
                }
          }
        Utilities::MPI::sum(sides, grid.communicator(), sides);
        for (unsigned int i = 0; i < part.size(); ++i)
          if (sides[2 * i + 1] > 0)
            {
              judged += part[i][2 * dim];
              if (sides[2 * i] > 0)
                wrong += part[i][2 * dim];
            }
      }
    if (wrong > 0.5 * judged)
      throw file.error(parameters.section + "/Flip normal",
                       "the normals of boundary '" + parameters.name +
                         "' point into the material",
                       std::string("Set Flip normal = ") +
                         (parameters.flip_normal ? "false" : "true") +
                         ", or list its corners in the opposite order.");
    return judged > 0;
  }

  template std::unique_ptr<MaterialPoints<2>>
  place_bodies(const ParameterFile &, const Scene<2> &, const Basis<2> &);
  template std::unique_ptr<MaterialPoints<3>>
  place_bodies(const ParameterFile &, const Scene<3> &, const Basis<3> &);
  template typename NonlinearSystem<2>::Methods
  place_boundaries(const ParameterFile &, const Scene<2> &, const Basis<2> &);
  template typename NonlinearSystem<3>::Methods
  place_boundaries(const ParameterFile &, const Scene<3> &, const Basis<3> &);
  template bool check_normals(const ParameterFile &,
                              const BoundaryParameters &,
                              const BoundaryParticles<2> &,
                              const MaterialPoints<2> &,
                              const BackgroundGrid<2> &);
  template bool check_normals(const ParameterFile &,
                              const BoundaryParameters &,
                              const BoundaryParticles<3> &,
                              const MaterialPoints<3> &,
                              const BackgroundGrid<3> &);
} // namespace Impoint
