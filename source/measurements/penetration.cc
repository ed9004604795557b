#include <impoint/base/parameter_file.h>
#include <impoint/measurements/penetration.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      /** Place and normal of a boundary particle. */
      template <int dim>
      using WallParticle = std::pair<Point<dim>, Tensor<1, dim>>;



      /** The boundary's particles of all ranks. */
      template <int dim>
      std::vector<WallParticle<dim>>
      all_particles(const BoundaryParticles<dim> &wall,
                    const MPI_Comm                communicator)
      {
        std::vector<double> own;
        for (unsigned int b = 0; b < wall.n(); ++b)
          for (const unsigned int at : {wall.slots().x, wall.slots().normal})
            own.insert(own.end(), wall.data(b) + at, wall.data(b) + at + dim);

        std::vector<WallParticle<dim>> particles;
        for (const auto &numbers :
             Utilities::MPI::all_gather(communicator, own))
          for (std::size_t i = 0; i < numbers.size(); i += 2 * dim)
            {
              WallParticle<dim> particle;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  particle.first[d]  = numbers[i + d];
                  particle.second[d] = numbers[i + dim + d];
                }
              particles.push_back(particle);
            }
        return particles;
      }



      /** Of the parts of the boundary that particles stand for. */
      template <int dim>
      double largest_size(const BoundaryParticles<dim> &wall,
                          const MPI_Comm                communicator)
      {
        double area = 0;
        for (unsigned int b = 0; b < wall.n(); ++b)
          area = std::max(area, wall.area(b));
        area = Utilities::MPI::max(area, communicator);
        return dim == 2 ? area / wall.thickness() : std::sqrt(area);
      }
    } // namespace



    template <int dim>
    Penetration<dim>::Penetration(const ParameterFile         &file,
                                  const MeasurementParameters &parameters)
      : NamedValues<dim>(file, parameters, {"depth"})
      , boundary(parameters.boundary)
      , body(body_number(file, parameters))
    {}



    template <int dim>
    void Penetration<dim>::check(const ParameterFile         &file,
                                 const MeasurementParameters &parameters)
    {
      parameters.require_boundary_particles(file);
    }



    template <int dim>
    void Penetration<dim>::start(const State<dim> &state)
    {
      sides.assign(state.points.n_global(), elsewhere);
      for (const auto &method : state.methods)
        if (method->parameters().name == boundary)
          depth(state, method->particles(), false);
    }



    template <int dim>
    void Penetration<dim>::end_step(const State<dim> &state)
    {
      double deepest = 0;
      for (const auto &method : state.methods)
        if (method->parameters().name == boundary)
          deepest = depth(state, method->particles(), method->is_active());
      deepest = Utilities::MPI::max(deepest,
                                    state.active.basis().grid().communicator());
      largest = std::max(largest, deepest);
      this->set({deepest}, state.time);
    }



    /** Brings the points' sides up to date, too. */
    template <int dim>
    double Penetration<dim>::depth(const State<dim>             &state,
                                   const BoundaryParticles<dim> &wall,
                                   const bool                    acts)
    {
      const auto    &points = state.points;
      const auto    &grid   = state.active.basis().grid();
      const MPI_Comm comm   = grid.communicator();
      const auto     tree   = pack_rtree(all_particles(wall, comm));

      // Half of the distance between particles, which Gauss rules have up
      // to 1.2 times as far as equal ones.
      const double reach = 0.6 * std::sqrt(dim - 1.) * largest_size(wall, comm);

      double                   deepest = 0;
      std::vector<signed char> sides_now(sides.size(), elsewhere);
      for (const auto &range : points.ranges())
        {
          const double h = grid.size(range.cell);
          for (unsigned int p = range.begin; p < range.end; ++p)
            if (is_in_body(points, p, body))
              for (auto nearest = tree.qbegin(
                     boost::geometry::index::nearest(points.position(p), 1));
                   nearest != tree.qend();
                   ++nearest)
                {
                  const Tensor<1, dim> way =
                    points.position(p) - nearest->first;
                  const double behind = way * nearest->second;
                  const bool   opposite =
                    (way - behind * nearest->second).norm() < reach;
                  const auto id = points.id(p);
                  if (behind <= 0)
                    sides_now[id] = opposite ? front : elsewhere;
                  else if (acts && (way.norm() < h ||
                                    (opposite && sides[id] != elsewhere)))
                    {
                      sides_now[id] = opposite ? passed : elsewhere;
                      deepest       = std::max(deepest, behind / h);
                    }
                }
        }
      MPI_Allreduce(sides_now.data(),
                    sides.data(),
                    sides.size(),
                    MPI_SIGNED_CHAR,
                    MPI_MAX,
                    comm);
      return deepest;
    }



    template <int dim>
    void Penetration<dim>::results(std::vector<Result> &results) const
    {
      results.push_back({this->name + " depth", largest});
    }



    template <int dim>
    void Penetration<dim>::save_or_load(StateArchive &archive)
    {
      NamedValues<dim>::save_or_load(archive);
      archive &largest &sides;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Penetration<2>;
template class Impoint::Measurements::Penetration<3>;
