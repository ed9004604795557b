#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/numbering.h>
#include <impoint/particles/outline.h>
#include <impoint/particles/seeding.h>
#include <impoint/particles/simplex_rules.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace Impoint
{
  namespace
  {
    // Parts of a cell smaller than this, relative to it, are round-off.
    const double smallest_part = 1e-12;



    /** Corners, on the reference cell, of its n^dim equal sub-cells. */
    template <int dim>
    std::vector<std::vector<Point<dim>>> cube_sub_cells(const unsigned int n)
    {
      std::vector<std::vector<Point<dim>>> cells;
      for (unsigned int i = 0; i < Utilities::fixed_power<dim>(n); ++i)
        {
          cells.emplace_back();
          for (unsigned int v = 0; v < (1 << dim); ++v)
            {
              Point<dim> corner;
              for (unsigned int d = 0, rest = i; d < dim; ++d, rest /= n)
                corner[d] = double(rest % n + ((v >> d) & 1)) / n;
              cells.back().push_back(corner);
            }
        }
      return cells;
    }



    /**
     * The same for simplices. The affine map y_k = xi_k + ... + xi_dim turns
     * the reference simplex into 1 >= y_1 >= ... >= y_dim >= 0, which is a
     * union of the simplices (one for each order of the axes) of n^dim cubes.
     */
    template <int dim>
    std::vector<std::vector<Point<dim>>> simplex_sub_cells(const unsigned int n)
    {
      std::vector<std::vector<Point<dim>>> cells;
      for (const auto &cube : cube_sub_cells<dim>(n))
        {
          std::array<unsigned int, dim> axes;
          std::iota(axes.begin(), axes.end(), 0);
          do
            {
              std::vector<Point<dim>> corners = {cube[0]};
              for (const unsigned int axis : axes)
                {
                  corners.push_back(corners.back());
                  corners.back()[axis] = cube.back()[axis];
                }
              bool inside = true;
              for (auto &corner : corners)
                for (unsigned int d = 0; d + 1 < dim; ++d)
                  {
                    corner[d] -= corner[d + 1];
                    inside = inside && corner[d] > -0.5 / n;
                  }
              if (inside)
                cells.push_back(corners);
          } while (std::next_permutation(axes.begin(), axes.end()));
        }
      return cells;
    }



    template <int dim>
    Point<dim> mapped(const std::vector<Point<dim>> &vertices,
                      const Point<dim>              &xi)
    {
      Point<dim> x;
      if (vertices.size() == dim + 1)
        {
          x = vertices[0];
          for (unsigned int d = 0; d < dim; ++d)
            x += xi[d] * (vertices[d + 1] - vertices[0]);
        }
      else
        for (unsigned int v = 0; v < vertices.size(); ++v)
          {
            double weight = 1;
            for (unsigned int d = 0; d < dim; ++d)
              weight *= (v >> d) & 1 ? xi[d] : 1 - xi[d];
            x += weight * vertices[v];
          }
      return x;
    }



    /** Turns what a cell holds of a body into points. */
    template <int dim>
    class CellFiller
    {
    public:
      using Parts = std::vector<ConvexPolytope<dim>>;

      CellFiller(const BodyParameters &body, const BackgroundGrid<dim> &grid)
        : grid(grid)
        , gauss(body.gauss_pieces)
        , n(body.rule)
        , sub_cells(grid.simplicial() ? simplex_sub_cells<dim>(gauss ? 1 : n) :
                                        cube_sub_cells<dim>(gauss ? 1 : n))
        , no_values(grid.simplicial() ? ReferenceCells::get_simplex<dim>() :
                                        ReferenceCells::get_hypercube<dim>())
        , full_rule(grid.mapping(),
                    no_values,
                    full_quadrature(),
                    update_quadrature_points | update_JxW_values)
      {
        if (gauss)
          {
            // n points a direction serve functions of degree n - 1 in each:
            // their products have this degree on a simplex
            const unsigned int degree = dim * (n - 1);
            piece_quadrature          = simplex_rule_of_order<dim>(
              std::min(degree / 2 + 1, max_simplex_order(dim)));
          }
      }

      /** The points of cell @p c, of which the body holds @p parts. */
      std::vector<SeededPoint<dim>> fill(const unsigned int c,
                                         const Parts       &parts)
      {
        const auto   vertices = grid.vertices(c);
        const auto   whole    = ConvexPolytope<dim>::from_cell(vertices);
        const auto   pieces   = pieces_of(whole, parts);
        const double volume = whole.volume(), held = sum(pieces);
        overlapping |= held > (1 + 1e-9) * volume;

        points.clear();
        const bool full = held > (1 - smallest_part) * volume;
        if (held < smallest_part * volume)
          return points;
        if (gauss)
          full ? add_full_cell(c) : add_pieces(c, pieces);
        else
          for (const auto &sub_cell : sub_cells)
            add_sub_cell(sub_cell, vertices, full ? Parts() : pieces);
        for (auto &point : points)
          point.cell = c;
        return points;
      }

      /** Whether the parts of the body were seen to overlap in some cell. */
      bool saw_overlap() const
      {
        return overlapping;
      }

    private:
      Quadrature<dim> full_quadrature() const
      {
        if (!gauss)
          return QMidpoint<dim>();
        return grid.simplicial() ? simplex_rule_of_order<dim>(n) :
                                   Quadrature<dim>(QGauss<dim>(n));
      }

      static Parts pieces_of(const ConvexPolytope<dim> &where,
                             const Parts               &parts)
      {
        const auto planes = where.half_spaces();
        Parts      pieces;
        for (const auto &part : parts)
          {
            // most parts are not near: spares copying them
            if (std::any_of(planes.begin(),
                            planes.end(),
                            [&](const auto &plane) {
                              return part.is_outside(plane);
                            }))
              continue;
            auto piece = intersect(part, planes);
            if (!piece.empty() && piece.volume() > 0)
              pieces.push_back(std::move(piece));
          }
        return pieces;
      }

      static double sum(const Parts &pieces)
      {
        double volume = 0;
        for (const auto &piece : pieces)
          volume += piece.volume();
        return volume;
      }

      void add(const Point<dim> &x, const double volume)
      {
        points.emplace_back();
        points.back().x      = x;
        points.back().volume = volume;
      }

      void add_full_cell(const unsigned int c)
      {
        full_rule.reinit(grid.cell(c));
        for (const unsigned int q : full_rule.quadrature_point_indices())
          add(full_rule.quadrature_point(q), full_rule.JxW(q));
      }

      /** A body whose sides run along the grid's leaves boxes in its cells: a
       * tensor rule needs fewer points for the same functions. */
      void add_pieces(const unsigned int c, const Parts &pieces)
      {
        if (add_box(c, pieces))
          return;
        const double jacobian =
          dim == 2 ? 2 : 6; // of a simplex over its volume
        for (const auto &piece : pieces)
          if (!add_box(c, {piece}))
            for (const auto &simplex : piece.simplices())
              for (unsigned int q = 0; q < piece_quadrature.size(); ++q)
                add(mapped({simplex.begin(), simplex.end()},
                           piece_quadrature.point(q)),
                    piece_quadrature.weight(q) * jacobian *
                      simplex_volume<dim>(simplex));
      }

      /** Puts a tensor rule into @p pieces if together they are a box along the
       * edges of the cell; else does nothing and returns false. */
      bool add_box(const unsigned int c, const Parts &pieces)
      {
        if (grid.simplicial() || !grid.is_affine(c))
          return false;
        std::vector<Point<dim>> corners;
        for (const auto &piece : pieces)
          for (const auto &face : piece.faces())
            for (const auto &corner : face)
              corners.push_back(grid.to_reference(c, corner));
        const BoundingBox<dim> box(corners);
        const double           held = sum(pieces);
        if (std::abs(box.volume() * grid.volume(c) - held) >
            smallest_part * grid.volume(c))
          return false;

        const auto vertices = grid.vertices(c);
        const auto rule     = full_quadrature();
        for (unsigned int q = 0; q < rule.size(); ++q)
          add(mapped(vertices, box.unit_to_real(rule.point(q))),
              rule.weight(q) * held);
        return true;
      }

      /** One point at the centroid of what the body holds of the sub-cell; no
       * @p parts mean all of it. */
      void add_sub_cell(const std::vector<Point<dim>> &reference_corners,
                        const std::vector<Point<dim>> &vertices,
                        const Parts                   &parts)
      {
        std::vector<Point<dim>> corners;
        for (const auto &xi : reference_corners)
          corners.push_back(mapped(vertices, xi));
        const auto   whole  = ConvexPolytope<dim>::from_cell(corners);
        const double volume = whole.volume();
        const auto   pieces = pieces_of(whole, parts);
        const double held   = sum(pieces);
        if (parts.empty() || held > (1 - smallest_part) * volume)
          return add(whole.centroid(), volume);
        if (held < smallest_part * volume)
          return;
        Tensor<1, dim> moment;
        for (const auto &piece : pieces)
          moment += piece.volume() * (piece.centroid() - corners[0]);
        add(corners[0] + moment / held, held);
      }

      const BackgroundGrid<dim>                 &grid;
      const bool                                 gauss;
      const unsigned int                         n;
      const std::vector<std::vector<Point<dim>>> sub_cells;
      const FE_Nothing<dim>                      no_values;
      FEValues<dim>                              full_rule;
      Quadrature<dim>                            piece_quadrature;
      std::vector<SeededPoint<dim>>              points;
      bool                                       overlapping = false;
    };



    /** Which of @p parts may meet this rank's own cells, by cell. */
    template <int dim>
    std::map<unsigned int, std::vector<ConvexPolytope<dim>>>
    parts_by_cell(const std::vector<ConvexPolytope<dim>> &parts,
                  const BackgroundGrid<dim>              &grid)
    {
      std::map<unsigned int, std::vector<ConvexPolytope<dim>>> sorted;
      for (const auto &part : parts)
        {
          const auto corners = part.box().get_boundary_points();
          for (const unsigned int c :
               grid.cells_near(corners.first, corners.second))
            if (grid.is_owned(c))
              sorted[c].push_back(part);
        }
      return sorted;
    }



    /** The body's volume over that of its points, which lack what was too small
     * a part of a cell. Throws on all ranks if they don't fill the body's
     * parts.
     */
    template <int dim>
    double check_volume(const ParameterFile                    &file,
                        const BodyParameters                   &body,
                        const BackgroundGrid<dim>              &grid,
                        const std::vector<ConvexPolytope<dim>> &parts,
                        const std::vector<SeededPoint<dim>>    &points,
                        const bool                              overlapping)
    {
      const std::string place = body.outline.empty() ?
                                  body.mesh.source_entry() :
                                  body.section + "/Outline";
      if (Utilities::MPI::max(int(overlapping), grid.communicator()) != 0)
        throw file.error(
          place,
          "the body '" + body.name + "' overlaps itself",
          "Give a mesh whose cells only touch, none of them badly warped.");
      double wanted = 0, filled = 0;
      for (const auto &part : parts)
        wanted += part.volume();
      for (const auto &point : points)
        filled += point.volume;
      filled = Utilities::MPI::sum(filled, grid.communicator());
      if (filled < (1 - 1e-9) * wanted)
        throw file.error(place,
                         "a part " + Words::exact(wanted - filled) + " of " +
                           Words::exact(wanted) + (dim == 2 ? " m2" : " m3") +
                           " of the body '" + body.name +
                           "' lies outside of the grid",
                         "Enlarge the grid, or move the body.");
      return wanted / filled;
    }
  } // namespace



  template <int dim>
  std::vector<SeededPoint<dim>> seed_clipped(const ParameterFile       &file,
                                             const BodyParameters      &body,
                                             const BackgroundGrid<dim> &grid)
  {
    const auto      parts = body_parts<dim>(file, body);
    CellFiller<dim> filler(body, grid);

    std::vector<SeededPoint<dim>> points;
    std::vector<ParticleGroup>    groups;
    for (const auto &cell_and_parts : parts_by_cell(parts, grid))
      {
        const unsigned int c       = cell_and_parts.first;
        const auto         in_cell = filler.fill(c, cell_and_parts.second);
        points.insert(points.end(), in_cell.begin(), in_cell.end());
        if (!in_cell.empty())
          groups.push_back({0, grid.cell(c)->id(), unsigned(in_cell.size())});
      }
    const double whole =
      check_volume(file, body, grid, parts, points, filler.saw_overlap());
    for (auto &point : points)
      point.volume *= whole;

    number_particles(groups, grid.communicator(), points);
    return points;
  }

  template std::vector<SeededPoint<2>> seed_clipped(const ParameterFile &,
                                                    const BodyParameters &,
                                                    const BackgroundGrid<2> &);
  template std::vector<SeededPoint<3>> seed_clipped(const ParameterFile &,
                                                    const BodyParameters &,
                                                    const BackgroundGrid<3> &);
} // namespace Impoint
