#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/body_parameters.h>
#include <impoint/particles/outline.h>

#include <algorithm>
#include <sstream>

namespace Impoint
{
  template <int dim>
  std::vector<Corners<dim>> parse_corners(const ParameterFile &file,
                                          const std::string   &path,
                                          const std::string   &text,
                                          const unsigned int   at_least)
  {
    const std::string form = dim == 2 ? "Write corners as 'x y; x y; ...'" :
                                        "Write corners as 'x y z; x y z; ...'";
    std::vector<Corners<dim>> lists;
    for (const auto &list : Words::split(text, '|'))
      {
        lists.emplace_back();
        for (const auto &corner : Words::split(list, ';'))
          {
            std::istringstream words(corner);
            Point<dim>         x;
            for (unsigned int d = 0; d < dim; ++d)
              words >> x[d];
            std::string rest;
            if (!words || words >> rest)
              throw file.error(path,
                               "the corner '" + corner + "' is not " +
                                 std::to_string(dim) + " numbers",
                               form + ".");
            lists.back().push_back(x);
          }
        if (lists.back().size() < at_least)
          throw file.error(path,
                           "'" + list + "' has fewer than " +
                             std::to_string(at_least) + " corners",
                           form + ", lists separated by '|'.");
      }
    return lists;
  }



  namespace
  {
    bool is_convex(const Corners<2> &ring)
    {
      double turns = 0; // of a convex ring once around, of a star more often
      int    side  = 0;
      for (unsigned int i = 0; i < ring.size(); ++i)
        {
          const Tensor<1, 2> here = ring[(i + 1) % ring.size()] - ring[i];
          const Tensor<1, 2> next =
            ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
          const double sine = here[0] * next[1] - here[1] * next[0];
          turns += std::atan2(sine, here * next);
          if (std::abs(sine) < 1e-12 * here.norm() * next.norm())
            continue;
          if (side * sine < 0)
            return false;
          side = sine > 0 ? 1 : -1;
        }
      return std::abs(turns) < 3 * numbers::PI;
    }



    /** A side of the outline that is not horizontal, from below to above. */
    struct Side
    {
      Point<2> low, high;

      double x_at(const double y) const
      {
        if (y == low[1] || y == high[1])
          return y == low[1] ? low[0] : high[0];
        return low[0] + (y - low[1]) / (high[1] - low[1]) * (high[0] - low[0]);
      }
    };



    std::vector<Side> sides_of(const std::vector<Corners<2>> &rings)
    {
      std::vector<Side> sides;
      for (const auto &ring : rings)
        for (unsigned int i = 0; i < ring.size(); ++i)
          {
            const Point<2> here = ring[i], next = ring[(i + 1) % ring.size()];
            if (here[1] < next[1])
              sides.push_back({here, next});
            else if (here[1] > next[1])
              sides.push_back({next, here});
          }
      return sides;
    }



    /** The sides that cross the strip between two heights, left to right. */
    std::vector<Side> sides_across(const std::vector<Side> &sides,
                                   const double             below,
                                   const double             above)
    {
      std::vector<Side> across;
      for (const auto &side : sides)
        if (side.low[1] <= below && side.high[1] >= above)
          across.push_back(side);
      std::sort(across.begin(),
                across.end(),
                [&](const Side &a, const Side &b) {
                  const double middle = (below + above) / 2;
                  return a.x_at(middle) < b.x_at(middle);
                });
      return across;
    }



    void add_trapezoids(const std::vector<Side>        &across,
                        const double                    below,
                        const double                    above,
                        std::vector<ConvexPolytope<2>> &parts)
    {
      for (unsigned int i = 0; i + 1 < across.size(); i += 2)
        {
          const Side &left = across[i], &right = across[i + 1];
          Corners<2>  corners;
          for (const Point<2> &corner : {Point<2>(left.x_at(below), below),
                                         Point<2>(right.x_at(below), below),
                                         Point<2>(right.x_at(above), above),
                                         Point<2>(left.x_at(above), above)})
            if (corners.empty() || corners.back() != corner)
              corners.push_back(corner);
          if (corners.back() == corners.front())
            corners.pop_back();
          if (corners.size() > 2)
            parts.emplace_back(std::vector<Corners<2>>{corners});
        }
    }
  } // namespace



