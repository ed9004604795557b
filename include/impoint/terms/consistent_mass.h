#ifndef impoint_terms_consistent_mass_h
#define impoint_terms_consistent_mass_h

#include <impoint/particles/material_points.h>
#include <impoint/terms/term.h>

namespace Impoint
{
  /** Inertia with the consistent mass: N_I rho N_J a_J of P Eq. 15 and the last
   * term of P Eq. 16, for the material points of one cell. */
  template <int dim>
  class ConsistentMass
  {
  public:
    explicit ConsistentMass(const MaterialPoints<dim> &points)
      : points(points)
    {}

    /** @p accelerations: of the cell's nodes (n * dim); @p alpha: their
     * derivative with respect to the displacements. */
    void add(const unsigned int k,
             const double      *accelerations,
             const double       alpha,
             CellSystem        &system) const;

  private:
    const MaterialPoints<dim> &points;
  };
} // namespace Impoint

#endif
