#include <impoint/base/expression.h>
#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/grid/background_grid_tree.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const ParameterFile  &file,
                                      const GridParameters &parameters,
                                      const MPI_Comm        communicator)
    : comm(communicator)
  {
    make_triangulation(file, parameters);
    build_cells();
    build_neighbors();
    detect_lattice();
    tree->list_lattice(*this);
  }



  template <int dim>
  void BackgroundGrid<dim>::make_triangulation(const ParameterFile  &file,
                                               const GridParameters &parameters)
  {
    Triangulation<dim> coarse;
    make_coarse_mesh(file, parameters, coarse);
    is_simplicial = coarse.all_reference_cells_are_simplex();
    if (!is_simplicial && !coarse.all_reference_cells_are_hyper_cube())
      throw file.error(parameters.section + "/File",
                       "the background grid mixes kinds of cells",
                       "use a mesh of quadrilaterals (hexahedra) only or of "
                       "triangles (tetrahedra) only");
    if (is_simplicial)
      {
        mesh = std::make_unique<parallel::shared::Triangulation<dim>>(comm);
        map  = std::make_unique<MappingFE<dim>>(FE_SimplexP<dim>(1));
      }
    else
      {
        mesh =
          std::make_unique<parallel::distributed::Triangulation<dim>>(comm);
        map = std::make_unique<MappingQ1<dim>>();
      }
    mesh->copy_triangulation(coarse);
    refine_mesh(parameters, *mesh);
    refine(file, parameters);
  }



  template <int dim>
  void BackgroundGrid<dim>::refine(const ParameterFile  &file,
                                   const GridParameters &parameters)
  {
    if (parameters.refine_where.empty())
      return;
    if (is_simplicial)
      throw file.error(parameters.section + "/Refine where",
                       "triangles and tetrahedra cannot be refined locally",
                       "use quadrilaterals (hexahedra), or a mesh file that is "
                       "finer where needed");
    const Expression<dim> where(file, parameters.section + "/Refine where", 1);
    for (unsigned int i = 0; i < parameters.refine_times; ++i)
      {
        double more = 0;
        on_all_ranks(comm, [&]() {
          for (const auto &cell : mesh->active_cell_iterators())
            if (cell->is_locally_owned() &&
                where.value(cell->center(), 0, 0) > 0)
              {
                cell->set_refine_flag();
                more += cell->reference_cell().n_isotropic_children() - 1.;
              }
        });
        if (mesh->n_global_active_cells() + Utilities::MPI::sum(more, comm) >
            std::ldexp(1., 31))
          throw file.error(parameters.section + "/Refine times",
                           "refined " + std::to_string(i + 1) +
                             " times, the grid has more than 2^31 cells",
                           "Refine less often, or fewer cells.");
        mesh->execute_coarsening_and_refinement();
      }
  }



  template <int dim>
  void BackgroundGrid<dim>::build_cells()
  {
    const unsigned int n = mesh->n_active_cells();
    iterators.resize(n);
    kind.assign(n, artificial);
    affine.assign(n, false);
    corner.resize(n);
    inverse_jacobian.resize(n);

    std::vector<typename Tree::Leaf> leaves;
    Point<dim>                       lower, upper;
    h_min = std::numeric_limits<double>::max();
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::numeric_limits<double>::max();
        upper[d] = std::numeric_limits<double>::lowest();
      }
    for (const auto &cell : mesh->active_cell_iterators())
      {
        const unsigned int c = cell->active_cell_index();
        iterators[c]         = cell;
        if (cell->is_artificial())
          continue;
        kind[c] = cell->is_locally_owned() ? own : ghost;
        set_affine_map(c);
        const BoundingBox<dim> box = cell->bounding_box();
        leaves.emplace_back(box, c);
        h_min = std::min(h_min, size(c));
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], box.lower_bound(d));
            upper[d] = std::max(upper[d], box.upper_bound(d));
          }
      }
    h_min = Utilities::MPI::min(h_min, comm);
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = Utilities::MPI::min(lower[d], comm);
        upper[d] = Utilities::MPI::max(upper[d], comm);
      }
    bounding_box = BoundingBox<dim>({lower, upper});
    tree         = std::make_shared<Tree>();
    tree->boxes  = pack_rtree(leaves);
  }



  template <int dim>
  void BackgroundGrid<dim>::set_affine_map(const unsigned int c)
  {
    const auto    &cell = iterators[c];
    Tensor<2, dim> jacobian; // columns: edges at vertex 0
    for (unsigned int k = 0; k < dim; ++k)
      {
        const Tensor<1, dim> edge =
          cell->vertex(is_simplicial ? k + 1 : (1 << k)) - cell->vertex(0);
        for (unsigned int d = 0; d < dim; ++d)
          jacobian[d][k] = edge[d];
      }
    corner[c]           = cell->vertex(0);
    inverse_jacobian[c] = invert(jacobian);
    affine[c]           = true;
    if (!is_simplicial)
      for (const unsigned int v : cell->vertex_indices())
        {
          Tensor<1, dim> reference;
          for (unsigned int d = 0; d < dim; ++d)
            reference[d] = (v >> d) & 1;
          const Point<dim> mapped = corner[c] + jacobian * reference;
          if (mapped.distance(cell->vertex(v)) > 1e-10 * cell->diameter())
            affine[c] = false;
        }
  }



  template <int dim>
  void BackgroundGrid<dim>::build_neighbors()
  {
    n_faces = is_simplicial ? dim + 1 : 2 * dim;
    neighbors.assign(std::size_t(n_cells()) * n_faces, nowhere);
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (is_known(c))
        for (unsigned int f = 0; f < n_faces; ++f)
          if (!iterators[c]->at_boundary(f))
            {
              const auto neighbor = iterators[c]->neighbor(f);
              if (!neighbor->is_active())
                neighbors[c * n_faces + f] = refined;
              else if (!neighbor->is_artificial())
                neighbors[c * n_faces + f] = neighbor->active_cell_index();
            }

    if (is_simplicial)
      {
        const auto reference = ReferenceCells::get_simplex<dim>();
        opposite_face.resize(dim + 1);
        for (unsigned int v = 0; v < dim + 1; ++v)
          for (unsigned int f = 0; f < n_faces; ++f)
            {
              const unsigned char standard_orientation = 1;
              bool                holds                = false;
              for (unsigned int i = 0; i < dim; ++i)
                holds |=
                  reference.face_to_cell_vertices(f, i, standard_orientation) ==
                  v;
              if (!holds)
                opposite_face[v] = f;
            }
      }
  }



  template <int dim>
  Tensor<1, dim>
  BackgroundGrid<dim>::Lattice::coordinates(const Point<dim> &x) const
  {
    Tensor<1, dim> place = transpose(axes) * (x - origin);
    for (unsigned int d = 0; d < dim; ++d)
      place[d] /= spacing[d];
    return place;
  }



  template <int dim>
  std::array<int, dim>
  BackgroundGrid<dim>::lattice_place(const unsigned int c) const
  {
    const Tensor<1, dim> coordinates = frame.coordinates(corner[c]);
    std::array<int, dim> place;
    for (unsigned int d = 0; d < dim; ++d)
      place[d] = static_cast<int>(std::lround(coordinates[d]));
    return place;
  }



  /** Sets the inverse Jacobian that all cells of a lattice have: that of the
   * first cell of the lowest rank that knows any. */
  template <int dim>
  bool BackgroundGrid<dim>::agree_on_axes(Tensor<2, dim> &inverse_of_all) const
  {
    std::vector<double> first;
    for (unsigned int c = 0; c < n_cells() && first.empty(); ++c)
      if (is_known(c))
        for (unsigned int i = 0; i < dim * dim; ++i)
          first.push_back(inverse_jacobian[c][i / dim][i % dim]);
    bool found = false;
    for (const auto &entries : Utilities::MPI::all_gather(comm, first))
      for (unsigned int i = 0; i < entries.size() && !found; ++i)
        {
          inverse_of_all[i / dim][i % dim] = entries[i];
          found                            = i + 1 == entries.size();
        }

    bool good = true;
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (is_known(c))
        good = good && affine[c] &&
               (inverse_jacobian[c] - inverse_of_all).norm() <
                 1e-8 * inverse_of_all.norm();
    return Utilities::MPI::min(int(good), comm) != 0;
  }



  template <int dim>
  void BackgroundGrid<dim>::detect_lattice()
  {
    Tensor<2, dim> inverse;
    if (is_simplicial || !agree_on_axes(inverse))
      return;
    const Tensor<2, dim> jacobian = invert(inverse);
    for (unsigned int k = 0; k < dim; ++k)
      {
        Tensor<1, dim> edge;
        for (unsigned int d = 0; d < dim; ++d)
          edge[d] = jacobian[d][k];
        frame.spacing[k] = edge.norm();
        for (unsigned int d = 0; d < dim; ++d)
          frame.axes[d][k] = edge[d] / frame.spacing[k];
      }
    const Tensor<2, dim> gram = transpose(frame.axes) * frame.axes;
    if ((gram - unit_symmetric_tensor<dim>()).norm() > 1e-9)
      return;

    Point<dim>     lowest;
    Tensor<1, dim> highest;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lowest[d]  = std::numeric_limits<double>::max();
        highest[d] = std::numeric_limits<double>::lowest();
        for (unsigned int c = 0; c < n_cells(); ++c)
          if (is_known(c))
            {
              const double place = (transpose(frame.axes) * corner[c])[d];
              lowest[d]          = std::min(lowest[d], place);
              highest[d]         = std::max(highest[d], place);
            }
        lowest[d]        = Utilities::MPI::min(lowest[d], comm);
        highest[d]       = Utilities::MPI::max(highest[d], comm);
        frame.n_cells[d] = 1 + static_cast<int>(std::lround(
                                 (highest[d] - lowest[d]) / frame.spacing[d]));
      }
    frame.origin = Point<dim>(frame.axes * lowest);

    // parts of a grid may stand off each other by a part of a cell
    bool good = true;
    for (unsigned int c = 0; c < n_cells(); ++c)
      if (is_known(c))
        {
          const Tensor<1, dim> place = frame.coordinates(corner[c]);
          for (unsigned int d = 0; d < dim; ++d)
            good = good && std::abs(place[d] - std::round(place[d])) < 1e-6;
        }
    frame.exists = Utilities::MPI::min(int(good), comm) != 0;
  }



  template <int dim>
  double BackgroundGrid<dim>::volume(const unsigned int c) const
  {
    if (!affine[c])
      return iterators[c]->measure();
    const double box = 1. / std::abs(determinant(inverse_jacobian[c]));
    return is_simplicial ? box / (dim == 2 ? 2. : 6.) : box;
  }



  template <int dim>
  double BackgroundGrid<dim>::size(const unsigned int c) const
  {
    const double box =
      is_simplicial ? volume(c) * (dim == 2 ? 2. : 6.) : volume(c);
    return dim == 2 ? std::sqrt(box) : std::cbrt(box);
  }



  template <int dim>
  std::vector<Point<dim>>
  BackgroundGrid<dim>::vertices(const unsigned int c) const
  {
    std::vector<Point<dim>> points;
    for (const unsigned int v : iterators[c]->vertex_indices())
      points.push_back(iterators[c]->vertex(v));
    return points;
  }



  template <int dim>
  std::vector<HalfSpace<dim>>
  BackgroundGrid<dim>::faces(const unsigned int c) const
  {
    const auto                 &cell   = iterators[c];
    const Point<dim>            center = cell->center();
    std::vector<HalfSpace<dim>> half_spaces;
    for (const unsigned int f : cell->face_indices())
      {
        const auto     face = cell->face(f);
        Tensor<1, dim> normal;
        if constexpr (dim == 2)
          normal = cross_product_2d(face->vertex(1) - face->vertex(0));
        else
          normal = cross_product_3d(face->vertex(1) - face->vertex(0),
                                    face->vertex(2) - face->vertex(0));
        normal /= normal.norm();
        if ((face->vertex(0) - center) * normal < 0)
          normal *= -1;
        half_spaces.push_back({face->vertex(0), normal});
      }
    return half_spaces;
  }



  template <int dim>
  std::vector<unsigned int>
  BackgroundGrid<dim>::cells_near(const Point<dim> &lower,
                                  const Point<dim> &upper) const
  {
    namespace bgi = boost::geometry::index;
    std::vector<unsigned int> found;
    const BoundingBox<dim>    query({lower, upper});
    for (auto leaf = tree->boxes.qbegin(bgi::intersects(query));
         leaf != tree->boxes.qend();
         ++leaf)
      found.push_back(leaf->second);
    std::sort(found.begin(), found.end());
    return found;
  }

  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace Impoint
