#include <impoint/solver/covering_lattice.h>
#include <impoint/solver/quantile.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Impoint
{
  namespace
  {
    /** Of the cells' size, as a third of the nodes see it: those between the
     * vertices of elements of degree 2 see less of their cell, nodes with
     * couplings beyond their cells more. */
    constexpr double part       = 1. / 3;
    constexpr double coarsening = 2;

    /** Where nodes are meant to meet the lattice, round-off would have them
     * between two functions. [cells] */
    constexpr double round_off = 1e-6;

    /** How far neighbours are away in each direction, per node. */
    template <int dim>
    std::vector<double> reaches(const BlockPattern            &pattern,
                                const std::vector<Point<dim>> &points,
                                const unsigned int             d)
    {
      std::vector<double> reaches(pattern.n_rows(), 0.);
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        for (std::size_t k = pattern.row_start[row];
             k < pattern.row_start[row + 1];
             ++k)
          reaches[row] =
            std::max(reaches[row],
                     std::abs(points[pattern.columns[k]][d] - points[row][d]));
      return reaches;
    }
  } // namespace

  template <int dim>
  CoveringLattice<dim>::CoveringLattice(const BlockPattern            &pattern,
                                        const NodeExchange            &nodes,
                                        const std::vector<Point<dim>> &points)
    : places(points)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        double lower = std::numeric_limits<double>::max(), upper = -lower;
        for (const Point<dim> &point : points)
          {
            lower = std::min(lower, point[d]);
            upper = std::max(upper, point[d]);
          }
        lower = Utilities::MPI::min(lower, nodes.communicator());
        upper = Utilities::MPI::max(upper, nodes.communicator());
        const double size =
          coarsening *
          quantile(reaches(pattern, points, d), part, nodes.communicator());
        const double n_cells = size > 0 ? std::ceil((upper - lower) / size) : 1;
        lines.emplace_back(1, std::max(1, static_cast<int>(n_cells)));
        for (Point<dim> &place : places)
          {
            place[d]             = size > 0 ? (place[d] - lower) / size : 0;
            const double nearest = std::round(place[d]);
            if (std::abs(place[d] - nearest) < round_off)
              place[d] = nearest;
          }
      }
  }

  template struct CoveringLattice<2>;
  template struct CoveringLattice<3>;
} // namespace Impoint
