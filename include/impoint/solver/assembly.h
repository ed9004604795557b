#ifndef impoint_solver_assembly_h
#define impoint_solver_assembly_h

#include <impoint/enforcement/enforcement.h>
#include <impoint/particles/nearby_stiffness.h>
#include <impoint/solver/inertia.h>
#include <impoint/solver/linear_solver.h>
#include <impoint/terms/consistent_mass.h>
#include <impoint/terms/empty_cells.h>
#include <impoint/terms/ghost_penalty.h>
#include <impoint/terms/hourglass.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /**
   * Goes over the active cells and adds up what terms and boundaries
   * contribute to the residual (P Eq. 15) and the tangent (P Eq. 16).
   */
  template <int dim>
  class Assembly
  {
  public:
    using Vector  = LinearAlgebra::distributed::Vector<double>;
    using Methods = Enforcement::Methods<dim>;

    enum class Part
    {
      all,
      loads,      // material, inertia and tractions
      constraints // boundaries that hold, empty cells and lumped inertia
    };

    Assembly(const ActiveNodes<dim>    &active,
             const MaterialPoints<dim> &points,
             Methods                   &methods);

    /** Terms that act in material cells, added once. */
    void add_term(std::unique_ptr<Term<dim>> term);

    /** Holds what is filled in part only; see GhostPenalty. */
    void set_ghost_penalty(const double factor)
    {
      ghost_penalty.set_factor(factor);
    }
    const GhostPenalty<dim> &ghosts() const
    {
      return ghost_penalty;
    }

    /** What reaches beyond a cell in a step from @p start to @p end, of the
     * cells that are active now. Collective. */
    Links find_links(const double start, const double end);

    /** See GhostPenalty. */
    void set_reached(const std::vector<unsigned int> &cells)
    {
      ghost_penalty.set_reached(cells);
    }

    /** After the set of active cells or links changed. */
    void new_active_set();

    /** After points changed their cells: finds the cells that have too few of
     * them and returns how many there are on all ranks. Collective. */
    std::size_t find_starved_cells();

    /** What acts in the step is known. @p displacement_before: of the nodes of
     * a kept grid at the start of the step, or null. */
    void begin_step(const Vector *displacement_before);

    /**
     * Sets @p residual, and if wanted the matrix of @p problem (as this rank's
     * sum; conforming boundaries not yet eliminated) and its moderate variant.
     * Returns the size of the forces that balance in the residual. Throws
     * StepFailed on all ranks if a material has no answer. Collective.
     */
    double assemble(const Vector       &u,
                    const Part          part,
                    const bool          tangent_wanted,
                    const bool          moderate_wanted,
                    const Vector       &external,
                    const Inertia<dim> *inertia,
                    LinearProblem<dim> &problem,
                    Vector             &residual);

    /** Displacements of the nodes of group @p k. */
    void gather(const unsigned int   k,
                const Vector        &u,
                std::vector<double> &cell_u) const;

    /** New multipliers from the gaps at @p u; @p change receives what that
     * changes in the residual. Collective. */
    void update_multipliers(const Vector &u, Vector &change);

    /** [N], of the inertia force at @p u after the last assemble() had inertia.
     * Collective. */
    double inertia_norm(const Vector &u) const;

  private:
    void assemble_material(const Vector &u,
                           const bool    tangent_wanted,
                           const Part    part);
    void assemble_boundaries(const Vector &u,
                             const bool    tangent_wanted,
                             const Part    part);
    void begin_cell(const unsigned int k,
                    const bool         tangent_wanted,
                    CellSystem        &system);
    template <typename Function>
    void add_boundary(const unsigned int k,
                      const Vector      &u,
                      const bool         tangent_wanted,
                      const Part         part,
                      const Function    &contribute);
    void assemble_ghost_penalty(const Vector &u,
                                const bool    tangent_wanted,
                                const Part    part);
    bool has_mass_matrix(const Part part) const;
    void accelerations_of(const unsigned int k);

    CellSystem since_start(const unsigned int k, const CellSystem &system);

    void add_inertia(const Vector &u, const bool tangent_wanted);
    void scatter(const unsigned int k, BlockMatrix<dim> &matrix) const;
    void scatter_residual(const unsigned int k);

    const ActiveNodes<dim>                 &active;
    const MaterialPoints<dim>              &points;
    Methods                                &methods;
    NearbyStiffness<dim>                    nearby_stiffness;
    EmptyCells<dim>                         empty_cells;
    Hourglass<dim>                          hourglass;
    std::vector<char>                       in_contact; // per active cell
    ConsistentMass<dim>                     consistent_mass;
    std::vector<std::unique_ptr<Term<dim>>> terms;
    GhostPenalty<dim>                       ghost_penalty;

    // of the call of assemble() at work
    LinearProblem<dim> *problem = nullptr;
    const Inertia<dim> *inertia = nullptr;
    const Vector       *kept_u  = nullptr; // before the step
    Vector              rest;

    // of the group at work
    std::vector<double> whole_u; // since the start
    std::vector<double> cell_u, cell_accelerations, cell_residual, cell_matrix;
  };
} // namespace Impoint

#endif
