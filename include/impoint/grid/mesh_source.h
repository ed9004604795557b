#ifndef impoint_grid_mesh_source_h
#define impoint_grid_mesh_source_h

#include <deal.II/grid/tria.h>

#include <string>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  class ParameterFile;
  struct MeshParameters;

  /** Names of the functions of dealii::GridGenerator that a scene can call. */
  std::vector<std::string> generator_names();

  /** Endings of the mesh files that can be read, with the dot. */
  std::vector<std::string> mesh_file_endings();

  /** Number of cells beyond which none is tried: what 32 bits count, or this
   * machine's memory can hold. */
  double most_cells();

  /** Reads the mesh file of @p parameters, or calls its generator. Throws
   * InputError if either fails or cells are inverted or flat. */
  template <int dim, int spacedim>
  void generate_or_read(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh);
} // namespace Impoint

#endif