  std::vector<ConvexPolytope<2>>
  convex_parts(const ParameterFile           &file,
               const std::string             &path,
               const std::vector<Corners<2>> &rings)
  {
    std::vector<ConvexPolytope<2>> parts;
    if (rings.size() == 1 && is_convex(rings[0]))
      {
        parts.emplace_back(rings);
        return parts;
      }
    std::vector<double> heights;
    double              size = 0;
    for (const auto &ring : rings)
      for (const auto &corner : ring)
        {
          heights.push_back(corner[1]);
          size = std::max(size, corner.distance(rings[0][0]));
        }
    std::sort(heights.begin(), heights.end());

    const auto sides = sides_of(rings);
    for (unsigned int i = 0; i + 1 < heights.size(); ++i)
      {
        const double below = heights[i], above = heights[i + 1];
        if (above - below <= 1e-15 * size)
          continue;
        const auto across = sides_across(sides, below, above);
        for (unsigned int k = 0; k + 1 < across.size(); ++k)
          for (const double y : {below, above})
            if (across[k].x_at(y) > across[k + 1].x_at(y) + 1e-12 * size)
              throw file.error(path,
                               "sides of the outline cross between y = " +
                                 Words::exact(below) + " and " +
                                 Words::exact(above),
                               "Give the corners in the order of a walk along "
                               "the outline.");
        add_trapezoids(across, below, above, parts);
      }
    return parts;
  }



  namespace
  {
    bool has_warped_face(const Triangulation<3>::active_cell_iterator &cell)
    {
      for (const auto &face : cell->face_iterators())
        if (face->n_vertices() == 4)
          {
            const Tensor<1, 3> normal =
              cross_product_3d(face->vertex(1) - face->vertex(0),
                               face->vertex(2) - face->vertex(0));
            const double height =
              (face->vertex(3) - face->vertex(0)) * normal / normal.norm();
            if (std::abs(height) > 1e-12 * cell->diameter())
              return true;
          }
      return false;
    }



    Point<3> mean(const std::vector<Point<3>> &corners)
    {
      Point<3> sum;
      for (const auto &corner : corners)
        sum += corner / double(corners.size());
      return sum;
    }



    /** Tetrahedra between the cell's middle, a face's and each of its edges: a
     * neighbour cuts their face in the same way, so nothing gapes. */
    void add_tetrahedra(const std::vector<Point<3>>    &vertices,
                        std::vector<ConvexPolytope<3>> &parts)
    {
      const auto faces = ConvexPolytope<3>::from_cell(vertices).faces();
      for (const auto &face : faces)
        for (unsigned int i = 0; i < face.size(); ++i)
          parts.push_back(
            ConvexPolytope<3>::from_cell({mean(vertices),
                                          mean(face),
                                          face[i],
                                          face[(i + 1) % face.size()]}));
    }
  } // namespace



  template <int dim>
  std::vector<ConvexPolytope<dim>> body_parts(const ParameterFile  &file,
                                              const BodyParameters &body)
  {
    if constexpr (dim == 2)
      if (!body.outline.empty())
        {
          const std::string path = body.section + "/Outline";
          return convex_parts(file,
                              path,
                              parse_corners<2>(file, path, body.outline, 3));
        }

    Triangulation<dim> mesh;
    make_mesh(file, body.mesh, mesh);
    std::vector<ConvexPolytope<dim>> parts;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        std::vector<Point<dim>> vertices;
        for (const unsigned int v : cell->vertex_indices())
          vertices.push_back(cell->vertex(v));
        if (cell->reference_cell() != ReferenceCells::get_simplex<dim>() &&
            cell->reference_cell() != ReferenceCells::get_hypercube<dim>())
          throw file.error(body.mesh.section + "/File",
                           "a cell of the kind " +
                             cell->reference_cell().to_string(),
                           "Use a mesh of tetrahedra and hexahedra.");
        if constexpr (dim == 3)
          if (has_warped_face(cell))
            {
              add_tetrahedra(vertices, parts);
              continue;
            }
        parts.push_back(ConvexPolytope<dim>::from_cell(vertices));
      }
    return parts;
  }

  template std::vector<Corners<2>>        parse_corners(const ParameterFile &,
                                                        const std::string &,
                                                        const std::string &,
                                                        const unsigned int);
  template std::vector<Corners<3>>        parse_corners(const ParameterFile &,
                                                        const std::string &,
                                                        const std::string &,
                                                        const unsigned int);
  template std::vector<ConvexPolytope<2>> body_parts(const ParameterFile &,
                                                     const BodyParameters &);
  template std::vector<ConvexPolytope<3>> body_parts(const ParameterFile &,
                                                     const BodyParameters &);
} // namespace Impoint
