#include <impoint/base/exceptions.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/particles/point_cloud.h>

#include <deal.II/base/mpi.h>
#include <deal.II/particles/particle_handler.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  template <int dim>
  bool PointCloud<dim>::find(const std::vector<Point<dim>> &new_places,
                             const std::string             &kind)
  {
    if (anchor != 0)
      return false;
    const BackgroundGrid<dim> &grid = basis.grid();
    std::vector<unsigned int>  strays;
    moves.clear();
    const unsigned int me =
      Utilities::MPI::this_mpi_process(grid.communicator());
    for (const Range &range : cell_ranges)
      for (unsigned int p = range.begin; p < range.end; ++p)
        {
          Point<dim> &xi = references[p];
          xi             = grid.to_reference(range.cell, new_places[p]);
          if (grid.is_inside(xi))
            continue;
          const unsigned int c = grid.walk(new_places[p], range.cell, xi);
          if (c != BackgroundGrid<dim>::nowhere && grid.is_owned(c))
            {
              if (c != range.cell)
                moves.push_back({p, c, me});
            }
          else
            strays.push_back(p);
        }
    if (Utilities::MPI::max(static_cast<unsigned int>(strays.size()),
                            grid.communicator()) > 0)
      find_strays(new_places, strays, kind);
    return true;
  }



  /** Of all ranks' particles, in units of their cell. */
  template <int dim>
  double PointCloud<dim>::largest_travel(
    const std::vector<Point<dim>> &new_places) const
  {
    double largest = 0;
    for (const Range &range : cell_ranges)
      for (unsigned int p = range.begin; p < range.end; ++p)
        largest = std::max(largest,
                           position(p).distance(new_places[p]) /
                             basis.grid().size(range.cell));
    return Utilities::MPI::max(largest, basis.grid().communicator());
  }



  /** Strays left this rank's cells: asks every rank whose they are. */
  template <int dim>
  void PointCloud<dim>::find_strays(const std::vector<Point<dim>>   &new_places,
                                    const std::vector<unsigned int> &strays,
                                    const std::string               &kind)
  {
    const BackgroundGrid<dim> &grid = basis.grid();
    const unsigned int         me =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::vector<Point<dim>> places;
    for (const unsigned int p : strays)
      places.push_back(new_places[p]);

    const auto asked = Utilities::MPI::all_gather(grid.communicator(), places);
    std::vector<std::vector<unsigned int>> answers(asked.size());
    for (unsigned int rank = 0; rank < asked.size(); ++rank)
      for (const Point<dim> &x : asked[rank])
        {
          Point<dim>         xi;
          const unsigned int c = grid.find(x, xi);
          answers[rank].push_back(c != BackgroundGrid<dim>::nowhere &&
                                      grid.is_owned(c) ?
                                    c :
                                    BackgroundGrid<dim>::nowhere);
        }
    const auto answered =
      Utilities::MPI::all_gather(grid.communicator(), answers);

    const bool steps_too_far = largest_travel(new_places) > 1;
    on_all_ranks(grid.communicator(), [&]() {
      for (unsigned int i = 0; i < strays.size(); ++i)
        {
          unsigned int rank = 0;
          while (rank < answered.size() &&
                 answered[rank][me][i] == BackgroundGrid<dim>::nowhere)
            ++rank;
          if (rank == answered.size())
            {
              std::ostringstream message;
              message << kind << ' ' << id(strays[i]) << " leaves the grid at ("
                      << places[i]
                      << "). Enlarge the grid there, or hold what leaves it";
              if (steps_too_far)
                throw StepFailed(message.str());
              throw RunFailed(message.str());
            }
          moves.push_back({strays[i], answered[rank][me][i], rank});
        }
    });
  }

  template class PointCloud<2>;
  template class PointCloud<3>;
} // namespace Impoint
