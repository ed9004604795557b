#ifndef impoint_enforcement_gap_method_h
#define impoint_enforcement_gap_method_h

#include <impoint/enforcement/enforcement.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * What the methods that act on a gap share: penalties and multipliers. The
     * gap is the total one, carried from step to step by the particles.
     *
     * It is taken over patches of particles, L = sum_b A_b H_b / A and
     * A = sum_b A_b: a patch is one particle, or all particles of a cell. The
     * traction on a patch,
     *   t = (lambda + gamma g) / (1 + gamma c),
     * holds a multiplier lambda that a linear solve finds by lambda <- t, whose
     * fixed point is t = g / c, or g = 0 for a compliance c = 0: the condition
     * of the matrix stays that of gamma, whatever c (numerically: no round-off
     * of 1/c erases the material's stiffness). A penalty has t = gamma g.
     */
    template <int dim>
    class GapMethod : public Method<dim>
    {
    public:
      void begin_step(const Step<dim> &step) override;
      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      bool augmented() const override;
      void update_multipliers(const unsigned int r,
                              CellSystem        &system) override;
      void remember_multipliers() override;
      void cut_multipliers(const double fraction) override;
      void end_step(const unsigned int r, const double *u) override;

    protected:
      /** How the traction on a patch follows from its gap. */
      struct Law
      {
        double gamma      = 0; // [Pa/m]
        double compliance = 0; // [m/Pa]
        bool   augmented  = false;

        double stiffness() const
        {
          return gamma / (1. + gamma * compliance);
        }
      };

      GapMethod(const ConditionParameters              &parameters,
                PrescribedMotion<dim>                   motion,
                std::unique_ptr<BoundaryParticles<dim>> particles,
                const bool                              projected);

      /** Of a patch of @p area in range @p r. */
      virtual Law law(const unsigned int r, const double area) const = 0;

      /** Whether the condition is imposed in the cell of range @p r. */
      bool takes_part(const unsigned int r) const;

      /** Whether superfluous constraints are left out. */
      bool removes_superfluous() const;

      /** Whether the small-cut rule changes the values in range @p r. */
      virtual bool raises_small_values(const unsigned int r) const;

      double unit(const unsigned int r) const; // E/h [Pa/m]

      /** The factor of the scene [Pa/m]. */
      double factor(const unsigned int r) const;

      /** @p gamma for a whole cut cell, enlarged for smaller patches: a
       * multiplier's error falls with gamma times the area. */
      double enlarge(const double       gamma,
                     const unsigned int r,
                     const double       area) const;

      static constexpr double small_cut_value = 0.01; // epsilon of P Eq. 53

      const bool projected, slip;

    private:
      static constexpr unsigned int largest_support = 64; // cubic splines in 3D

      /** Particles [begin, end) that share a gap. A slip boundary has its
       * normal gap, multiplier and traction in component 0. */
      struct Patch
      {
        unsigned int   begin = 0, end = 0;
        double         area = 0;
        Tensor<1, dim> gap; // but for the displacements of this step
        Tensor<1, dim> multiplier;
        double         values[largest_support]; // fixed: L_a
        Tensor<1, dim> rows[largest_support];   // slip: L_a
        Law            law;
      };

      void make_patch(const unsigned int r, Patch &patch) const;

      template <typename Function>
      void for_patches(const unsigned int r, const Function &function) const;

      /** Gap with the displacements @p u of the cell's @p n nodes. */
      Tensor<1, dim>
      gap(const Patch &patch, const unsigned int n, const double *u) const;

      Tensor<1, dim>
      traction(const Patch &patch, const unsigned int n, const double *u) const;

      void add_force(const Patch          &patch,
                     const Tensor<1, dim> &traction,
                     CellSystem           &system) const;
      void add_stiffness(const Patch &patch,
                         const double stiffness,
                         CellSystem  &system) const;

      void shape_values(const unsigned int b,
                        const bool         raise_small,
                        const unsigned int n,
                        double            *N) const;

      void store_force(const unsigned int    r,
                       const unsigned int    b,
                       const bool            is_multiplier,
                       const Tensor<1, dim> &t);
      void
      store_gap(const unsigned int r, const unsigned int b, const double *u);

      /** Direction in which node @p a of the cell is held at particle @p b. */
      Tensor<1, dim> direction(const unsigned int b,
                               const unsigned int compact_node) const;

      bool one_normal() const;
      void average_normals();

      std::vector<char>           left_out; // per range: superfluous
      bool                        nodal_normals = false;
      std::vector<Tensor<1, dim>> node_normals; // per active node

      // per particle: of the iterate, and before and after the correction
      std::vector<Tensor<1, dim>> multipliers, before, after;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
