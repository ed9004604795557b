#ifndef impoint_enforcement_band_patch_h
#define impoint_enforcement_band_patch_h

#include <impoint/base/voigt.h>
#include <impoint/terms/term.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    using namespace dealii;

    /**
     * Particles of an implicit boundary that share a gap g = g_0 + sum_a S_a
     * u_a and a traction t = t_0 + k g + sum_a T_a u_a: one, those of a cell or
     * of a link. All but the area are means over its particles. The sum of k is
     * K3, that of T_a is K2 (ImplicitBoundary). On a slip boundary gap and
     * traction are those along the normal, in component 0.
     */
    template <int dim>
    struct BandPatch
    {
      explicit BandPatch(const unsigned int n_nodes);

      Tensor<1, dim> gap(const double *u) const;
      Tensor<1, dim> traction(const double *u) const;

      /** Adds to the residual, and to the matrix K3 times @p part and, if @p
       * with_flux, K2. */
      void
      add(const double part, const bool with_flux, CellSystem &system) const;

      /** Sum over the nodes of S_a^T t. */
      Tensor<1, dim> total(const Tensor<1, dim> &traction) const;

      /** Adds @p part, whose nodes are at @p places of these: until all are
       * there, sums weighted by areas. */
      void add_part(const BandPatch                 &part,
                    const std::vector<unsigned int> &places);
      void divide_by_area();

      /** As numbers, and back; returns what follows. */
      void          pack(std::vector<double> &numbers) const;
      const double *unpack(const double *numbers);

      unsigned int                n_nodes;
      double                      area = 0;
      Tensor<1, dim>              start_gap, start_traction; // g_0, t_0
      Tensor<2, dim>              stiffness;                 // k [Pa/m]
      std::vector<Tensor<2, dim>> share, flux;               // S_a, T_a
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
