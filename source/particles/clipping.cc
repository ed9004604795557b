#include <impoint/particles/clipping.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Impoint
{
  Tensor<1, 3> area_vector(const Corners<3> &polygon)
  {
    Tensor<1, 3> sum;
    for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
      sum +=
        cross_product_3d(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    return 0.5 * sum;
  }



  template <int dim>
  double simplex_volume(const std::array<Point<dim>, dim + 1> &simplex)
  {
    Tensor<2, dim> edges;
    for (unsigned int i = 0; i < dim; ++i)
      edges[i] = simplex[i + 1] - simplex[0];
    return determinant(edges) / (dim == 2 ? 2. : 6.);
  }



  namespace
  {
    /** Signed distances of @p corners from the border; round-off becomes 0. */
    template <int dim>
    std::vector<double> distances_to(const HalfSpace<dim> &half_space,
                                     const Corners<dim>   &corners)
    {
      std::vector<double> distances;
      for (const auto &corner : corners)
        {
          const double distance =
            (corner - half_space.point) * half_space.normal;
          const double round_off = 4 * std::numeric_limits<double>::epsilon() *
                                   (corner.norm() + half_space.point.norm());
          distances.push_back(std::abs(distance) <= round_off ? 0. : distance);
        }
      return distances;
    }



    template <int dim>
    void add_unless_last(Corners<dim> &corners, const Point<dim> &corner)
    {
      if (corners.empty() || corners.back() != corner)
        corners.push_back(corner);
    }



    /** Clips by given distances (Sutherland and Hodgman); notes in @p border
     * the corners of the result that lie on the half space's border. */
    template <int dim>
    void clip_at(Corners<dim>              &corners,
                 const std::vector<double> &distances,
                 Corners<dim>              &border)
    {
      Corners<dim> kept;
      for (unsigned int i = 0; i < corners.size(); ++i)
        {
          const unsigned int next = (i + 1) % corners.size();
          const double       here = distances[i], there = distances[next];
          if (here <= 0)
            add_unless_last(kept, corners[i]);
          if (here == 0)
            border.push_back(corners[i]);
          if ((here < 0 && there > 0) || (here > 0 && there < 0))
            {
              // From the inner to the outer end, so that the two polygons that
              // share an edge find the very same point.
              const unsigned int in  = here < 0 ? i : next,
                                 out = here < 0 ? next : i;
              const double t = distances[in] / (distances[in] - distances[out]);
              const Point<dim> cut =
                corners[in] + t * (corners[out] - corners[in]);
              add_unless_last(kept, cut);
              border.push_back(cut);
            }
        }
      while (kept.size() > 1 && kept.back() == kept.front())
        kept.pop_back();
      corners = kept;
    }



    /** The face that closes a clipped polyhedron: its corners by angle. */
    Corners<3> closing_face(const Corners<3>   &border,
                            const Tensor<1, 3> &normal)
    {
      Point<3> center;
      for (const auto &corner : border)
        center += corner / double(border.size());

      Tensor<1, 3> first; // the farthest corner: a safe direction to count from
      for (const auto &corner : border)
        if ((corner - center).norm_square() > first.norm_square())
          first = corner - center;
      const Tensor<1, 3> second = cross_product_3d(normal, first);

      std::vector<std::pair<double, unsigned int>> order;
      for (unsigned int i = 0; i < border.size(); ++i)
        order.emplace_back(std::atan2((border[i] - center) * second,
                                      (border[i] - center) * first),
                           i);
      std::sort(order.begin(), order.end());
      Corners<3> face;
      for (const auto &angle_and_index : order)
        add_unless_last(face, border[angle_and_index.second]);
      return face;
    }



    template <int dim>
    std::vector<std::vector<unsigned int>>
    faces_of_cell(const unsigned int n_vertices)
    {
      if constexpr (dim == 2)
        return {n_vertices == 3 ? std::vector<unsigned int>{0, 1, 2} :
                                  std::vector<unsigned int>{0, 1, 3, 2}};
      else if (n_vertices == 4)
        return {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
      else
        return {{0, 4, 6, 2},
                {1, 3, 7, 5},
                {0, 1, 5, 4},
                {2, 6, 7, 3},
                {0, 2, 3, 1},
                {4, 5, 7, 6}};
    }
  } // namespace



  template <int dim>
  void clip(Corners<dim> &corners, const HalfSpace<dim> &half_space)
  {
    const auto distances = distances_to(half_space, corners);
    if (std::all_of(distances.begin(), distances.end(), [](const double d) {
          return d >= 0;
        }))
      return corners.clear();
    Corners<dim> border;
    clip_at(corners, distances, border);
  }



  template <int dim>
  ConvexPolytope<dim>::ConvexPolytope(const std::vector<Corners<dim>> &faces)
    : polygons(faces)
  {
    if constexpr (dim == 2)
      if (volume() < 0)
        std::reverse(polygons[0].begin(), polygons[0].end());
  }



  template <int dim>
  ConvexPolytope<dim>
  ConvexPolytope<dim>::from_cell(const std::vector<Point<dim>> &vertices)
  {
    std::vector<Corners<dim>> faces;
    for (const auto &face : faces_of_cell<dim>(vertices.size()))
      {
        faces.emplace_back();
        for (const unsigned int v : face)
          faces.back().push_back(vertices[v]);
      }
    ConvexPolytope polytope(faces);
    if (polytope.volume() < 0) // tetrahedra come in both orientations
      for (auto &polygon : polytope.polygons)
        std::reverse(polygon.begin(), polygon.end());
    return polytope;
  }



  template <int dim>
  template <typename Function>
  void ConvexPolytope<dim>::for_each_simplex(const Function &function) const
  {
    if (empty())
      return;
    const Point<dim> apex = polygons[0][0];
    for (const auto &polygon : polygons)
      for (unsigned int i = 1; i + 1 < polygon.size(); ++i)
        {
          Simplex simplex;
          if constexpr (dim == 2)
            simplex = {{apex, polygon[i], polygon[i + 1]}};
          else
            simplex = {{apex, polygon[0], polygon[i], polygon[i + 1]}};
          function(simplex, simplex_volume<dim>(simplex));
        }
  }



  template <int dim>
  double ConvexPolytope<dim>::volume() const
  {
    double sum = 0;
    for_each_simplex([&](const Simplex &, const double part) { sum += part; });
    return sum;
  }



  template <int dim>
  Point<dim> ConvexPolytope<dim>::centroid() const
  {
    const Point<dim> apex = polygons.at(0).at(0);
    Tensor<1, dim>   moment;
    double           sum = 0;
    for_each_simplex([&](const Simplex &simplex, const double part) {
      for (unsigned int i = 1; i < dim + 1; ++i)
        moment += part / (dim + 1) * (simplex[i] - apex);
      sum += part;
    });
    return apex + moment / sum;
  }



  template <int dim>
  BoundingBox<dim> ConvexPolytope<dim>::box() const
  {
    std::vector<Point<dim>> all;
    for (const auto &polygon : polygons)
      all.insert(all.end(), polygon.begin(), polygon.end());
    return BoundingBox<dim>(all);
  }



  template <int dim>
  void ConvexPolytope<dim>::clip(const HalfSpace<dim> &half_space)
  {
    std::vector<std::vector<double>> distances;
    double                           depth = 0, height = 0;
    for (const auto &polygon : polygons)
      {
        distances.push_back(distances_to(half_space, polygon));
        for (const double distance : distances.back())
          {
            depth  = std::max(depth, -distance);
            height = std::max(height, distance);
          }
      }
    // A face that already lies on the border, but for the round-off of earlier
    // cuts, must not be cut off and closed again.
    const double round_off = 1e-14 * (depth + height);
    if (depth <= round_off)
      return polygons.clear();
    if (height <= round_off)
      return;

    Corners<dim> border;
    for (unsigned int i = 0; i < polygons.size(); ++i)
      clip_at(polygons[i], distances[i], border);
    polygons.erase(std::remove_if(polygons.begin(),
                                  polygons.end(),
                                  [](const Corners<dim> &polygon) {
                                    return polygon.size() < 3;
                                  }),
                   polygons.end());
    if constexpr (dim == 3)
      {
        const Corners<3> cap = closing_face(border, half_space.normal);
        if (cap.size() > 2)
          polygons.push_back(cap);
      }
  }



  template <int dim>
  bool ConvexPolytope<dim>::is_outside(const HalfSpace<dim> &half_space) const
  {
    for (const auto &polygon : polygons)
      for (const auto &corner : polygon)
        if ((corner - half_space.point) * half_space.normal < 0)
          return false;
    return true;
  }



  template <int dim>
  std::vector<HalfSpace<dim>> ConvexPolytope<dim>::half_spaces() const
  {
    std::vector<HalfSpace<dim>> planes;
    const auto                  add = [&](const Point<dim>     &point,
                         const Tensor<1, dim> &normal) {
      if (normal.norm() > 0)
        planes.push_back({point, normal / normal.norm()});
    };
    for (const auto &polygon : polygons)
      if constexpr (dim == 3)
        add(polygon[0], area_vector(polygon));
      else
        for (unsigned int i = 0; i < polygon.size(); ++i)
          add(polygon[i],
              cross_product_2d(polygon[(i + 1) % polygon.size()] - polygon[i]));
    return planes;
  }



  template <int dim>
  std::vector<typename ConvexPolytope<dim>::Simplex>
  ConvexPolytope<dim>::simplices() const
  {
    std::vector<Simplex> list;
    const double         smallest = 1e-14 * volume();
    for_each_simplex([&](const Simplex &simplex, const double part) {
      if (part > smallest)
        list.push_back(simplex);
    });
    return list;
  }



  template <int dim>
  ConvexPolytope<dim> intersect(ConvexPolytope<dim>                polytope,
                                const std::vector<HalfSpace<dim>> &half_spaces)
  {
    for (const auto &half_space : half_spaces)
      if (!polytope.empty())
        polytope.clip(half_space);
    return polytope;
  }

  template class ConvexPolytope<2>;
  template class ConvexPolytope<3>;
  template void              clip(Corners<2> &, const HalfSpace<2> &);
  template void              clip(Corners<3> &, const HalfSpace<3> &);
  template ConvexPolytope<2> intersect(ConvexPolytope<2>,
                                       const std::vector<HalfSpace<2>> &);
  template ConvexPolytope<3> intersect(ConvexPolytope<3>,
                                       const std::vector<HalfSpace<3>> &);
  template double            simplex_volume<2>(const std::array<Point<2>, 3> &);
  template double            simplex_volume<3>(const std::array<Point<3>, 4> &);
} // namespace Impoint
