#include <impoint/base/expression.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/particles/numbering.h>
#include <impoint/particles/seeding.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/non_matching/quadrature_generator.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    /** The signed distance on the unit cell, in cell sizes: the cubic through
     * its values there, whose derivatives are known. */
    template <int dim>
    class CellDistance : public Function<dim>
    {
    public:
      CellDistance()
        : cubic(3)
        , values(cubic.n_dofs_per_cell())
      {}

      void reinit(const Expression<dim>     &distance,
                  const BackgroundGrid<dim> &grid,
                  const unsigned int         c)
      {
        for (unsigned int i = 0; i < values.size(); ++i)
          values[i] =
            distance.value(grid.mapping().transform_unit_to_real_cell(
                             grid.cell(c), cubic.get_unit_support_points()[i]),
                           0.,
                           0) /
            grid.size(c);
      }

      /** Whether the body is too far from the cell to reach into it. */
      bool is_far() const
      {
        return *std::min_element(values.begin(), values.end()) > dim;
      }

      double value(const Point<dim> &xi, const unsigned int = 0) const override
      {
        double sum = 0;
        for (unsigned int i = 0; i < values.size(); ++i)
          sum += values[i] * cubic.shape_value(i, xi);
        return sum;
      }

      Tensor<1, dim> gradient(const Point<dim> &xi,
                              const unsigned int = 0) const override
      {
        Tensor<1, dim> sum;
        for (unsigned int i = 0; i < values.size(); ++i)
          sum += values[i] * cubic.shape_grad(i, xi);
        return sum;
      }

      SymmetricTensor<2, dim> hessian(const Point<dim> &xi,
                                      const unsigned int = 0) const override
      {
        SymmetricTensor<2, dim> sum;
        for (unsigned int i = 0; i < values.size(); ++i)
          sum += values[i] * symmetrize(cubic.shape_grad_grad(i, xi));
        return sum;
      }

    private:
      const FE_Q<dim>     cubic;
      std::vector<double> values;
    };



    /** Throws if the body goes on beyond the cell's side @p f on the boundary
     * of the grid. */
    template <int dim>
    void check_side(const ParameterFile       &file,
                    const BodyParameters      &body,
                    const Expression<dim>     &distance,
                    const BackgroundGrid<dim> &grid,
                    const unsigned int         c)
    {
      for (const unsigned int f : grid.cell(c)->face_indices())
        if (grid.cell(c)->at_boundary(f) &&
            distance.value(grid.cell(c)->face(f)->center(), 0., 0) <
              -1e-9 * grid.size(c))
          throw file.error(body.section + "/Signed distance",
                           "the body '" + body.name +
                             "' goes on outside of the grid",
                           "Enlarge the grid, or move the body.");
    }
  } // namespace



  template <int dim>
  std::vector<SeededPoint<dim>>
  seed_signed_distance(const ParameterFile       &file,
                       const BodyParameters      &body,
                       const BackgroundGrid<dim> &grid)
  {
    const std::string        path = body.section + "/Signed distance";
    const Expression<dim>    distance(file, path, 1);
    CellDistance<dim>        in_cell;
    const hp::QCollection<1> rules((QGauss<1>(body.rule)));
    NonMatching::QuadratureGenerator<dim> generator(rules);
    const BoundingBox<dim> unit_cell = create_unit_bounding_box<dim>();

    std::vector<SeededPoint<dim>> points;
    std::vector<ParticleGroup>    groups;
    on_all_ranks(grid.communicator(), [&]() {
      for (unsigned int c = 0; c < grid.n_cells(); ++c)
        {
          if (!grid.is_owned(c))
            continue;
          if (grid.simplicial() || !grid.is_affine(c))
            throw file.error(path,
                             "a signed distance on a grid of simplices or "
                             "distorted cells",
                             "Make the grid of parallelograms (boxes), or give "
                             "the body by an outline or a mesh.");
          check_side(file, body, distance, grid, c);
          in_cell.reinit(distance, grid, c);
          if (in_cell.is_far())
            continue;
          generator.generate(in_cell, unit_cell);
          const auto &rule = generator.get_inside_quadrature();
          for (unsigned int q = 0; q < rule.size(); ++q)
            {
              points.emplace_back();
              points.back().x =
                grid.mapping().transform_unit_to_real_cell(grid.cell(c),
                                                           rule.point(q));
              points.back().volume = rule.weight(q) * grid.volume(c);
              points.back().cell   = c;
            }
          if (rule.size() > 0)
            groups.push_back({0, grid.cell(c)->id(), unsigned(rule.size())});
        }
    });
    number_particles(groups, grid.communicator(), points);
    return points;
  }

  template std::vector<SeededPoint<2>>
  seed_signed_distance(const ParameterFile &,
                       const BodyParameters &,
                       const BackgroundGrid<2> &);
  template std::vector<SeededPoint<3>>
  seed_signed_distance(const ParameterFile &,
                       const BodyParameters &,
                       const BackgroundGrid<3> &);
} // namespace Impoint
