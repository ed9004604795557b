#ifndef impoint_enforcement_implicit_boundary_h
#define impoint_enforcement_implicit_boundary_h

#include <impoint/enforcement/band_patch.h>
#include <impoint/enforcement/nodal_normals.h>
#include <impoint/enforcement/shared_constraints.h>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * The implicit boundary method: displacements u' = D u + u_a with a
     * function D that rises from 0 at the boundary to 1 within a band of width
     * delta (I Eqs. 13-16). The integrals of D' D' and D D' across the band,
     * 4 / (3 delta) and 1/2, are exact, which leaves integrals along the
     * boundary over its particles (I Eqs. 21-22, 26-28):
     *   K3 = 4 / (3 delta) int N^T (n.C.n) N,   K2 = int W B^T C n N,
     * n inward, on the gap between material and wall. W = 1/2 for a fixed
     * boundary; on a slip one D acts on the normal displacement alone, and the
     * strains of the tangential one count whole: W = 1 - n x n / 2 (I Eqs.
     * 23-24). Where two boundaries meet, their products (I Eq. 15) differ from
     * the sum in an area of delta^2 only.
     *
     * C is the elastic tangent of the virgin material in the cell: where a
     * material yields, the boundary stays as stiff. The traction at the start
     * of the step enters as the mean of the cell's points. Both only shift the
     * gap, by the order of delta.
     *
     * The band is a penalty of E/delta on each particle, which locks where a
     * boundary cuts cells anyhow: two particles pin a triangle's three nodes
     * but for one combination. Where functions can't bear that, the gap is its
     * mean over the cell or over neighbours that share it, as a multiplier's (D
     * then acts on the part of u that varies as slowly). They bear it where the
     * boundary runs along a face, or in quadrilaterals and hexahedra along a
     * direction of the cell: there the nodes of one side are as good as held.
     * On functions of higher degree it is the cell's mean, with springs
     * (spring_beside_means()).
     *
     * A slice of material thinner than the band has K2 in proportion: the band
     * goes on in the next cell, and K2 whole would make the matrix indefinite.
     */
    template <int dim>
    class ImplicitBoundary : public Method<dim>
    {
    public:
      ImplicitBoundary(const ConditionParameters              &parameters,
                       PrescribedMotion<dim>                   motion,
                       std::unique_ptr<BoundaryParticles<dim>> particles);

      void begin_step(const Step<dim> &step) override;
      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      void add_link(const unsigned int l,
                    const Strength     strength,
                    CellSystem        &system) const override;
      void end_links(
        const typename Method<dim>::LinkDisplacements &displacements) override;
      void end_step(const unsigned int r, const double *u) override;

    protected:
      void make_links(const ActiveNodes<dim> &active, Links &links) override;

    private:
      using Patch = BandPatch<dim>;

      /** What a range's particles need to know of the material. */
      struct CellState
      {
        VoigtMatrix<dim> tangent = {};
        Tensor<2, dim>   stress;     // at the start of the step
        double           filled = 0; // part of the band with material
      };

      CellState cell_state(const unsigned int r) const;
      double seen_by_material(const unsigned int r, const double volume) const;
      double band_width(const unsigned int r) const; // delta [m]
      bool   bears_each_particle(const unsigned int      r,
                                 const ActiveNodes<dim> &active) const;
      bool   holds_each_particle(const unsigned int r) const;

      Patch alone(const unsigned int r, const unsigned int b) const;
      Patch mean(const unsigned int r) const;

      double spring(const unsigned int r) const;
      void   add_springs(const unsigned int r, CellSystem &system) const;

      void add_patch(const Patch   &patch,
                     const Strength strength,
                     CellSystem    &system) const;

      const bool             slip;
      NodalNormals<dim>      normals; // of a slip boundary
      std::vector<CellState> states;  // per range

      std::vector<char>      bears_each; // per range
      SharedConstraints<dim> shared;
      std::vector<Patch>     link_patches;
      // per range, of the step
      std::vector<Tensor<1, dim>> shared_tractions, shared_gaps;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
