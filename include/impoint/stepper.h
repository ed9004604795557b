#ifndef impoint_stepper_h
#define impoint_stepper_h

#include <impoint/base/stored_pieces.h>
#include <impoint/grid/hinges.h>
#include <impoint/measurements/measurement.h>
#include <impoint/scene.h>
#include <impoint/solver/newton.h>
#include <impoint/terms/body_force.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** What looks on while steps are done. All members are collective. */
  template <int dim>
  class StepObserver
  {
  public:
    using Vector = LinearAlgebra::distributed::Vector<double>;
    using State  = Measurements::State<dim>;

    virtual ~StepObserver() = default;

    /** Whether begin() wants the forces at the start of the run. */
    virtual bool wants_first_forces() const = 0;

    /** Before the first step, if wanted. */
    virtual void begin(const State &state) = 0;

    /** All is ready to be solved. */
    virtual void prepared(const State &state) = 0;

    /** The step @p u is found, nothing has moved yet. */
    virtual void follow(const State &state, const Vector &u) = 0;

    /** All is at its new place. */
    virtual void end_step(const State &state, const Vector &u) = 0;
  };

  /**
   * Implicit MPM: grid, points and boundaries of a scene, and how a step
   * changes them. The members are the modules in the order of the computation;
   * a step goes through them: activate, project, solve, move.
   */
  template <int dim>
  class Stepper
  {
  public:
    using Vector = typename StepObserver<dim>::Vector;

    /** Builds the grid and places all particles, or, if not @p with_particles,
     * leaves that to restore(). Collective; throws InputError. */
    Stepper(ParameterFile    &file,
            const Scene<dim> &scene,
            const bool        with_particles,
            const MPI_Comm    communicator,
            Counters         &counters,
            Seconds          &seconds);

    /** Makes the cells active that a step of length @p dt needs. */
    void activate(const double dt);

    /** A step of length @p dt. Throws StepFailed, with all as it was if
     * is_whole(), or RunFailed. */
    void advance(const double dt, StepObserver<dim> &observer);

    /** Whether all is the state of one time, not in the middle of an update. */
    bool is_whole() const
    {
      return whole;
    }

    /** The next step's matrices know nothing of those before. */
    void start_solver_anew()
    {
      solver_starts_anew = true;
    }

    /** Drops what a failed step left. */
    void forget_displacements()
    {
      u.reinit(0);
    }

    Measurements::State<dim> state() const;

    /** What a message on the next step, of length @p dt, begins with. */
    std::string of_step(const double dt) const;

    double time() const
    {
      return now;
    }

    /** Of the last step on the active nodes, or empty. */
    const Vector &displacements() const
    {
      return u;
    }

    std::string solver_description() const
    {
      return system->solver_description();
    }

    /** What is the same on all ranks. */
    void save_or_load(StateArchive &archive);

    /** This rank's part of the rest. */
    void store(StateArchive &archive);

    /** From what all ranks stored, before a step of length @p dt. Collective.
     */
    void restore(StoredPieces &pieces, const double dt);

  private:
    void begin_step(const double dt, const double end);
    void start_motion(const double dt, StepObserver<dim> &observer);
    void find_new_places();
    void commit(const double dt, StepObserver<dim> &observer);
    void end_boundaries();
    void update_material(const bool moves);
    void move();
    void sum_forces(
      const std::vector<Measurements::BoundaryForce<dim>> &held,
      const std::vector<Measurements::BoundaryForce<dim>> &nonconforming);
    bool has_moved() const;

    const Scene<dim>                      &scene;
    MPI_Comm                               comm;
    Counters                              &counters;
    Seconds                               &seconds;
    BackgroundGrid<dim>                    grid;
    Basis<dim>                             basis;
    ActiveNodes<dim>                       active;
    Hinges<dim>                            hinges;
    std::vector<BodyLoad<dim>>             body_loads;
    std::unique_ptr<MaterialPoints<dim>>   points;
    NearbyStiffness<dim>                   nearby_stiffness;
    EndStates<dim>                         end_states;
    Enforcement::Conforming<dim>           conforming;
    typename NonlinearSystem<dim>::Methods methods;
    Inertia<dim>                           inertia;
    std::unique_ptr<NonlinearSystem<dim>>  system;
    std::unique_ptr<Newton<dim>>           newton;

    double now = 0, last_step = 0; // [s]
    Vector u;
    Vector kept_u; // of a kept grid's nodes since the start
    bool   points_changed_cells = true;
    bool   solver_starts_anew   = false;
    bool   whole                = true;
    std::vector<std::vector<Point<dim>>>          boundary_places; // per method
    std::vector<Measurements::BoundaryForce<dim>> forces;
    Measurements::Totals<dim>                     totals;
  };
} // namespace Impoint

#endif
