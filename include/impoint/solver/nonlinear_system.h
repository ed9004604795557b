#ifndef impoint_solver_nonlinear_system_h
#define impoint_solver_nonlinear_system_h

#include <impoint/base/condition_numbers.h>
#include <impoint/enforcement/conforming.h>
#include <impoint/solver/assembly.h>
#include <impoint/solver/method_of_multipliers.h>
#include <impoint/solver/parallel_solver.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * Balance of momentum on the active nodes: residual (P Eq. 15) and tangent
   * (P Eq. 16) of all terms, boundaries included, as functions of the
   * displacements of the step.
   */
  template <int dim>
  class NonlinearSystem
  {
  public:
    using Vector  = typename Assembly<dim>::Vector;
    using Methods = Enforcement::Methods<dim>;

    NonlinearSystem(const ActiveNodes<dim>             &active,
                    const MaterialPoints<dim>          &points,
                    Methods                            &methods,
                    const Enforcement::Conforming<dim> &conforming,
                    const LinearSolverParameters       &parameters,
                    Counters                           &counters,
                    Seconds                            &seconds);

    /** Terms that act in material cells, added once. */
    void add_term(std::unique_ptr<Term<dim>> term);

    /** See Assembly. */
    void set_ghost_penalty(const double factor)
    {
      assembly.set_ghost_penalty(factor);
    }
    const GhostPenalty<dim> &ghosts() const
    {
      return assembly.ghosts();
    }
    Links find_links(const double start, const double end)
    {
      return assembly.find_links(start, end);
    }

    /** See GhostPenalty. */
    void set_reached(const std::vector<unsigned int> &cells)
    {
      assembly.set_reached(cells);
    }

    /** After the set of active cells or links changed. */
    void new_active_set();

    /** After points changed their cells: which cells have too few of them. */
    void find_starved_cells();

    /** Prepares a step. @p external are the loads that do not depend on its
     * displacements. @p inertia may be null, and so is @p displacement_before
     * but for a kept grid, whose nodes were displaced by it. */
    void begin_step(const double        start,
                    const double        end,
                    const Vector       &external,
                    const Inertia<dim> *inertia,
                    const Vector       *displacement_before = nullptr);

    /** Whether one iteration solves the step. */
    bool is_linear() const;

    /** Whether the boundaries' stiffness costs the material's more digits in
     * the matrix than a solution should lose. Collective. */
    bool is_stiff() const;

    /** Whether some condition holds by multipliers. */
    bool is_augmented() const;

    /**
     * Residual at @p u (ghost values up to date), relative to the forces that
     * balance in it; and the tangent if wanted. Throws StepFailed on all ranks
     * if a material has no answer. Collective.
     */
    double evaluate(const Vector &u, const bool tangent_wanted);

    /** [N], of the last evaluation. What it is relative to may fall with it,
     * where no force is left in the end. */
    double residual_norm() const
    {
      return norm;
    }

    /**
     * The relative residual that round-off leaves at @p u: of displacements
     * times the stiffest entry of the matrix (penalties), and of strains that
     * F stores beside 1. Collective.
     */
    double round_off(const Vector &u) const;

    /** Forces in the last balance, by those of a strain of one in a cell. */
    double strain_of_forces() const;

    /** Whether round-off at @p u can be a millionth of the loads. Collective.
     */
    bool may_lose_digits(const Vector &u) const;

    /** What a place, at the size of a cell, cannot tell from none [m]. */
    double smallest_displacement() const;

    /**
     * Newton's correction for the last tangent and residual, at @p u. @p first
     * adds the displacements that conforming boundaries prescribe. Brings
     * multipliers up to date. @p looser tolerances are enough. Collective.
     */
    void correct(const bool    first,
                 const Vector &u,
                 Vector       &delta,
                 const double  looser = 1.);

    /** Cuts the last correction of multipliers to the part @p fraction. */
    void cut_multipliers(const double fraction);

    /** Whether contact or friction make kinks in the forces. */
    bool has_kinks() const;

    /** Whether the last evaluation met one since the last correction.
     * Collective. */
    bool contact_changed() const;

    /** Whether the last evaluation took all contact as the law says.
     * Collective. */
    bool contact_settled() const;

    /** What touches and slides goes on doing so, or not any longer. */
    void freeze(const bool wanted);

    /** Whether the last correction holds displacements that conforming
     * boundaries prescribe, on any rank. */
    bool brings_prescribed() const
    {
      return prescribed;
    }

    /** What reaction() tells becomes that of nothing moved and no inertia;
     * begin_step() comes before. Collective. */
    void balance_at_rest();

    /** Accelerations with which the first step begins (M a = f), as the
     * boundaries allow, and the displacements @p w at which boundaries exert
     * the forces of that balance; begin_step() comes before. Collective. */
    void initial_acceleration(Vector &accelerations, Vector &w);

    /** Residual relative to the forces, of the linearised problem after the
     * last correction: all that a linear step leaves. */
    double linear_residual(const Vector &delta) const;

    const std::vector<Enforcement::HeldNode<dim>> &held_nodes() const
    {
      return held;
    }

    bool has_held_nodes() const; // on any rank

    /** Force on the held node along its held direction @p k: what the residual
     * of the last evaluation leaves there. */
    Tensor<1, dim> reaction(const Enforcement::HeldNode<dim> &node,
                            const unsigned int                k) const;

    /** Displacements of active cell @p k's nodes. */
    void gather(const unsigned int   k,
                const Vector        &u,
                std::vector<double> &cell_u) const;

    /** Of the last tangent, without what conforming boundaries hold; none if it
     * is not symmetric. Costs tens of solves, more where these iterate.
     * Collective. */
    ConditionNumbers condition_numbers();

    std::string solver_description() const
    {
      return solver.description();
    }

  private:
    bool   moderate_wanted() const; // whether the solver will use it
    double force_scale() const;
    double force_scale_of_strain() const;
    // [N], of the residual at the displacements u + delta; collective
    double round_off_of_forces(const Vector &u, const Vector &delta) const;
    void   prescribe(const bool first, Vector &delta);
    void   prepare_solver();
    void   solve(const Vector &right, const double looser, Vector &delta);
    double correction_looser() const;

    const ActiveNodes<dim>                 &active;
    const MaterialPoints<dim>              &points;
    Methods                                &methods;
    const Enforcement::Conforming<dim>     &conforming;
    Counters                               &counters;
    Seconds                                &seconds;
    Assembly<dim>                           assembly;
    std::vector<Enforcement::HeldNode<dim>> held;

    LinearProblem<dim>       problem;
    ParallelSolver<dim>      solver;
    MethodOfMultipliers<dim> multipliers;
    bool                     new_problem = true; // since the solver last heard
    bool                     new_matrix  = true;
    bool                     indefinite  = false; // the tangent
    Vector                   external, rest, full_rest;
    const Inertia<dim>      *inertia    = nullptr;
    double                   scale      = 0; // forces that balance [N]
    double                   norm       = 0; // of the last residual [N]
    bool                     prescribed = false;
    Vector multiplier_forces; // what new multipliers changed in the residual
  };
} // namespace Impoint

#endif
