#include <impoint/base/parameter_file.h>
#include <impoint/measurements/probe.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      /** Distances closer than this, in cell sizes, are the same: what
       * round-off does to a place must not choose its cell. */
      const double same_distance = 1e-9;



      /** How far outside of the reference cell @p xi is. */
      template <int dim>
      double distance_outside(const Point<dim> &xi, const bool simplex)
      {
        double sum = 0, distance = 0;
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum += xi[d];
            distance = std::max({distance, -xi[d], simplex ? 0 : xi[d] - 1});
          }
        distance = simplex ? std::max(distance, sum - 1) : distance;
        return distance < same_distance ? 0. : distance;
      }



      /** Displacement at @p xi in the active cell @p c. */
      template <int dim>
      Tensor<1, dim>
      displacement_at(const ActiveNodes<dim>                           &active,
                      const unsigned int                                c,
                      const Point<dim>                                 &xi,
                      const LinearAlgebra::distributed::Vector<double> &u)
      {
        std::vector<double> support(active.basis().support_size(c));
        active.basis().evaluate(c, xi, support.data());
        const auto     nodes = active.nodes(active.position(c));
        Tensor<1, dim> value;
        for (unsigned int a = 0; a < nodes.size(); ++a)
          for (unsigned int d = 0; d < dim; ++d)
            value[d] += support[a] * u.local_element(dim * nodes[a] + d);
        return value;
      }
    } // namespace



    template <int dim>
    Probe<dim>::Probe(const ParameterFile         &file,
                      const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, with_components<dim>("u"))
      , misplaced(
          file.error(parameters.section + "/Point",
                     "no material within one cell of the probe '" +
                       parameters.name + "'",
                     "Move the probe to the material, or the material there."))
      , place(to_vector<dim>(parameters.point))
    {}



    template <int dim>
    void Probe<dim>::check(const ParameterFile         &file,
                           const MeasurementParameters &parameters)
    {
      if (parameters.point.empty())
        throw file.error(parameters.section + "/Point",
                         "the probe '" + parameters.name + "' has no place",
                         "Give " + std::to_string(dim) +
                           " numbers, separated by commas.");
      if (parameters.name == "centre")
        throw file.error(
          "Measurements/Names",
          "the probe 'centre' has the name of the centre of mass",
          "Give it another one: history.csv has columns 'centre x' already.");
    }



    template <int dim>
    std::vector<typename Probe<dim>::Candidate> Probe<dim>::candidates(
      const State<dim>                                 &state,
      const LinearAlgebra::distributed::Vector<double> *u) const
    {
      const auto &grid     = state.active.basis().grid();
      const auto  occupied = state.points.cells();
      // a kept grid has the place where it was at the start
      const Point<dim> here(
        state.points.carried().keeps_grid ? place - displacement : place);
      Tensor<1, dim> reach;
      for (unsigned int d = 0; d < dim; ++d)
        reach[d] = search_radius;

      std::vector<Candidate> found;
      for (const unsigned int c : grid.cells_near(here - reach, here + reach))
        if (std::binary_search(occupied.begin(), occupied.end(), c))
          {
            const Point<dim> xi       = grid.to_reference(c, here);
            const double     distance = distance_outside(xi, grid.simplicial());
            if (distance > 1)
              continue;
            found.push_back({distance, grid.cell(c)->center(), {}});
            if (u != nullptr)
              found.back().increment = displacement_at(state.active, c, xi, *u);
          }
      return found;
    }



    template <int dim>
    bool Probe<dim>::choose(const std::vector<Candidate> &own,
                            const MPI_Comm                communicator,
                            Tensor<1, dim>               &increment)
    {
      std::vector<Candidate> all;
      for (const auto &of_rank : Utilities::MPI::all_gather(communicator, own))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      if (all.empty())
        return false;

      double nearest = 1;
      for (const auto &candidate : all)
        nearest = std::min(nearest, candidate.distance);
      const auto key = [&](const Candidate &candidate) {
        std::array<double, dim + 1> key;
        key[0] = candidate.distance > nearest + same_distance;
        for (unsigned int d = 0; d < dim; ++d)
          key[d + 1] = candidate.centre[d];
        return key;
      };
      increment = std::min_element(all.begin(),
                                   all.end(),
                                   [&](const auto &left, const auto &right) {
                                     return key(left) < key(right);
                                   })
                    ->increment;
      return true;
    }



    template <int dim>
    void Probe<dim>::start(const State<dim> &state)
    {
      const auto &grid = state.active.basis().grid();
      for (unsigned int c = 0; c < grid.n_cells(); ++c)
        if (grid.is_owned(c))
          search_radius = std::max(search_radius, grid.size(c));
      search_radius = Utilities::MPI::max(search_radius, grid.communicator());
      if (!choose(candidates(state, nullptr), grid.communicator(), increment))
        throw misplaced;
    }



    template <int dim>
    bool Probe<dim>::is_lost() const
    {
      return std::isnan(place[0]);
    }



    template <int dim>
    void Probe<dim>::follow(const State<dim> &state,
                            const LinearAlgebra::distributed::Vector<double> &u)
    {
      if (is_lost() || choose(candidates(state, &u),
                              state.active.basis().grid().communicator(),
                              increment))
        return;
      std::ostringstream text;
      text << "the probe '" << this->name
           << "' is further than one cell from all material at t = "
           << state.time << " s, (" << place << "): from now on it is nan";
      warning = text.str();
      for (unsigned int d = 0; d < dim; ++d)
        increment[d] = std::numeric_limits<double>::quiet_NaN();
    }



    template <int dim>
    void Probe<dim>::end_step(const State<dim> &state)
    {
      place += increment;
      displacement += increment;
      this->set(std::vector<double>(displacement.begin_raw(),
                                    displacement.end_raw()),
                state.time);
    }



    template <int dim>
    void Probe<dim>::columns(HistoryRow &row) const
    {
      NamedValues<dim>::columns(row);
      for (unsigned int d = 0; d < dim; ++d)
        row.emplace_back(this->name + " " + "xyz"[d], place[d]);
    }



    template <int dim>
    std::string Probe<dim>::take_warning()
    {
      return std::exchange(warning, {});
    }



    template <int dim>
    void Probe<dim>::save_or_load(StateArchive &archive)
    {
      NamedValues<dim>::save_or_load(archive);
      archive &place &displacement &search_radius;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Probe<2>;
template class Impoint::Measurements::Probe<3>;
