#ifndef impoint_enforcement_gap_method_h
#define impoint_enforcement_gap_method_h

#include <impoint/enforcement/gap_patch.h>
#include <impoint/enforcement/jump_penalty.h>
#include <impoint/enforcement/nodal_normals.h>
#include <impoint/enforcement/proximity.h>
#include <impoint/enforcement/shared_constraints.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * What the methods that act on a gap share: penalties and multipliers. The
     * gap is the total one, carried from step to step by the particles; a patch
     * is one particle, all particles of a cell, or those of a link. Each opens,
     * sticks and slides as a whole: multipliers that are not independent
     * (SharedConstraints) would open and close in turn for ever. What touches
     * without end has springs beside its means (spring()).
     *
     * A multiplier is found within a linear solve by lambda <- t (see
     * TractionLaw), whose fixed point is t = g / c, or g = 0 for a compliance
     * c = 0. So the condition of the matrix stays that of gamma, and no
     * round-off of 1/c erases the material's stiffness.
     *
     * A releasing boundary that does not touch takes its gap from where the
     * material is; particles that touch make up the patch of their cell, or
     * those that will touch first. In a linear solve contact is what it was at
     * the last evaluation (a primal-dual active set): there the law is linear.
     */
    template <int dim>
    class GapMethod : public Method<dim>,
                      public MultiplierUpdates,
                      public ContactStates
    {
    public:
      void begin_step(const Step<dim> &step) override;
      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      void add_link(const unsigned int l,
                    const Strength     strength,
                    CellSystem        &system) const override;
      bool is_linear() const override;
      bool is_symmetric() const override;
      void end_links(
        const typename Method<dim>::LinkDisplacements &displacements) override;
      void end_step(const unsigned int r, const double *u) override;

      MultiplierUpdates *multiplier_updates() override
      {
        return this;
      }
      bool                augmented() const override;
      void                update_multipliers(const unsigned int r,
                                             CellSystem        &system) override;
      void                update_link_multipliers(const unsigned int l,
                                                  CellSystem        &system) override;
      bool                exchange_multipliers() override;
      void                add_exchange(const unsigned int r,
                                       CellSystem        &system) const override;
      std::vector<double> multipliers() const override;
      void set_multipliers(const std::vector<double> &values) override;

      ContactStates *contact_states() override
      {
        return this;
      }
      void begin_correction() override;
      bool contact_changed() const override;
      bool contact_settled() const override;
      void freeze(const bool wanted) override;

    protected:
      using Patch = GapPatch<dim>;

      GapMethod(const ConditionParameters              &parameters,
                PrescribedMotion<dim>                   motion,
                std::unique_ptr<BoundaryParticles<dim>> particles,
                const bool                              projected);

      /** Of a patch of @p area in range @p r, but for contact. */
      virtual TractionLaw law(const unsigned int r,
                              const double       area) const = 0;

      /** Whether the small-cut rule changes the values in range @p r. */
      virtual bool raises_small_values(const unsigned int r) const;

      /** Whether neighbouring cells share constraints (SharedConstraints). */
      bool shares_constraints() const;

      void make_links(const ActiveNodes<dim> &active, Links &links) override;

      double unit(const unsigned int r) const; // E/h [Pa/m]

      /** Of the springs that hold each particle's own gap beside the mean, no
       * stiffer than what the scene asks for: of a penalty they are a part
       * [Pa/m]. */
      double spring(const unsigned int r) const;

      /** The factor of the scene [Pa/m]. */
      double factor(const unsigned int r) const;

      /** @p gamma for a whole cut cell, enlarged for smaller patches: a
       * multiplier's error falls with gamma times the area. */
      double enlarge(const double       gamma,
                     const unsigned int r,
                     const double       area) const;

      static constexpr double small_cut_value = 0.01; // epsilon of P Eq. 53

    private:
      bool   takes_part(const unsigned int r) const;
      double friction() const;
      bool   removes_superfluous() const;
      bool   stabilises() const;
      void   tell_multipliers();
      void   make_link_patches();

      template <typename Function>
      void for_patches(const unsigned int r, const Function &function) const;

      Patch make_patch(const unsigned int r,
                       const unsigned int begin,
                       const unsigned int end) const;

      void set_law(const unsigned int r, Patch &patch) const;

      /** A particle's own gap. */
      Patch alone(const unsigned int r, const unsigned int b) const;

      /** Adds particle @p b with @p weight = A_b / A. */
      void add_particle(const unsigned int r,
                        const unsigned int b,
                        const double       weight,
                        Patch             &patch) const;

      void shape_values(const unsigned int r,
                        const unsigned int b,
                        const unsigned int n,
                        double            *N) const;

      bool           is_closed(const unsigned int b) const;
      bool           is_near(const unsigned int b) const;
      double         away(const unsigned int b) const;
      bool           is_in(const Patch &patch, const unsigned int b) const;
      Tensor<1, dim> start_gap(const unsigned int b) const;

      typename Patch::Answer answer(const Patch &patch, const double *u) const;
      bool                   reverses(const Patch                   &patch,
                                      const typename Patch::Contact &contact) const;
      Tensor<1, dim> linear_traction(const Patch &patch, const double *u) const;

      void add_patch(const Patch                  &patch,
                     const typename Patch::Answer &answer,
                     const unsigned int            r,
                     const Strength                strength,
                     CellSystem                   &system) const;

      void add_springs(const unsigned int r,
                       const Strength     strength,
                       CellSystem        &system) const;

      void store(const unsigned int            r,
                 const double                 *u,
                 const Patch                  &patch,
                 const typename Patch::Answer &answer,
                 const Tensor<1, dim>         &common_gap);

      const bool projected;
      const bool normal_only; // whether only the normal gap counts
      const bool factor_has_unit;

      std::vector<double>    sizes; // per range: h of its cell
      NodalNormals<dim>      normals;
      std::vector<char>      left_out;  // per range: superfluous
      std::vector<Proximity> proximity; // per particle, of a releasing boundary
      std::vector<char>      near;      // the same, at the start of the step

      // per particle: multiplier of the iterate; what the patch that it begins
      // did last, and where the correction began; after these, links' patches
      std::vector<Tensor<1, dim>>                  multiplier;
      mutable std::vector<typename Patch::Contact> contacts;
      std::vector<typename Patch::Contact>         first_contacts;
      bool                                         frozen = false;

      JumpPenalty<dim>       jumps;
      SharedConstraints<dim> shared;
      std::vector<Patch>     link_patches; // with the multiplier now
      // per range, of the step
      std::vector<Tensor<1, dim>> shared_tractions, shared_gaps;
      std::vector<double>         shared_reaches;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
