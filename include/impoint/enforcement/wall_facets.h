#ifndef impoint_enforcement_wall_facets_h
#define impoint_enforcement_wall_facets_h

#include <impoint/particles/boundary_particles.h>
#include <impoint/particles/material_points.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /** A piece of wall, as all ranks know it. */
    template <int dim>
    struct Facet
    {
      Point<dim>     x, new_x;
      Tensor<1, dim> normal;
      double         radius = 0;
      double         search = 1; // factor of how far aside points may be
    };



    /** Those of @p particles of all ranks, in the order of ranks. */
    template <int dim>
    std::vector<Facet<dim>>
    all_facets(const BoundaryParticles<dim>    &boundary,
               const std::vector<unsigned int> &particles,
               const std::vector<Point<dim>>   &new_places,
               const std::vector<char>         &closed,
               const MPI_Comm                   communicator)
    {
      std::vector<double> own;
      for (const unsigned int b : particles)
        {
          const Tensor<1, dim> normal =
            boundary.vector(b, boundary.slots().normal);
          for (unsigned int d = 0; d < dim; ++d)
            for (const double number :
                 {boundary.position(b)[d], new_places[b][d], normal[d]})
              own.push_back(number);
          own.push_back(0.5 * std::pow(boundary.area(b) / boundary.thickness(),
                                       1. / (dim - 1)));
          own.push_back(!closed.empty() && closed[b] ? 2. : 1.);
        }
      std::vector<Facet<dim>> facets;
      for (const auto &part : Utilities::MPI::all_gather(communicator, own))
        for (auto number = part.begin(); number != part.end();)
          {
            Facet<dim> facet;
            for (unsigned int d = 0; d < dim; ++d)
              {
                facet.x[d]      = *number++;
                facet.new_x[d]  = *number++;
                facet.normal[d] = *number++;
              }
            facet.radius = *number++;
            facet.search = *number++;
            facets.push_back(facet);
          }
      return facets;
    }



    /** Half the edge of the cube of a point's present volume. */
    template <int dim>
    double half_edge(const MaterialPoints<dim> &points,
                     const unsigned int         p,
                     const double               thickness)
    {
      const double volume = points.data(p)[points.slots().volume] *
                            determinant(points.deformation_gradient(p)) /
                            thickness;
      return 0.5 * std::pow(std::max(volume, 0.), 1. / dim);
    }



    /** This rank's points in cell @p c. */
    template <int dim>
    typename MaterialPoints<dim>::Range
    range_in(const MaterialPoints<dim> &points, const unsigned int c)
    {
      const auto range =
        std::lower_bound(points.ranges().begin(),
                         points.ranges().end(),
                         c,
                         [](const auto &one, const unsigned int other) {
                           return one.cell < other;
                         });
      if (range == points.ranges().end() || range->cell != c)
        return {c, 0, 0};
      return *range;
    }



    /** Calls function(p) for this rank's points in cells within @p reach of
     * @p x. */
    template <int dim, typename Function>
    void for_points_near(const Point<dim>          &x,
                         const double               reach,
                         const BackgroundGrid<dim> &grid,
                         const MaterialPoints<dim> &points,
                         const Function            &function)
    {
      Point<dim> lower = x, upper = x;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] -= reach;
          upper[d] += reach;
        }
      for (const unsigned int c : grid.cells_near(lower, upper))
        {
          const auto range = range_in(points, c);
          for (unsigned int p = range.begin; p < range.end; ++p)
            function(p);
        }
    }



    /** Of point @p p; that at the start if the grid is kept. */
    template <int dim>
    Point<dim> place(const MaterialPoints<dim> &points, const unsigned int p)
    {
      return points.carried().keeps_grid ?
               Point<dim>(points.vector(p, points.slots().start)) :
               points.position(p);
    }



    /** Distance of @p away from the line along @p normal. */
    template <int dim>
    double aside(const Tensor<1, dim> &away, const Tensor<1, dim> &normal)
    {
      return (away - (away * normal) * normal).norm();
    }
  } // namespace Enforcement
} // namespace Impoint

#endif
