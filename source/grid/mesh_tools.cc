#include <impoint/grid/mesh.h>
#include <impoint/grid/mesh_tools.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/manifold.h>
#include <deal.II/grid/manifold_lib.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Impoint
{
  template <int spacedim>
  Tensor<2, spacedim> Similarity<spacedim>::unit_tensor()
  {
    return Tensor<2, spacedim>(unit_symmetric_tensor<spacedim>());
  }



  template <int spacedim>
  Similarity<spacedim>::Similarity(const MeshParameters &parameters)
    : scale(parameters.scale)
  {
    const double angle = parameters.rotation * numbers::PI / 180;
    if constexpr (spacedim == 2)
      rotation = Physics::Transformations::Rotations::rotation_matrix_2d(angle);
    else
      {
        Point<3> axis(0, 0, 1);
        if (!parameters.axis.empty())
          for (unsigned int d = 0; d < 3; ++d)
            axis[d] = parameters.axis[d];
        rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
          Point<3>(axis / axis.norm()), angle);
      }
    // A multiple of a right angle maps grid lines onto grid lines exactly.
    for (unsigned int i = 0; i < spacedim; ++i)
      for (unsigned int j = 0; j < spacedim; ++j)
        if (std::abs(rotation[i][j] - std::round(rotation[i][j])) < 1e-15)
          rotation[i][j] = std::round(rotation[i][j]);
    for (unsigned int d = 0; d < parameters.shift.size(); ++d)
      shift[d] = parameters.shift[d];
  }



  template <int spacedim>
  Point<spacedim> Similarity<spacedim>::point(const Point<spacedim> &x) const
  {
    return Point<spacedim>(rotation * (scale * Tensor<1, spacedim>(x)) + shift);
  }



  template <int spacedim>
  Tensor<1, spacedim>
  Similarity<spacedim>::vector(const Tensor<1, spacedim> &v) const
  {
    return rotation * (scale * v);
  }



  template <int spacedim>
  Point<spacedim> Similarity<spacedim>::original(const Point<spacedim> &x) const
  {
    return Point<spacedim>(transpose(rotation) *
                           (Tensor<1, spacedim>(x) - shift) / scale);
  }



  template <int spacedim>
  bool Similarity<spacedim>::is_identity() const
  {
    return scale == 1 && rotation == unit_tensor() &&
           shift == Tensor<1, spacedim>();
  }



  namespace
  {
    /** A manifold moved along with its mesh: asks the one at the old place. */
    template <int dim, int spacedim>
    class MovedManifold : public Manifold<dim, spacedim>
    {
    public:
      MovedManifold(const Manifold<dim, spacedim> &base,
                    const Similarity<spacedim>    &motion)
        : base(base.clone())
        , motion(motion)
      {}

      std::unique_ptr<Manifold<dim, spacedim>> clone() const override
      {
        return std::make_unique<MovedManifold<dim, spacedim>>(*base, motion);
      }

      Point<spacedim>
      get_new_point(const ArrayView<const Point<spacedim>> &points,
                    const ArrayView<const double> &weights) const override
      {
        std::vector<Point<spacedim>> originals;
        for (const auto &x : points)
          originals.push_back(motion.original(x));
        return motion.point(
          base->get_new_point(make_array_view(originals), weights));
      }

      Point<spacedim> get_intermediate_point(const Point<spacedim> &from,
                                             const Point<spacedim> &to,
                                             const double weight) const override
      {
        return motion.point(base->get_intermediate_point(motion.original(from),
                                                         motion.original(to),
                                                         weight));
      }

      Tensor<1, spacedim>
      get_tangent_vector(const Point<spacedim> &from,
                         const Point<spacedim> &to) const override
      {
        return motion.vector(
          base->get_tangent_vector(motion.original(from), motion.original(to)));
      }

    private:
      const std::unique_ptr<const Manifold<dim, spacedim>> base;
      const Similarity<spacedim>                           motion;
    };



    template <int dim, int spacedim>
    bool is_transfinite(const Manifold<dim, spacedim> &manifold)
    {
      return dynamic_cast<
               const TransfiniteInterpolationManifold<dim, spacedim> *>(
               &manifold) != nullptr;
    }
  } // namespace



  template <int dim, int spacedim>
  void renew_transfinite_manifolds(Triangulation<dim, spacedim> &mesh)
  {
    for (const types::manifold_id id : mesh.get_manifold_ids())
      if (id != numbers::flat_manifold_id &&
          is_transfinite(mesh.get_manifold(id)))
        {
          mesh.reset_manifold(id); // initialize() asks what is there
          TransfiniteInterpolationManifold<dim, spacedim> manifold;
          manifold.initialize(mesh);
          mesh.set_manifold(id, manifold);
        }
  }



  template <int dim, int spacedim>
  void move_mesh(const Similarity<spacedim>   &motion,
                 Triangulation<dim, spacedim> &mesh)
  {
    if (motion.is_identity())
      return;
    GridTools::transform(
      [&](const Point<spacedim> &x) { return motion.point(x); }, mesh);
    for (const types::manifold_id id : mesh.get_manifold_ids())
      if (id != numbers::flat_manifold_id &&
          !is_transfinite(mesh.get_manifold(id)))
        mesh.set_manifold(id,
                          MovedManifold<dim, spacedim>(mesh.get_manifold(id),
                                                       motion));
    renew_transfinite_manifolds(mesh);
  }



  namespace
  {
    /** Position of each vertex in the order that chooses the diagonals. */
    template <int dim, int spacedim>
    std::vector<unsigned int>
    vertex_ranks(const Triangulation<dim, spacedim> &mesh)
    {
      const auto  &vertices  = mesh.get_vertices();
      const double tolerance = 1e-9 * GridTools::diameter(mesh);

      // Coordinates that differ by round-off only must not tip the order.
      std::vector<std::array<long long, spacedim + 1>> keys(vertices.size());
      for (unsigned int v = 0; v < vertices.size(); ++v)
        {
          for (unsigned int d = 0; d < spacedim; ++d)
            keys[v][d] =
              std::llround(vertices[v][spacedim - 1 - d] / tolerance);
          keys[v][spacedim] = v;
        }
      std::vector<unsigned int> order(vertices.size()), ranks(vertices.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(),
                order.end(),
                [&](const auto left, const auto right) {
                  return keys[left] < keys[right];
                });
      for (unsigned int i = 0; i < order.size(); ++i)
        ranks[order[i]] = i;
      return ranks;
    }



    /**
     * Cuts the hypercube with @p corners, in lexicographic order, into
     * simplices: a cone from its first corner by rank over the simplices of
     * each facet that does not hold it. A facet that does hold it is cut by the
     * same rule, for the first corner of the cube is that of the facet, too.
     */
    std::vector<std::vector<unsigned int>>
    pull(const std::vector<unsigned int> &corners,
         const std::vector<unsigned int> &ranks)
    {
      if (corners.size() == 1)
        return {corners};
      const unsigned int apex =
        std::min_element(corners.begin(),
                         corners.end(),
                         [&](const auto left, const auto right) {
                           return ranks[left] < ranks[right];
                         }) -
        corners.begin();

      std::vector<std::vector<unsigned int>> simplices;
      for (unsigned int bit = 1; bit < corners.size(); bit *= 2)
        {
          std::vector<unsigned int> facet;
          for (unsigned int i = 0; i < corners.size(); ++i)
            if ((i & bit) != (apex & bit))
              facet.push_back(corners[i]);
          for (auto simplex : pull(facet, ranks))
            {
              simplex.push_back(corners[apex]);
              simplices.push_back(simplex);
            }
        }
      return simplices;
    }



    /** Makes the corners of a simplex follow the orientation of the cell that
     * numbers them: corner i of a cell has the bits of i as coordinates. */
    template <int dim>
    void orient(std::vector<unsigned int> &simplex)
    {
      Tensor<2, dim> edges;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          edges[i][d] =
            double((simplex[i + 1] >> d) & 1) - double((simplex[0] >> d) & 1);
      if (determinant(edges) < 0)
        std::swap(simplex[dim - 1], simplex[dim]);
    }



    template <int dim, int spacedim>
    std::vector<CellData<dim>>
    simplices_of(const Triangulation<dim, spacedim> &source,
                 const std::vector<unsigned int>    &ranks)
    {
      std::vector<unsigned int> local(1 << dim), local_ranks(1 << dim);
      std::iota(local.begin(), local.end(), 0);

      std::vector<CellData<dim>> cells;
      for (const auto &cell : source.active_cell_iterators())
        {
          for (const unsigned int v : local)
            local_ranks[v] = ranks[cell->vertex_index(v)];
          for (auto &simplex : pull(local, local_ranks))
            {
              orient<dim>(simplex);
              CellData<dim> data(dim + 1);
              for (unsigned int i = 0; i < dim + 1; ++i)
                data.vertices[i] = cell->vertex_index(simplex[i]);
              data.material_id = cell->material_id();
              cells.push_back(data);
            }
        }
      return cells;
    }



    /** The boundary ids of @p source, on the simplices of its faces. */
    template <int dim, int spacedim>
    SubCellData boundary_of(const Triangulation<dim, spacedim> &source,
                            const std::vector<unsigned int>    &ranks)
    {
      SubCellData boundary;
      for (const auto &cell : source.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              std::vector<unsigned int> corners;
              for (unsigned int i = 0; i < (1 << (dim - 1)); ++i)
                corners.push_back(cell->face(f)->vertex_index(i));
              for (const auto &simplex : pull(corners, ranks))
                {
                  CellData<dim - 1> face(dim);
                  face.vertices    = simplex;
                  face.boundary_id = cell->face(f)->boundary_id();
                  if constexpr (dim == 2)
                    boundary.boundary_lines.push_back(face);
                  else
                    boundary.boundary_quads.push_back(face);
                }
            }
      return boundary;
    }
  } // namespace



  template <int dim, int spacedim>
  void split_into_simplices(const Triangulation<dim, spacedim> &source,
                            Triangulation<dim, spacedim>       &target)
  {
    if constexpr (dim == 1)
      target.copy_triangulation(source);
    else
      {
        const auto ranks    = vertex_ranks(source);
        auto       cells    = simplices_of(source, ranks);
        auto       boundary = boundary_of(source, ranks);
        auto       vertices = source.get_vertices();
        GridTools::delete_unused_vertices(vertices, cells, boundary);
        target.create_triangulation(vertices, cells, boundary);
      }
  }

#define IMPOINT_INSTANTIATE(dim, spacedim)                                   \
  template void move_mesh(const Similarity<spacedim> &,                      \
                          Triangulation<dim, spacedim> &);                   \
  template void renew_transfinite_manifolds(Triangulation<dim, spacedim> &); \
  template void split_into_simplices(const Triangulation<dim, spacedim> &,   \
                                     Triangulation<dim, spacedim> &);

  template struct Similarity<2>;
  template struct Similarity<3>;
  IMPOINT_INSTANTIATE(2, 2)
  IMPOINT_INSTANTIATE(3, 3)
  IMPOINT_INSTANTIATE(1, 2)
  IMPOINT_INSTANTIATE(2, 3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
