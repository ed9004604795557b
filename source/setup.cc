#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/particles/seeding.h>
#include <impoint/setup.h>

#include <deal.II/boost_adaptors/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

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



    template <int dim>
    void put_stress(const Materials::Response<dim> &stress,
                    const unsigned int              slot,
                    double                         *state)
    {
      if (slot == PropertyLayout::absent)
        return;
      std::copy(stress.stress.begin(), stress.stress.end(), state + slot);
      if (dim == 2)
        state[slot + Voigt<dim>::n] = stress.stress_zz;
    }



    /** What a point of body @p b carries when the run begins. */
    template <int dim>
    std::vector<double> initial_state(const Scene<dim>          &scene,
                                      const unsigned int         b,
                                      const InitialState<dim>   &initial,
                                      const SeededPoint<dim>    &seed,
                                      const MaterialPoints<dim> &points)
    {
      const BodyParameters &body    = scene.bodies[b];
      const auto           &slots   = points.slots();
      const CarriedState   &carried = points.carried();
      std::vector<double>   state(slots.layout.n_doubles(), 0.);
      const auto            put = [&](const unsigned int    slot,
                           const Tensor<1, dim> &value) {
        for (unsigned int d = 0; d < dim; ++d)
          state[slot + d] = value[d];
      };
      put(slots.x, seed.x);
      if (carried.keeps_grid)
        put(slots.start, seed.x);
      for (unsigned int d = 0; d < dim; ++d)
        state[slots.F + d * dim + d] = 1.;
      state[slots.volume] = seed.volume * (dim == 2 ? body.thickness : 1.);
      state[slots.mass]   = state[slots.volume] * body.density;
      state[slots.body]   = b;
      const auto stress   = initial.stress_at(seed.x);
      put_stress(stress, slots.stress, state.data());
      put_stress(stress, slots.initial_stress, state.data());
      if (carried.dynamic)
        {
          put(slots.v, initial.velocity.vector(seed.x, 0.));
          if (scene.time.initial == InitialAcceleration::expression)
            put(slots.a, initial.acceleration.vector(seed.x, 0.));
        }
      if (carried.n_history > 0)
        points.material_of_body(b).initialise(stress,
                                              state.data() + slots.history);
      return state;
    }



    /** Numbers of the bodies that have the material points nearest to this
     * rank's @p places: the lowest of several. Collective. */
    template <int dim>
    std::vector<unsigned int>
    nearest_bodies(const MaterialPoints<dim>     &points,
                   const unsigned int             n_bodies,
                   const std::vector<Point<dim>> &places,
                   const MPI_Comm                 communicator)
    {
      namespace bgi = boost::geometry::index;
      using Nearest = std::pair<double, unsigned int>; // squared distance
      std::vector<std::vector<Point<dim>>> of_bodies(n_bodies);
      for (unsigned int p = 0; p < points.n(); ++p)
        of_bodies[points.body(p)].push_back(points.position(p));
      std::vector<RTree<Point<dim>>> bodies;
      for (const auto &of_body : of_bodies)
        bodies.push_back(pack_rtree(of_body));

      const auto asked = Utilities::MPI::all_gather(communicator, places);
      std::vector<std::vector<Nearest>> answers(asked.size());
      for (unsigned int rank = 0; rank < asked.size(); ++rank)
        for (const Point<dim> &x : asked[rank])
          {
            Nearest nearest(std::numeric_limits<double>::max(), 0);
            for (unsigned int b = 0; b < bodies.size(); ++b)
              for (auto p = bodies[b].qbegin(bgi::nearest(x, 1));
                   p != bodies[b].qend();
                   ++p)
                nearest = std::min(nearest, Nearest((*p - x).norm_square(), b));
            answers[rank].push_back(nearest);
          }
      const auto answered   = Utilities::MPI::all_gather(communicator, answers);
      const unsigned int me = Utilities::MPI::this_mpi_process(communicator);
      std::vector<unsigned int> result;
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          Nearest nearest = answered[0][me][i];
          for (const auto &of_rank : answered)
            nearest = std::min(nearest, of_rank[me][i]);
          result.push_back(nearest.second);
        }
      return result;
    }



    /** The virgin state of the material that the particles bound. Collective.
     */
    template <int dim>
    void give_material(const ParameterFile       &file,
                       const Scene<dim>          &scene,
                       const MaterialPoints<dim> &points,
                       const MPI_Comm             communicator,
                       BoundaryParticles<dim>    &particles)
    {
      std::vector<Point<dim>> places;
      for (unsigned int b = 0; b < particles.n(); ++b)
        places.push_back(particles.position(b));
      std::vector<unsigned int> bodies(particles.n(), 0);
      if (scene.bodies.size() > 1)
        bodies =
          nearest_bodies(points, scene.bodies.size(), places, communicator);

      const auto                    &slots = particles.slots();
      std::vector<InitialState<dim>> initial;
      for (const BodyParameters &body : scene.bodies)
        initial.emplace_back(file, body);
      on_all_ranks(communicator, [&]() {
        for (unsigned int b = 0; b < particles.n(); ++b)
          {
            double *state     = particles.data(b);
            state[slots.body] = bodies[b];
            const auto stress = initial[bodies[b]].stress_at(places[b]);
            put_stress(stress, slots.stress, state);
            put_stress(stress, slots.initial_stress, state);
            if (particles.carried().n_history > 0)
              points.material_of_body(bodies[b]).initialise(stress,
                                                            state +
                                                              slots.history);
          }
      });
    }
  } // namespace



  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> without_points(const ParameterFile &file,
                                                      const Scene<dim> &scene,
                                                      const Basis<dim> &basis)
  {
    std::vector<std::shared_ptr<Materials::Material<dim>>> materials;
    CarriedState                                           carried;
    carried.dynamic    = scene.time.is_dynamic();
    carried.keeps_grid = scene.grid.is_kept();
    if (dim == 2)
      carried.thickness = scene.bodies.front().thickness;
    for (const auto &body : scene.bodies)
      {
        materials.push_back(
          Materials::create_material<dim>(file, body.section + "/Material"));
        carried.n_history =
          std::max(carried.n_history, materials.back()->n_history());
        carried.initial_stress |=
          !InitialState<dim>(file, body).stress.is_zero() &&
          !materials.back()->starts_from_stress();
      }
    return std::make_unique<MaterialPoints<dim>>(basis,
                                                 carried,
                                                 std::move(materials));
  }



  template <int dim>
  std::unique_ptr<MaterialPoints<dim>> place_bodies(const ParameterFile &file,
                                                    const Scene<dim>    &scene,
                                                    const Basis<dim>    &basis)
  {
    auto       points = without_points(file, scene, basis);
    const auto comm   = basis.grid().communicator();
    std::vector<typename PointCloud<dim>::NewParticle> particles;
    std::size_t                                        first_number = 0;
    for (unsigned int b = 0; b < scene.bodies.size(); ++b)
      {
        const BodyParameters   &body  = scene.bodies[b];
        const auto              seeds = seed_body(file, body, basis.grid());
        const InitialState<dim> initial(file, body);
        on_all_ranks(comm, [&]() {
          try
            {
              for (const auto &seed : seeds)
                particles.push_back(
                  {seed.cell,
                   types::particle_index(first_number + seed.number),
                   initial_state(scene, b, initial, seed, *points)});
            }
          catch (const RunFailed &not_finite)
            {
              throw InputError(not_finite.what(),
                               "section '" + body.section + "'",
                               "Write an expression that is finite at all "
                               "points of the body.");
            }
        });
        const auto n_seeds = Utilities::MPI::sum(seeds.size(), comm);
        if (n_seeds == 0)
          throw InputError("body '" + body.name + "' has no points",
                           "section '" + body.section + "'",
                           "Let its shape and the grid overlap: the grid must "
                           "hold the whole body.");
        first_number += n_seeds;
      }
    points->insert(particles);
    return points;
  }



  template <int dim>
  typename NonlinearSystem<dim>::Methods
  place_boundaries(const ParameterFile       &file,
                   const Scene<dim>          &scene,
                   const Basis<dim>          &basis,
                   const MaterialPoints<dim> &points,
                   const bool                 with_particles)
  {
    typename NonlinearSystem<dim>::Methods methods;
    // Areas are those of the thickness that the bodies have.
    const double thickness = dim == 2 ? scene.bodies.front().thickness : 1.;
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      if (scene.has_particles(i))
        {
          CarriedByBoundary carried;
          carried.keeps_grid     = points.carried().keeps_grid;
          carried.material       = scene.conditions[i].carries_material();
          carried.initial_stress = points.carried().initial_stress;
          carried.n_history      = points.carried().n_history;
          if (carried.material && carried.n_history > 0 &&
              scene.conditions[i].nitsche_form == NitscheForm::symmetric)
            throw file.error(
              scene.boundaries[i].section + "/Nitsche form",
              "the symmetric form of Nitsche's method holds a plastic "
              "material: its forces jump where the material yields",
              "Set Nitsche form = incomplete, or take the entry away.");
          methods.push_back(Enforcement::create<dim>(
            file,
            scene.conditions[i],
            std::make_unique<BoundaryParticles<dim>>(
              basis,
              scene.boundaries[i].name,
              with_particles ?
                seed_boundary(file, scene.boundaries[i], basis.grid()) :
                std::vector<SeededBoundaryParticle<dim>>(),
              thickness,
              carried)));
          if (carried.material && with_particles)
            give_material(file,
                          scene,
                          points,
                          basis.grid().communicator(),
                          methods.back()->particles());
        }
    return methods;
  }



  template std::unique_ptr<MaterialPoints<2>>
  without_points(const ParameterFile &, const Scene<2> &, const Basis<2> &);
  template std::unique_ptr<MaterialPoints<2>>
  place_bodies(const ParameterFile &, const Scene<2> &, const Basis<2> &);
  template std::unique_ptr<MaterialPoints<3>>
  without_points(const ParameterFile &, const Scene<3> &, const Basis<3> &);
  template std::unique_ptr<MaterialPoints<3>>
  place_bodies(const ParameterFile &, const Scene<3> &, const Basis<3> &);
  template typename NonlinearSystem<2>::Methods
  place_boundaries(const ParameterFile &,
                   const Scene<2> &,
                   const Basis<2> &,
                   const MaterialPoints<2> &,
                   const bool);
  template typename NonlinearSystem<3>::Methods
  place_boundaries(const ParameterFile &,
                   const Scene<3> &,
                   const Basis<3> &,
                   const MaterialPoints<3> &,
                   const bool);
} // namespace Impoint
