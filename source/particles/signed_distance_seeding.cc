#include <impoint/base/expression.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/particles/numbering.h>
#include <impoint/particles/seeding.h>

#include <deal.II/base/function.h>
#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/non_matching/quadrature_generator.h>

#include <algorithm>
#include <array>

namespace Impoint
{
  namespace
  {
    /** A quadrilateral or hexahedron: the unit cell's image under the functions
     * that are linear along each of its edges. */
    template <int dim>
    class Box
    {
    public:
      static constexpr unsigned int n = GeometryInfo<dim>::vertices_per_cell;

      explicit Box(const std::array<Point<dim>, n> &corners)
        : corners(corners)
      {}

      Point<dim> place(const Point<dim> &xi) const
      {
        Point<dim> x;
        for (unsigned int i = 0; i < n; ++i)
          x += GeometryInfo<dim>::d_linear_shape_function(xi, i) *
               Tensor<1, dim>(corners[i]);
        return x;
      }

      /** Volume there by that of the unit cell. */
      double stretch(const Point<dim> &xi) const
      {
        Tensor<2, dim> J;
        for (unsigned int i = 0; i < n; ++i)
          J += outer_product(
            corners[i],
            GeometryInfo<dim>::d_linear_shape_function_gradient(xi, i));
        return std::abs(determinant(J));
      }

    private:
      std::array<Point<dim>, n> corners;
    };



    /** What a cell is made of: itself, or, of a simplex, a box at each vertex,
     * whose corners are the centres of all faces of the simplex (itself
     * included) that the vertex belongs to. */
    template <int dim>
    std::vector<Box<dim>> boxes(const BackgroundGrid<dim> &grid,
                                const unsigned int         c)
    {
      const auto                          cell = grid.cell(c);
      std::array<Point<dim>, Box<dim>::n> corners;
      if (!grid.simplicial())
        {
          for (unsigned int i = 0; i < corners.size(); ++i)
            corners[i] = cell->vertex(i);
          return {Box<dim>(corners)};
        }
      std::vector<Box<dim>> result;
      for (unsigned int v = 0; v < dim + 1; ++v)
        {
          // corner i has the vertices after v that i has bits of
          for (unsigned int i = 0; i < corners.size(); ++i)
            {
              corners[i]          = cell->vertex(v);
              unsigned int n_used = 1;
              for (unsigned int d = 0; d < dim; ++d)
                if (i >> d & 1)
                  {
                    corners[i] += cell->vertex((v + 1 + d) % (dim + 1));
                    ++n_used;
                  }
              corners[i] /= n_used;
            }
          result.emplace_back(corners);
        }
      return result;
    }



    /** The signed distance on a box, in sizes of its cell: the cubic through
     * its values there, whose derivatives are known. */
    template <int dim>
    class BoxDistance : public Function<dim>
    {
    public:
      BoxDistance()
        : cubic(3)
        , values(cubic.n_dofs_per_cell())
      {}

      void reinit(const Expression<dim> &distance,
                  const Box<dim>        &box,
                  const double           size)
      {
        for (unsigned int i = 0; i < values.size(); ++i)
          values[i] =
            distance.value(box.place(cubic.get_unit_support_points()[i]),
                           0.,
                           0) /
            size;
      }

      /** Whether the body is too far from the box to reach into it. */
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
    const Expression<dim> distance(file, body.section + "/Signed distance", 1);
    BoxDistance<dim>      in_box;
    const hp::QCollection<1>              rules((QGauss<1>(body.rule)));
    NonMatching::QuadratureGenerator<dim> generator(rules);
    const BoundingBox<dim> unit_cell = create_unit_bounding_box<dim>();

    std::vector<SeededPoint<dim>> points;
    std::vector<ParticleGroup>    groups;
    on_all_ranks(grid.communicator(), [&]() {
      for (unsigned int c = 0; c < grid.n_cells(); ++c)
        {
          if (!grid.is_owned(c))
            continue;
          check_side(file, body, distance, grid, c);
          const std::size_t n_before = points.size();
          for (const Box<dim> &box : boxes(grid, c))
            {
              in_box.reinit(distance, box, grid.size(c));
              if (in_box.is_far())
                continue;
              generator.generate(in_box, unit_cell);
              const auto &rule = generator.get_inside_quadrature();
              for (unsigned int q = 0; q < rule.size(); ++q)
                {
                  points.emplace_back();
                  points.back().x = box.place(rule.point(q));
                  points.back().volume =
                    rule.weight(q) * box.stretch(rule.point(q));
                  points.back().cell = c;
                }
            }
          if (points.size() > n_before)
            groups.push_back(
              {0, grid.cell(c)->id(), unsigned(points.size() - n_before)});
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
