#ifndef impoint_enforcement_nitsche_h
#define impoint_enforcement_nitsche_h

#include <impoint/enforcement/nodal_normals.h>

#include <array>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Nitsche's method: the traction with which the boundary holds the material
     * is the material's own, P N at the particle, which carries F and the
     * state of the body it bounds. With the held gap g, a length l and
     *   F^ = F - g x N / l
     * the boundary adds the potential
     *   l (W(F^) - W(F)) + 1/2 g.G.g,   G = factor n.C.n / h,
     * per area at the start, which is -(P N).g + ... : consistent, and
     * exact tangents of both parts come from the material's tangent. Forces
     * and moments of the residual balance exactly, as W does not change with
     * rotations. The non-symmetric form turns the sign of the terms that are
     * the derivative of P N times g. The incomplete one leaves them out: this
     * derivative is the material's tangent, which jumps where material yields,
     * so with them the residual of a plastic material has kinks, in which
     * Newton's method stays or meets an indefinite matrix.
     *
     * h is at most the width of the material in the cut cell (its volume there
     * over the area): the functions that see a sliver of it alone would make
     * the matrix indefinite. Both h and n are those of the start of the run, n
     * with the length that F at the start of the step gives it in space.
     */
    template <int dim>
    class Nitsche : public Method<dim>
    {
    public:
      Nitsche(const ConditionParameters              &parameters,
              PrescribedMotion<dim>                   motion,
              std::unique_ptr<BoundaryParticles<dim>> particles);

      void begin_step(const Step<dim> &step) override;
      void add(const unsigned int r,
               const Strength     strength,
               CellSystem        &system) const override;
      bool is_symmetric() const override;
      bool holds_by_particle() const override
      {
        return true;
      }
      void end_step(const unsigned int r, const double *u) override;
      void follow_material(const unsigned int r, const double *u) override;

    private:
      /** The material at a particle. */
      struct Side
      {
        Materials::Deformation<dim> deformation;
        Materials::Response<dim>    response;
        Tensor<2, dim>              stress;    // Kirchhoff's
        Tensor<2, dim>              inverse;   // of F; small strains: 1
        std::vector<Tensor<1, dim>> gradients; // of the nodes, at the end

        /** Change of stress with the displacement gradient @p l (P Eqs. 11,
         * 12): c : sym l + l tau; the latter if @p geometric. */
        Tensor<2, dim> change(const Tensor<2, dim> &l,
                              const bool            geometric) const;
      };

      /** The condition at a particle. */
      struct Condition
      {
        bool                        finite;    // strains
        double                      length;    // l [m]
        Tensor<1, dim>              gap;       // held part, in space
        Tensor<2, dim>              stiffness; // G [Pa/m]
        double                      moderate;  // part of it for a V-cycle
        Tensor<1, dim>              normal;    // of the start, to the end by F^
        std::vector<Tensor<2, dim>> share; // held part of a node's displacement
        Side                        as_is, closed; // with F, and with F^

        /** Displacement gradient for the component @p i of node @p a, with F
         * and with F^. */
        std::array<Tensor<2, dim>, 2> variation(const unsigned int a,
                                                const unsigned int i) const;
      };

      MaterialState  material(const unsigned int b) const;
      Tensor<2, dim> deformation_gradient(const unsigned int b) const;
      double         factor() const;
      void           deform(const unsigned int b,
                            const unsigned int n,
                            const double      *u,
                            Condition         &condition) const;
      void           evaluate_gap(const unsigned int r,
                                  const unsigned int b,
                                  const unsigned int n,
                                  const double      *u,
                                  Condition         &condition) const;
      void           evaluate(const unsigned int r,
                              const unsigned int b,
                              const unsigned int n,
                              const double      *u,
                              const bool         tangent_wanted,
                              Condition         &condition) const;
      void           add_residual(const double     area,
                                  const Condition &condition,
                                  CellSystem      &system) const;
      void           add_matrix(const double     area,
                                const Condition &condition,
                                CellSystem      &system) const;

      const bool          slip, chooses_motion;
      const double        sign; // of the adjoint terms
      NodalNormals<dim>   normals;
      std::vector<double> widths; // of the material, per range; 0: none
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
