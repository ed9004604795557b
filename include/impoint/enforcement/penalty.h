#ifndef impoint_enforcement_penalty_h
#define impoint_enforcement_penalty_h

#include <impoint/enforcement/enforcement.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Penalty on a gap g: traction t = beta g (P Eqs. 42-43; slip: Eqs. 45-50).
     * The gap is the total one, carried from step to step by the particles.
     *
     * The gap is taken over patches of particles, L = sum_b A_b H_b / A and
     * A = sum_b A_b, with stiffness beta A L^T L. Particle-wise, a patch is one
     * particle. Projected, it is all particles of a cell: tends to the solution
     * with one multiplier a cell and does not lock.
     *
     * Where beta exceeds 1e8 E/h the same traction is found by augmentation at
     * gamma = 1e8 E/h with compliance 1/beta (perturbed Lagrangian),
     *   t = (lambda + gamma g) / (1 + gamma / beta),  lambda <- t,
     * whose fixed point is t = beta g: the condition of the matrix stays that
     * of gamma, and no round-off of beta erases the stiffness.
     */
    template <int dim>
    class Penalty : public Method<dim>
    {
    public:
      Penalty(const ConditionParameters              &parameters,
              PrescribedMotion<dim>                   motion,
              std::unique_ptr<BoundaryParticles<dim>> particles,
              const bool                              projected);

      void begin_step(const Step<dim> &step) override;
      bool augmented() const override;
      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      void update_multipliers(const unsigned int r, const double *u) override;
      void end_step(const unsigned int r, const double *u) override;

    private:
      /** Particles [begin, end) that share a gap. A slip boundary has its
       * normal gap, multiplier and traction in component 0. */
      struct Patch
      {
        unsigned int   begin = 0, end = 0;
        double         area = 0;
        Tensor<1, dim> gap; // but for the displacements of this step
        Tensor<1, dim> multiplier;
        double         values[64]; // fixed: L_a
        Tensor<1, dim> rows[64];   // slip: L_a
      };

      void make_patch(const unsigned int r, Patch &patch) const;

      template <typename Function>
      void for_patches(const unsigned int r, const Function &function) const;

      /** Gap with the displacements @p u of the cell's @p n nodes. */
      Tensor<1, dim>
      gap(const Patch &patch, const unsigned int n, const double *u) const;

      Tensor<1, dim>
      traction(const unsigned int r, const Patch &patch, const double *u) const;

      void
      shape_values(const unsigned int b, const unsigned int n, double *N) const;

      /** Direction in which node @p a of the cell is held at particle @p b. */
      Tensor<1, dim> direction(const unsigned int b,
                               const unsigned int compact_node) const;

      void average_normals();

      double unit(const unsigned int r) const; // E/h [Pa/m]
      double beta(const unsigned int r) const; // [Pa/m]
      bool   is_augmented(const unsigned int r) const;
      double gamma(const unsigned int r, const Patch &patch) const; // [Pa/m]

      const bool                  projected, slip;
      bool                        nodal_normals = false;
      std::vector<Tensor<1, dim>> node_normals; // per active node
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
