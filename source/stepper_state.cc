// What Stepper shows, stores to go on from, and goes on from.

#include <impoint/particles/stored_particles.h>
#include <impoint/solver/stored_nodes.h>
#include <impoint/stepper.h>

namespace Impoint
{
  template <int dim>
  Measurements::State<dim> Stepper<dim>::state() const
  {
    return {*points,
            methods,
            active,
            now,
            last_step,
            forces,
            newton->residuals(),
            totals,
            system->strain_of_forces(),
            [this]() { return system->condition_numbers(); }};
  }



  /** Those of all boundaries: in the order of the scene, summed over the
   * ranks. */
  template <int dim>
  void Stepper<dim>::sum_forces(
    const std::vector<Measurements::BoundaryForce<dim>> &held,
    const std::vector<Measurements::BoundaryForce<dim>> &nonconforming)
  {
    unsigned int next_held = 0, next_nonconforming = 0;
    forces.clear();
    for (unsigned int i = 0; i < scene.boundaries.size(); ++i)
      {
        forces.push_back(scene.has_particles(i) ?
                           nonconforming[next_nonconforming++] :
                           held[next_held++]);
        forces.back().force  = Utilities::MPI::sum(forces.back().force, comm);
        forces.back().moment = Utilities::MPI::sum(forces.back().moment, comm);
      }
  }



  /** Whether the last step had inertia: not before the first one that has. */
  template <int dim>
  bool Stepper<dim>::has_moved() const
  {
    return counters.steps > 0 && scene.time.moves_after(now - last_step);
  }



  template <int dim>
  void Stepper<dim>::save_or_load(StateArchive &archive)
  {
    archive &now &last_step &inertia.largest_energy();
  }



  template <int dim>
  void Stepper<dim>::store(StateArchive &archive)
  {
    store_particles(*points, grid, archive);
    for (const auto &method : methods)
      {
        archive.tag(method->particles().name());
        store_particles(method->particles(), grid, archive);
      }
    if (scene.grid.is_kept() && counters.steps > 0)
      store_nodes(active, kept_u, archive);
    if (scene.grid.is_kept() && has_moved())
      for (Vector *vector : inertia.carried())
        store_nodes(active, *vector, archive);
  }



  template <int dim>
  void Stepper<dim>::restore(StoredPieces &pieces, const double dt)
  {
    const OwnCells cells = own_cells(grid);
    restore_particles(pieces, cells, comm, *points);
    for (const auto &method : methods)
      {
        pieces.for_each([&](StateArchive &archive) {
          archive.tag(method->particles().name());
        });
        restore_particles(pieces, cells, comm, method->particles());
      }
    if (scene.grid.is_kept() && counters.steps > 0)
      {
        activate(dt);
        restore_nodes(pieces, cells, active, kept_u);
      }
    if (scene.grid.is_kept() && has_moved())
      {
        inertia.project(active, *points, system->ghosts(), dt);
        for (Vector *vector : inertia.carried())
          restore_nodes(pieces, cells, active, *vector);
        inertia.set_carried();
      }
  }



  template class Stepper<2>;
  template class Stepper<3>;
} // namespace Impoint
