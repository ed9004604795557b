#ifndef impoint_output_vtu_writer_h
#define impoint_output_vtu_writer_h

#include <impoint/base/state_archive.h>
#include <impoint/output/output_folder.h>

#include <deal.II/base/point.h>

#include <string>
#include <utility>
#include <vector>

namespace Impoint
{
  /**
   * A quantity at points or cells, item by item. Of n_components = 1 it is a
   * scalar, of dim a vector, of 6 a symmetric tensor (order of Voigt<3>), of 9
   * a tensor (row-major). In 2D, tensors are three-dimensional as well: plane
   * strain has stresses across the plane.
   */
  struct NamedField
  {
    std::string         name;
    unsigned int        n_components = 1;
    std::vector<double> data; // n_components * number of items
  };

  /** This rank's part of a cloud of points. */
  template <int dim>
  struct PointFields
  {
    std::vector<Point<dim>> positions;
    std::vector<NamedField> fields;
  };

  /** This rank's cells, all hypercubes or all simplices. */
  template <int dim>
  struct GridFields
  {
    unsigned int vertices_per_cell() const
    {
      return simplices ? dim + 1 : (1 << dim);
    }

    bool                    simplices = false;
    std::vector<Point<dim>> vertices;      // cell by cell, in deal.II's order
    std::vector<NamedField> vertex_fields; // items as in vertices
    std::vector<NamedField> cell_fields;
  };

  /**
   * A quantity's course for ParaView: writes vtu/NAME-00012.vtu, one file for
   * all ranks, and keeps NAME.pvd, the list of files and times, up to date.
   * Values are single precision. All ranks pass the same names of fields, in
   * the same order, also where they have no item.
   */
  template <int dim>
  class CollectionWriter
  {
  public:
    /** Writes nothing yet. */
    CollectionWriter(const OutputFolder &folder, const std::string &name);

    /** Collective; throws RunFailed. */
    void write(const double time, const PointFields<dim> &points);
    void write(const double time, const GridFields<dim> &grid);

    /** Which files there are, for a run that is resumed. */
    void save_or_load(StateArchive &archive)
    {
      archive &times_and_files;
    }

  private:
    void write_pieces(const double time, const std::string &piece);

    std::string                                 folder;
    std::string                                 name;
    MPI_Comm                                    comm;
    std::vector<std::pair<double, std::string>> times_and_files;
  };
} // namespace Impoint

#endif
