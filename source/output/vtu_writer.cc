#include <impoint/base/on_all_ranks.h>
#include <impoint/output/vtu_writer.h>

#include <deal.II/base/data_out_base.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <tuple>

namespace Impoint
{
  namespace
  {
    /** What deal.II wants to know of the rows of data, and where each row's
     * values stand. */
    template <int dim>
    class VtuLayout
    {
    public:
      explicit VtuLayout(const PointFields<dim> &points)
      {
        for (const NamedField &field : points.fields)
          add(field, points.positions.size(), false);
      }

      explicit VtuLayout(const GridFields<dim> &grid)
      {
        for (const NamedField &field : grid.vertex_fields)
          add(field, grid.vertices.size(), false);
        for (const NamedField &field : grid.cell_fields)
          add(field, grid.vertices.size() / grid.vertices_per_cell(), true);
      }

      /** Sets column @p column of @p table to the values of a vertex and its
       * cell (or of a point). */
      void copy(const std::size_t  vertex,
                const std::size_t  cell,
                const unsigned int column,
                Table<2, float>   &table) const
      {
        for (unsigned int r = 0; r < rows.size(); ++r)
          table(r, column) =
            rows[r].values[(rows[r].of_cell ? cell : vertex) * rows[r].stride];
      }

      std::vector<std::string> names; // a row
      std::vector<
        std::tuple<unsigned int,
                   unsigned int,
                   std::string,
                   DataComponentInterpretation::DataComponentInterpretation>>
        ranges; // of rows that make up vectors and tensors

    private:
      struct Row
      {
        const double *values; // of the first item
        unsigned int  stride;
        bool          of_cell;
      };

      void add(const NamedField &field,
               const std::size_t n_items,
               const bool        of_cell)
      {
        const unsigned int n = field.n_components;
        Assert(n == 1 || n == dim || n == 6 || n == 9,
               ExcMessage("Field " + field.name +
                          " is no scalar, vector or tensor."));
        AssertDimension(field.data.size(), n_items * n);
        (void)n_items;

        std::vector<unsigned int> components(n);
        std::iota(components.begin(), components.end(), 0);
        if (n == 6)
          components = {0, 3, 4, 3, 1, 5, 4, 5, 2}; // Voigt<3> to 3 x 3

        if (n > 1)
          ranges.emplace_back(
            rows.size(),
            rows.size() + components.size() - 1,
            field.name,
            n == dim ?
              DataComponentInterpretation::component_is_part_of_vector :
              DataComponentInterpretation::component_is_part_of_tensor);
        for (const unsigned int component : components)
          {
            names.push_back(field.name);
            rows.push_back({field.data.data() + component, n, of_cell});
          }
      }

      std::vector<Row> rows;
    };

    template <int dim>
    std::vector<DataOutBase::Patch<0, dim>>
    vtu_patches(const PointFields<dim> &points, const VtuLayout<dim> &layout)
    {
      std::vector<DataOutBase::Patch<0, dim>> patches(points.positions.size());
      for (std::size_t p = 0; p < patches.size(); ++p)
        {
          patches[p].vertices[0] = points.positions[p];
          patches[p].patch_index = p;
          patches[p].data.reinit(layout.names.size(), 1);
          layout.copy(p, p, 0, patches[p].data);
        }
      return patches;
    }

    template <int dim>
    std::vector<DataOutBase::Patch<dim, dim>>
    vtu_patches(const GridFields<dim> &grid, const VtuLayout<dim> &layout)
    {
      const unsigned int n_vertices = grid.vertices_per_cell();
      const unsigned int n_rows     = layout.names.size();
      std::vector<DataOutBase::Patch<dim, dim>> patches(grid.vertices.size() /
                                                        n_vertices);
      for (std::size_t cell = 0; cell < patches.size(); ++cell)
        {
          DataOutBase::Patch<dim, dim> &patch = patches[cell];
          patch.patch_index                   = cell;
          patch.reference_cell                = grid.simplices ?
                                                  ReferenceCells::get_simplex<dim>() :
                                                  ReferenceCells::get_hypercube<dim>();
          // of simplices deal.II reads the vertices from rows behind the data
          patch.points_are_available = grid.simplices;
          patch.data.reinit(n_rows + (grid.simplices ? dim : 0), n_vertices);
          for (unsigned int v = 0; v < n_vertices; ++v)
            {
              const std::size_t vertex = cell * n_vertices + v;
              patch.vertices[v]        = grid.vertices[vertex];
              layout.copy(vertex, cell, v, patch.data);
              for (unsigned int d = 0; grid.simplices && d < dim; ++d)
                patch.data(n_rows + d, v) = grid.vertices[vertex][d];
            }
        }
      return patches;
    }

    /** This rank's part of the file; ranks without an item have none, but if
     * all are without, rank 0 writes an empty one. */
    template <int dim, typename Fields>
    std::string vtu_piece(const Fields &fields, const MPI_Comm comm)
    {
      const VtuLayout<dim> layout(fields);
      const auto           patches = vtu_patches(fields, layout);
      const unsigned int   rank    = Utilities::MPI::this_mpi_process(comm);
      const bool           any =
        Utilities::MPI::max(static_cast<unsigned int>(!patches.empty()), comm);

      DataOutBase::VtkFlags flags;
      flags.print_date_and_time = false;
      flags.compression_level   = DataOutBase::VtkFlags::best_speed;
      std::ostringstream piece;
      if (rank == 0)
        DataOutBase::write_vtu_header(piece, flags);
      if (!patches.empty() || (rank == 0 && !any))
        DataOutBase::write_vtu_main(
          patches, layout.names, layout.ranges, flags, piece);
      return piece.str();
    }
  } // namespace



  template <int dim>
  CollectionWriter<dim>::CollectionWriter(const OutputFolder &folder,
                                          const std::string  &name)
    : folder(folder.path())
    , name(name)
    , comm(folder.communicator())
  {}



  template <int dim>
  void CollectionWriter<dim>::write(const double            time,
                                    const PointFields<dim> &points)
  {
    write_pieces(time, vtu_piece<dim>(points, comm));
  }



  template <int dim>
  void CollectionWriter<dim>::write(const double           time,
                                    const GridFields<dim> &grid)
  {
    write_pieces(time, vtu_piece<dim>(grid, comm));
  }



  template <int dim>
  void CollectionWriter<dim>::write_pieces(const double       time,
                                           const std::string &piece)
  {
    const std::string file_name =
      "vtu/" + name + "-" +
      Utilities::int_to_string(times_and_files.size(), 5) + ".vtu";
    const std::string path = folder + "/" + file_name, part = path + ".part";

    std::ofstream file;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      {
        std::error_code ignored; // the file cannot be opened then, either
        std::filesystem::create_directory(folder + "/vtu", ignored);
        file.open(part, std::ios::binary);
      }
    collect_on_root(piece, comm, [&](const std::string &of_rank) {
      file << of_rank;
    });

    times_and_files.emplace_back(time, file_name);
    on_root(comm, [&]() {
      std::ostringstream footer, record;
      DataOutBase::write_vtu_footer(footer);
      file << footer.str();
      file.close();
      if (!file || std::rename(part.c_str(), path.c_str()) != 0)
        throw cannot_write(path);
      record.precision(15);
      DataOutBase::write_pvd_record(record, times_and_files);
      write_atomically(folder + "/" + name + ".pvd", record.str());
    });
  }
} // namespace Impoint

template class Impoint::CollectionWriter<2>;
template class Impoint::CollectionWriter<3>;
