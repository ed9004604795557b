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
    void Penetration<dim>::end_step(const State<dim> &state)
    {
      double deepest = 0;
      for (const auto &method : state.methods)
        if (method->parameters().name == boundary && method->is_active())
          deepest = std::max(deepest, depth(state, method->particles()));
      deepest = Utilities::MPI::max(deepest,
                                    state.active.basis().grid().communicator());
      largest = std::max(largest, deepest);
      this->set({deepest}, state.time);
    }



    template <int dim>
    double Penetration<dim>::depth(const State<dim>             &state,
                                   const BoundaryParticles<dim> &wall) const
    {
      const auto &points = state.points;
      const auto &grid   = state.active.basis().grid();
      const auto  tree   = pack_rtree(all_particles(wall, grid.communicator()));

      // Half of the distance between particles, which Gauss rules have up
      // to 1.2 times as far as equal ones.
      const double reach =
        0.6 * std::sqrt(dim - 1.) * largest_size(wall, grid.communicator());

      double deepest = 0;
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
                  const double depth = way * nearest->second;
                  if (way.norm() < h ||
                      (way - depth * nearest->second).norm() < reach)
                    deepest = std::max(deepest, depth / h);
                }
        }
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
      archive &largest;
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::Penetration<2>;
template class Impoint::Measurements::Penetration<3>;
