#ifndef impoint_grid_background_grid_h
#define impoint_grid_background_grid_h

#include <impoint/grid/mesh.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  class ParameterFile;

  /** A half space: the points x with (x - point) * normal <= 0. */
  template <int dim>
  struct HalfSpace
  {
    Point<dim>     point;
    Tensor<1, dim> normal; // unit, outward
  };

  /**
   * The fixed background grid: cells by number, their geometry, which of them
   * holds a place, and how to get from one to the next. Cells are numbered as
   * deal.II's active_cell_index on this rank; ghost cells included.
   *
   * Knows no particles. Everything that costs O(all cells) happens in the
   * constructor.
   */
  template <int dim>
  class BackgroundGrid
  {
  public:
    static constexpr unsigned int nowhere = numbers::invalid_unsigned_int;

    using CellIterator = typename Triangulation<dim>::active_cell_iterator;

    BackgroundGrid(const ParameterFile  &file,
                   const GridParameters &parameters,
                   const MPI_Comm        communicator);

    const Triangulation<dim> &triangulation() const
    {
      return *mesh;
    }
    const Mapping<dim> &mapping() const
    {
      return *map;
    }
    MPI_Comm communicator() const
    {
      return comm;
    }
    bool simplicial() const
    {
      return is_simplicial;
    }

    unsigned int n_cells() const
    {
      return iterators.size();
    }
    CellIterator cell(const unsigned int c) const
    {
      return iterators[c];
    }
    bool is_owned(const unsigned int c) const
    {
      return kind[c] == own;
    }

    /** Whether this rank knows the cell (it owns it or it is a ghost). */
    bool is_known(const unsigned int c) const
    {
      return kind[c] != artificial;
    }

    bool is_affine(const unsigned int c) const
    {
      return affine[c];
    }

    /** Inverse of the Jacobian of an affine cell. */
    const Tensor<2, dim> &inverse_jacobian_of(const unsigned int c) const
    {
      return inverse_jacobian[c];
    }

    double volume(const unsigned int c) const;

    /** Edge length h of the cell: of the hypercube (or of the simplex that is
     * a corner of one) of the same volume. */
    double size(const unsigned int c) const;

    /** Smallest h of the whole grid, all ranks. */
    double smallest_size() const
    {
      return h_min;
    }

    /** Box around the whole grid, all ranks. */
    const BoundingBox<dim> &box() const
    {
      return bounding_box;
    }

    std::vector<Point<dim>>     vertices(const unsigned int c) const;
    std::vector<HalfSpace<dim>> faces(const unsigned int c) const;

    /** The known cells beyond the faces of cell @p c; numbers that are no
     * cell's at the grid's boundary, and where those beyond are finer. */
    ArrayView<const unsigned int> neighbors_of(const unsigned int c) const
    {
      return ArrayView<const unsigned int>(&neighbors[std::size_t(c) * n_faces],
                                           n_faces);
    }

    /** Cells (owned and ghost) whose bounding box meets the given one, in
     * increasing order. */
    std::vector<unsigned int> cells_near(const Point<dim> &lower,
                                         const Point<dim> &upper) const;

    /** Reference coordinates of @p x in cell @p c (anywhere in space). */
    Point<dim> to_reference(const unsigned int c, const Point<dim> &x) const
    {
      const Point<dim> linear(inverse_jacobian[c] * (x - corner[c]));
      return affine[c] ? linear : to_reference_curved(c, x, linear);
    }

    /** Whether reference coordinates lie in the cell, up to round-off. */
    bool is_inside(const Point<dim> &xi, const double tolerance = 1e-12) const
    {
      return outside_by(xi) <= tolerance;
    }

    /** The cell that holds @p x, found by walking from @p start; sets its
     * reference coordinates. nowhere if outside of this rank's cells. */
    unsigned int
    walk(const Point<dim> &x, const unsigned int start, Point<dim> &xi) const;

    /** The cell that holds @p x, without a hint. On faces the choice does
     * not depend on the number of ranks. */
    unsigned int find(const Point<dim> &x, Point<dim> &xi) const;

    /** Frame of a Cartesian grid (possibly rotated): x = origin + axes * (h i).
     * The same on all ranks. */
    struct Lattice
    {
      bool                 exists = false;
      Point<dim>           origin; // the lowest corner of the box of all cells
      Tensor<2, dim>       axes;   // columns: unit vectors along the grid lines
      Tensor<1, dim>       spacing;
      std::array<int, dim> n_cells = {}; // of the box of all cells

      /** i of the place @p x, not rounded. */
      Tensor<1, dim> coordinates(const Point<dim> &x) const;
    };
    const Lattice &lattice() const
    {
      return frame;
    }

    /** Place of a known cell in the lattice: its lowest corner. */
    std::array<int, dim> lattice_place(const unsigned int c) const;

  private:
    enum Kind : char
    {
      artificial,
      ghost,
      own
    };
    static constexpr unsigned int refined = numbers::invalid_unsigned_int - 1;

    void make_triangulation(const ParameterFile  &file,
                            const GridParameters &parameters);
    void refine(const ParameterFile &file, const GridParameters &parameters);
    void build_cells();
    void build_neighbors();
    void set_affine_map(const unsigned int c);
    bool agree_on_axes(Tensor<2, dim> &inverse_of_all) const;
    void detect_lattice();
    Point<dim> to_reference_curved(const unsigned int c,
                                   const Point<dim>  &x,
                                   const Point<dim>  &linear) const;
    void       order_faces(const Point<dim>            &xi,
                           std::array<unsigned int, 6> &faces,
                           unsigned int                &n_violated) const;

    /** How far outside of the cell reference coordinates are. */
    double outside_by(const Point<dim> &xi) const
    {
      double worst = -xi[0], sum = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          worst = std::max(worst, -xi[d]);
          if (!is_simplicial)
            worst = std::max(worst, xi[d] - 1);
          sum += xi[d];
        }
      return is_simplicial ? std::max(worst, sum - 1) : worst;
    }

    unsigned int next_cell(const unsigned int c,
                           const unsigned int face,
                           const Point<dim>  &x) const;

    MPI_Comm                            comm;
    std::unique_ptr<Triangulation<dim>> mesh;
    std::unique_ptr<Mapping<dim>>       map;
    bool                                is_simplicial = false;
    std::vector<CellIterator>           iterators;
    std::vector<Kind>                   kind;
    std::vector<char>                   affine;
    std::vector<Point<dim>>             corner; // of affine cells: vertex 0
    std::vector<Tensor<2, dim>>         inverse_jacobian; // of affine cells
    std::vector<unsigned int>           neighbors;        // n_cells * max faces
    std::vector<unsigned int> opposite_face; // of a simplex's vertices
    unsigned int              n_faces = 0;
    double                    h_min   = 0;
    BoundingBox<dim>          bounding_box;
    Lattice                   frame;

    struct Tree; // r-tree of the cells' boxes
    std::shared_ptr<Tree> tree;
  };
} // namespace Impoint

#endif
