#include <impoint/base/parameter_file.h>
#include <impoint/particles/facets.h>
#include <impoint/particles/outline.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace Impoint
{
  namespace
  {
    /** Where facets meet: a vertex (2D), or an edge from its smaller vertex. */
    using Joint = std::array<unsigned int, 2>;

    /** A facet at a joint and the sense in which it passes there. */
    struct Passage
    {
      unsigned int facet;
      bool         forward;
    };



    template <int dim>
    std::map<Joint, std::vector<Passage>>
    joints_of(const std::vector<std::vector<unsigned int>> &facets)
    {
      std::map<Joint, std::vector<Passage>> joints;
      for (unsigned int f = 0; f < facets.size(); ++f)
        for (unsigned int i = 0; i < facets[f].size(); ++i)
          {
            const unsigned int here = facets[f][i];
            const unsigned int next = facets[f][(i + 1) % facets[f].size()];
            if (dim == 2)
              joints[{{here, here}}].push_back({f, i == 0});
            else
              joints[{{std::min(here, next), std::max(here, next)}}].push_back(
                {f, here < next});
          }
      return joints;
    }



    /** 2 (2D) or 6 (3D) times the volume between facets and a vertex of them.
     */
    template <int dim>
    double enclosed_volume(const std::vector<Point<dim>> &vertices,
                           const std::vector<std::vector<unsigned int>> &facets,
                           const std::vector<unsigned int>              &part)
    {
      const Point<dim> origin = vertices[facets[part[0]][0]];
      double           volume = 0;
      for (const unsigned int f : part)
        if constexpr (dim == 2)
          volume += (vertices[facets[f][0]] - origin) *
                    cross_product_2d(vertices[facets[f][1]] - origin);
        else
          for (unsigned int i = 1; i + 1 < facets[f].size(); ++i)
            volume += (vertices[facets[f][0]] - origin) *
                      cross_product_3d(vertices[facets[f][i]] - origin,
                                       vertices[facets[f][i + 1]] - origin);
      return volume;
    }



    /** Walks over facets that touch, turning them to agree with the first. */
    class FacetWalk
    {
    public:
      FacetWalk(std::vector<std::vector<unsigned int>>      &facets,
                const std::map<Joint, std::vector<Passage>> &joints)
        : facets(facets)
        , turned(facets.size(), unknown)
        , neighbors(facets.size())
        , at_edge(facets.size(), false)
      {
        for (const auto &joint : joints)
          {
            const auto &passages = joint.second;
            if (passages.size() == 2)
              for (const unsigned int i : {0, 1})
                neighbors[passages[i].facet].push_back(
                  {passages[1 - i].facet,
                   passages[0].forward != passages[1].forward});
            else
              for (const auto &passage : passages)
                at_edge[passage.facet] = true;
          }
      }

      bool reached(const unsigned int facet) const
      {
        return turned[facet] != unknown;
      }

      /** The connected part with @p first; empty if it is one-sided. */
      std::vector<unsigned int> part(const unsigned int first, bool &closed)
      {
        std::vector<unsigned int> members = {first};
        turned[first]                     = no;
        closed                            = true;
        for (unsigned int i = 0; i < members.size(); ++i)
          {
            closed = closed && !at_edge[members[i]];
            for (const auto &neighbor : neighbors[members[i]])
              {
                const bool turn =
                  (turned[members[i]] == yes) == neighbor.forward;
                const Answer expected = turn ? yes : no;
                if (reached(neighbor.facet))
                  {
                    if (turned[neighbor.facet] != expected)
                      return {};
                    continue;
                  }
                turned[neighbor.facet] = expected;
                members.push_back(neighbor.facet);
              }
          }
        for (const unsigned int f : members)
          if (turned[f] == yes)
            std::reverse(facets[f].begin(), facets[f].end());
        return members;
      }

    private:
      enum Answer : char
      {
        unknown,
        no,
        yes
      };

      std::vector<std::vector<unsigned int>> &facets;
      std::vector<Answer>                     turned;
      std::vector<std::vector<Passage>>       neighbors; // forward: they agree
      std::vector<bool>                       at_edge;
    };
  } // namespace



  template <int dim>
  bool orient_facets(const std::vector<Point<dim>>          &vertices,
                     std::vector<std::vector<unsigned int>> &facets)
  {
    FacetWalk walk(facets, joints_of<dim>(facets));
    for (unsigned int f = 0; f < facets.size(); ++f)
      if (!walk.reached(f))
        {
          bool       closed = true;
          const auto part   = walk.part(f, closed);
          if (part.empty())
            return false;
          if (closed && enclosed_volume(vertices, facets, part) < 0)
            for (const unsigned int member : part)
              std::reverse(facets[member].begin(), facets[member].end());
        }
    return true;
  }



  namespace
  {
    template <int dim>
    std::vector<Corners<dim>> facets_of_mesh(const ParameterFile  &file,
                                             const MeshParameters &parameters)
    {
      Triangulation<dim - 1, dim> mesh;
      make_mesh(file, parameters, mesh);

      std::vector<std::vector<unsigned int>> facets;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          facets.emplace_back();
          for (const unsigned int v : cell->vertex_indices())
            facets.back().push_back(cell->vertex_index(v));
          if (facets.back().size() == 4)
            std::swap(facets.back()[2], facets.back()[3]);
        }
      if (!orient_facets(mesh.get_vertices(), facets))
        throw file.error(parameters.source_entry(),
                         "the surface has one side only",
                         "Give one whose normals can point to one side.");

      std::vector<Corners<dim>> corners;
      for (const auto &facet : facets)
        {
          corners.emplace_back();
          for (const unsigned int v : facet)
            corners.back().push_back(mesh.get_vertices()[v]);
        }
      return corners;
    }



    unsigned int n_parts(const double length, const double longest)
    {
      return longest > 0 ?
               std::max(1., std::ceil(length / longest * (1 - 1e-12))) :
               1;
    }



    std::vector<Corners<2>> segments_of(const std::vector<Corners<2>> &lines,
                                        const double                   longest)
    {
      std::vector<Corners<2>> segments;
      for (const auto &line : lines)
        for (unsigned int i = 0; i + 1 < line.size(); ++i)
          {
            const Tensor<1, 2> side = line[i + 1] - line[i];
            const unsigned int n    = n_parts(side.norm(), longest);
            for (unsigned int k = 0; side.norm() > 0 && k < n; ++k)
              segments.push_back({line[i] + double(k) / n * side,
                                  line[i] + double(k + 1) / n * side});
          }
      return segments;
    }



    /** The plane of a polygon, with its first side as first direction. */
    struct Plane
    {
      explicit Plane(const Corners<3> &polygon)
        : origin(polygon[0])
      {
        const Tensor<1, 3> normal = area_vector(polygon);
        if (normal.norm() == 0 || polygon[1] == polygon[0])
          return;
        first  = (polygon[1] - polygon[0]) / polygon[1].distance(polygon[0]);
        second = cross_product_3d(normal / normal.norm(), first);
      }

      Point<2> inside(const Point<3> &x) const
      {
        return {(x - origin) * first, (x - origin) * second};
      }

      Point<3> in_space(const Point<2> &x) const
      {
        return origin + x[0] * first + x[1] * second;
      }

      Point<3>     origin;
      Tensor<1, 3> first, second;
    };



    /** The cells of an even lattice over the box of @p part, clipped to it. */
    std::vector<Corners<2>> lattice_pieces(const ConvexPolytope<2> &part,
                                           const BoundingBox<2>    &frame,
                                           const double             longest)
    {
      std::vector<Corners<2>> pieces;
      const unsigned int      nx = n_parts(frame.side_length(0), longest);
      const unsigned int      ny = n_parts(frame.side_length(1), longest);
      const auto at = [&](const unsigned int i, const unsigned int k) {
        return Point<2>(frame.lower_bound(0) + frame.side_length(0) * i / nx,
                        frame.lower_bound(1) + frame.side_length(1) * k / ny);
      };
      for (unsigned int k = 0; k < ny; ++k)
        for (unsigned int i = 0; i < nx; ++i)
          {
            const auto cell = ConvexPolytope<2>::from_cell(
              {at(i, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)});
            const auto piece = intersect(part, cell.half_spaces());
            if (!piece.empty() && piece.volume() > 1e-12 * cell.volume())
              pieces.push_back(piece.faces()[0]);
          }
      return pieces;
    }



    void add_polygon(const ParameterFile      &file,
                     const BoundaryParameters &boundary,
                     const Corners<3>         &polygon,
                     std::vector<Corners<3>>  &facets)
    {
      const std::string path = boundary.section + "/Polyline";
      const Plane       plane(polygon);
      Corners<2>        ring;
      double            height = 0;
      for (const auto &corner : polygon)
        {
          ring.push_back(plane.inside(corner));
          height =
            std::max(height, corner.distance(plane.in_space(ring.back())));
        }
      const BoundingBox<2> frame(ring);
      const double size = std::max(frame.side_length(0), frame.side_length(1));
      if (height > 1e-9 * size || !(size > 0))
        throw file.error(path,
                         "the corners of a polygon do not lie in a plane",
                         "Give planar polygons, or a surface mesh.");

      for (const auto &part : convex_parts(file, path, {ring}))
        for (const auto &piece :
             lattice_pieces(part, frame, boundary.segment_length))
          {
            facets.emplace_back();
            for (const auto &corner : piece)
              facets.back().push_back(plane.in_space(corner));
          }
    }
  } // namespace



  template <int dim>
  std::vector<Corners<dim>> make_facets(const ParameterFile      &file,
                                        const BoundaryParameters &boundary)
  {
    std::vector<Corners<dim>> facets;
    if (boundary.polyline.empty())
      facets = facets_of_mesh<dim>(file, boundary.mesh);
    else
      {
        const auto corners = parse_corners<dim>(file,
                                                boundary.section + "/Polyline",
                                                boundary.polyline,
                                                dim);
        if constexpr (dim == 2)
          facets = segments_of(corners, boundary.segment_length);
        else
          for (const auto &polygon : corners)
            add_polygon(file, boundary, polygon, facets);
      }
    if (facets.empty())
      throw file.error(boundary.section + "/Polyline",
                       "the polyline '" + boundary.polyline + "' has no length",
                       "Give corners that differ.");
    if (boundary.flip_normal)
      for (auto &facet : facets)
        std::reverse(facet.begin(), facet.end());
    return facets;
  }

  template std::vector<Corners<2>> make_facets(const ParameterFile &,
                                               const BoundaryParameters &);
  template std::vector<Corners<3>> make_facets(const ParameterFile &,
                                               const BoundaryParameters &);
  template bool                    orient_facets(const std::vector<Point<2>> &,
                                                 std::vector<std::vector<unsigned int>> &);
  template bool                    orient_facets(const std::vector<Point<3>> &,
                                                 std::vector<std::vector<unsigned int>> &);
} // namespace Impoint
