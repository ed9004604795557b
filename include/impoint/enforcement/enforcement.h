#ifndef impoint_enforcement_enforcement_h
#define impoint_enforcement_enforcement_h

#include <impoint/enforcement/capabilities.h>
#include <impoint/enforcement/condition.h>
#include <impoint/grid/active_nodes.h>
#include <impoint/particles/boundary_particles.h>
#include <impoint/particles/nearby_stiffness.h>
#include <impoint/terms/term.h>

#include <functional>
#include <memory>
#include <vector>

namespace Impoint
{
  /** Methods that impose conditions on nonconforming boundaries. */
  namespace Enforcement
  {
    /** What all methods are told at the start of a step. */
    template <int dim>
    struct Step
    {
      double                      start = 0, end = 0; // time [s]
      double                      ghost_penalty = 0;  // factor; 0: none
      bool                        dynamic       = false;
      const ActiveNodes<dim>     *active        = nullptr;
      const MaterialPoints<dim>  *points        = nullptr;
      const NearbyStiffness<dim> *stiffness     = nullptr;
    };

    /** Strength with which a method adds itself to a matrix. */
    enum class Strength
    {
      exact,     // the tangent
      moderate,  // what the preconditioner's V-cycle can bear
      constraint // what holds alone, without the stiffness of the material
    };

    /** Of Strength::moderate, in units of E/h or n.C.n/h. */
    constexpr double moderate_factor = 10.;

    /**
     * One nonconforming boundary and how its condition is imposed. A new
     * method is a header, a source and a row in kinds.cc.
     *
     * All methods contribute cell by cell, on the cells of their particles, or
     * on links, which reach beyond a cell (see ActiveNodes).
     */
    template <int dim>
    class Method
    {
    public:
      Method(const ConditionParameters              &parameters,
             PrescribedMotion<dim>                   motion,
             std::unique_ptr<BoundaryParticles<dim>> particles);
      virtual ~Method() = default;

      const BoundaryParticles<dim> &particles() const
      {
        return *boundary;
      }
      BoundaryParticles<dim> &particles()
      {
        return *boundary;
      }
      const ConditionParameters &parameters() const
      {
        return condition;
      }

      /** Whether the condition acts in the step. */
      bool is_active() const
      {
        return active_now;
      }

      /** Prepares a step: the wall's increments, normals. Collective. */
      virtual void begin_step(const Step<dim> &step);

      /** Adds the particles of range @p r (PointCloud::ranges()). */
      virtual void add(const unsigned int r,
                       const Strength     strength,
                       CellSystem        &system) const = 0;

      /** Makes its links for a step from @p start to @p end, of the cells that
       * are active now, behind those that are there. Collective. */
      void find_links(const double            start,
                      const double            end,
                      const ActiveNodes<dim> &active,
                      Links                  &links);

      /** Places among all links of the first of its links and behind the last.
       */
      unsigned int begin_link() const
      {
        return first_link;
      }
      unsigned int end_link() const
      {
        return last_link;
      }

      /** Adds its link @p l (0: the first it made). */
      virtual void add_link(const unsigned int l,
                            const Strength     strength,
                            CellSystem        &system) const;

      /** Whether add() with a matrix makes the tangent stiffer, so that the
       * preconditioner has to know these cells. */
      virtual bool constrains() const
      {
        return true;
      }

      /** Whether tractions are linear in the displacements: no contact. */
      virtual bool is_linear() const
      {
        return true;
      }

      /** Whether its part of the matrix is symmetric: without friction. */
      virtual bool is_symmetric() const
      {
        return true;
      }

      /** Whether only those particles hold that have material before them: each
       * for itself, while means over a cell hold all of it. */
      virtual bool holds_by_particle() const
      {
        return false;
      }

      /** Its multipliers; null: the condition holds without. */
      virtual MultiplierUpdates *multiplier_updates()
      {
        return nullptr;
      }

      /** What of it touches and slides; null: all does. */
      virtual ContactStates *contact_states()
      {
        return nullptr;
      }

      /** Puts the displacements of the nodes of its link @p l into @p u. */
      using LinkDisplacements =
        std::function<void(const unsigned int l, std::vector<double> &u)>;

      /** Before end_step(): what links did in the converged step. Collective.
       */
      virtual void end_links(const LinkDisplacements &displacements);

      /** Stores gap, force and multiplier of the converged step for range
       * @p r; @p u is null where the condition does not act. */
      virtual void end_step(const unsigned int r, const double *u) = 0;

      /** Brings up to date what the particles of range @p r carry of the
       * material, whether the condition acts or not; after end_step(). */
      virtual void follow_material(const unsigned int r, const double *u);

      /** Where the material at particle @p b is at the end of the step, as far
       * as the grid knows; after follow_material(). */
      Tensor<1, dim> material_place(const unsigned int b,
                                    const unsigned int n,
                                    const double      *u) const;

      /** Where the particles will be at the end of the step: of the particles
       * in range @p r, with the cell's displacements @p u. */
      void new_places(const unsigned int       r,
                      const double            *u,
                      std::vector<Point<dim>> &places) const;

      /** Moves the particles to @p places, which PointCloud::find() was asked
       * for before. Collective. */
      void finish_step(const std::vector<Point<dim>> &places);

      /** Whether particles move in this step. */
      bool moves() const;

    protected:
      /** Appends what find_links() asks for. Collective. */
      virtual void make_links(const ActiveNodes<dim> &active, Links &links);

      /** Displacement of the material at particle @p b. */
      Tensor<1, dim> displacement(const unsigned int b,
                                  const unsigned int n,
                                  const double      *u) const;

      ConditionParameters                     condition;
      PrescribedMotion<dim>                   motion;
      std::unique_ptr<BoundaryParticles<dim>> boundary;
      Step<dim>                               current;
      bool                                    active_now = false;

    private:
      unsigned int first_link = 0, last_link = 0;
    };

    template <int dim>
    using Methods = std::vector<std::unique_ptr<Method<dim>>>;

    /** Calls function(r, k) for the ranges r of @p method's particles whose
     * cell is active, k being its place among the active ones. */
    template <int dim, typename Function>
    void for_active_ranges(const Method<dim>      &method,
                           const ActiveNodes<dim> &active,
                           const Function         &function)
    {
      const auto &ranges = method.particles().ranges();
      for (unsigned int r = 0; r < ranges.size(); ++r)
        {
          const unsigned int k = active.position(ranges[r].cell);
          if (k != BackgroundGrid<dim>::nowhere)
            function(r, k);
        }
    }

    /** Calls function(l, k) for the links l of @p method, k being their group
     * of nodes. */
    template <int dim, typename Function>
    void for_links(const Method<dim>      &method,
                   const ActiveNodes<dim> &active,
                   const Function         &function)
    {
      for (unsigned int l = method.begin_link(); l < method.end_link(); ++l)
        function(l - method.begin_link(), active.link(l));
    }

    /** This rank's cells with particles of the methods that act from @p start
     * to @p end, or of @p all, increasing. */
    template <int dim>
    std::vector<unsigned int> cells(const Methods<dim> &methods,
                                    const double        start,
                                    const double        end,
                                    const bool          all = false);

    /** The method named by @p parameters. Throws InputError. */
    template <int dim>
    std::unique_ptr<Method<dim>>
    create(const ParameterFile                    &file,
           const ConditionParameters              &parameters,
           std::unique_ptr<BoundaryParticles<dim>> particles);
  } // namespace Enforcement
} // namespace Impoint

#endif
