#include <impoint/particles/facet_cutter.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    // Facets that are closer to a face of the grid, relative to the cells'
    // size, lie on it. Not a round number, lest a scene that moves a boundary
    // towards a face in decades stops just there.
    const double facet_on_face = 0.7e-10;
  } // namespace



  template <int dim>
  Tensor<1, dim> area_vector_of(const Corners<dim> &corners)
  {
    if constexpr (dim == 2)
      return cross_product_2d(corners[1] - corners[0]);
    else
      return area_vector(corners);
  }



  template <int dim>
  std::vector<Corners<dim>> flat_facets(const std::vector<Corners<dim>> &facets)
  {
    std::vector<Corners<dim>> flat;
    for (const auto &facet : facets)
      if constexpr (dim == 3)
        {
          const Tensor<1, 3> normal = area_vector(facet);
          const double       height =
            facet.size() < 4 ? 0. :
                                     std::abs((facet[3] - facet[0]) *
                                        cross_product_3d(facet[1] - facet[0],
                                                         facet[2] - facet[0]));
          if (height > 1e-12 * std::pow(normal.norm(), 1.5))
            {
              flat.push_back({facet[0], facet[1], facet[2]});
              flat.push_back({facet[0], facet[2], facet[3]});
            }
          else
            flat.push_back(facet);
        }
      else
        flat.push_back(facet);
    return flat;
  }



  template <int dim>
  FacetCutter<dim>::FacetCutter(const BackgroundGrid<dim> &grid)
    : grid(grid)
    , tolerance(facet_on_face * grid.smallest_size())
  {}



  template <int dim>
  std::vector<unsigned int>
  FacetCutter<dim>::cells_near(const Corners<dim> &facet) const
  {
    Tensor<1, dim> margin;
    for (unsigned int d = 0; d < dim; ++d)
      margin[d] = 1e-9 * grid.smallest_size();
    const auto box   = BoundingBox<dim>(facet).get_boundary_points();
    auto       cells = grid.cells_near(box.first - margin, box.second + margin);
    cells.erase(std::remove_if(cells.begin(),
                               cells.end(),
                               [&](const unsigned int c) {
                                 return !grid.is_owned(c);
                               }),
                cells.end());
    return cells;
  }



  template <int dim>
  Corners<dim> FacetCutter<dim>::part_in(const unsigned int  c,
                                         const Corners<dim> &facet) const
  {
    const Tensor<1, dim> normal = area_vector_of(facet);
    const auto           faces  = grid.faces(c);
    Corners<dim>         part   = facet;
    for (unsigned int f = 0; f < faces.size() && !part.empty(); ++f)
      if (!lies_on(facet, faces[f]))
        clip(part, faces[f]);
      else if (normal * faces[f].normal < 0 && !grid.cell(c)->at_boundary(f))
        part.clear(); // the neighbour is on the inner side
    if (part.size() < dim || area_vector_of(part).norm() <
                               1e-12 * std::pow(grid.size(c), double(dim - 1)))
      part.clear();
    return part;
  }



  template <int dim>
  bool FacetCutter<dim>::lies_on(const Corners<dim>   &facet,
                                 const HalfSpace<dim> &face) const
  {
    return std::all_of(facet.begin(), facet.end(), [&](const auto &corner) {
      return std::abs((corner - face.point) * face.normal) <= tolerance;
    });
  }

  template Tensor<1, 2>            area_vector_of(const Corners<2> &);
  template Tensor<1, 3>            area_vector_of(const Corners<3> &);
  template std::vector<Corners<2>> flat_facets(const std::vector<Corners<2>> &);
  template std::vector<Corners<3>> flat_facets(const std::vector<Corners<3>> &);
  template class FacetCutter<2>;
  template class FacetCutter<3>;
} // namespace Impoint
