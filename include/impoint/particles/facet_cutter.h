#ifndef impoint_particles_facet_cutter_h
#define impoint_particles_facet_cutter_h

#include <impoint/grid/background_grid.h>
#include <impoint/particles/clipping.h>

#include <vector>

namespace Impoint
{
  /** Normal of a segment or polygon, of the length of its area. */
  template <int dim>
  Tensor<1, dim> area_vector_of(const Corners<dim> &corners);

  /** Facets that half spaces can cut: warped quadrilaterals become triangles,
   * whose rules are exact, too. */
  template <int dim>
  std::vector<Corners<dim>>
  flat_facets(const std::vector<Corners<dim>> &facets);

  /** Cuts flat facets at the faces of the grid's cells. */
  template <int dim>
  class FacetCutter
  {
  public:
    explicit FacetCutter(const BackgroundGrid<dim> &grid);

    /** The own cells that @p facet may meet, increasing. */
    std::vector<unsigned int> cells_near(const Corners<dim> &facet) const;

    /** The part of @p facet that belongs to the own cell @p c; may be empty. */
    Corners<dim> part_in(const unsigned int c, const Corners<dim> &facet) const;

  private:
    bool lies_on(const Corners<dim> &facet, const HalfSpace<dim> &face) const;

    const BackgroundGrid<dim> &grid;
    const double               tolerance;
  };
} // namespace Impoint

#endif
