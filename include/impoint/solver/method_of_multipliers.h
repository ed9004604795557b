#ifndef impoint_solver_method_of_multipliers_h
#define impoint_solver_method_of_multipliers_h

#include <impoint/solver/assembly.h>

#include <functional>
#include <vector>

namespace Impoint
{
  /**
   * Finds the multipliers of boundaries that go with a linear correction of the
   * displacements: the saddle-point problem, by solutions with the augmented
   * matrix alone (numerical multipliers lambda <- t of TractionLaw).
   *
   * One such update reduces the gap by the factor gamma, but for combinations
   * of constraints that hardly differ. So the updates are directions of a
   * generalised conjugate residual method: as many solutions as there are
   * combinations of that kind, and a few.
   */
  template <int dim>
  class MethodOfMultipliers
  {
  public:
    using Vector = typename Assembly<dim>::Vector;

    /** x = A^-1 b that improves the last solution; the numbers are looser and
     * further of LinearSolver. */
    using Solve =
      std::function<void(const Vector &, const double, const double, Vector &)>;

    MethodOfMultipliers(Assembly<dim>             &assembly,
                        Enforcement::Methods<dim> &methods,
                        const Solve               &solve);

    /** Forgets the size of forces. */
    void begin_step();

    /**
     * Improves @p delta, the correction at @p u with the present multipliers,
     * and these, until a further update changes the residual by round-off of
     * the forces in this step: @p load [N] and those of the multipliers, or @p
     * round_off [N] of the sums that make up the residual. @p reference [N] is
     * the right-hand side of delta; where a further correction follows, changes
     * that are small beside that are left to it (@p exact = false). Returns
     * what the new multipliers changed in the residual. Collective.
     */
    Vector find(const Vector &u,
                const double  load,
                const double  reference,
                const double  round_off,
                const bool    exact,
                Vector       &delta);

    /** Goes back to the part @p fraction of what the last find() changed. */
    void cut(const double fraction);

  private:
    using Multipliers = std::vector<std::vector<double>>; // per method

    /** A change of the multipliers and what it brings. */
    struct Direction
    {
      Multipliers multipliers;
      Vector      forces, displacements;
      Multipliers update; // change of what an update would add
      Vector      effect; // forces of that
    };

    /** What an update adds to the present multipliers, which stay, and its
     * forces. */
    Multipliers update(const Vector &place, Vector &forces);

    Direction next_direction(const Vector                 &place,
                             const Multipliers            &present,
                             const Multipliers            &step,
                             const Vector                 &forces,
                             const double                  looser,
                             const double                  further,
                             const std::vector<Direction> &directions);

    Multipliers get() const;
    void        set(const Multipliers &values);

    Assembly<dim>             &assembly;
    Enforcement::Methods<dim> &methods;
    const Solve                solve;
    Multipliers                before, after;
    double                     largest = 0; // force of this step [N]
  };
} // namespace Impoint

#endif
