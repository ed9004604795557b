#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/grid/mesh.h>
#include <impoint/grid/mesh_source.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_in.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <limits>
#include <map>
#include <sstream>

namespace Impoint
{
  namespace
  {
    /** The generators and what their arguments mean, for messages. */
    const std::map<std::string, std::string> &generator_arguments()
    {
      static const std::map<std::string, std::string> arguments = {
        {"channel_with_cylinder",
         "width of the shells : number of shells : skewness : colorize"},
        {"cheese", "holes in x, y, ..."},
        {"concentric_hyper_shells",
         "centre : inner radius : outer radius : shells : skewness : cells a "
         "shell : colorize"},
        {"cylinder", "radius : half length"},
        {"cylinder_shell",
         "length : inner radius : outer radius : radial cells : axial cells"},
        {"eccentric_hyper_shell",
         "inner centre : outer centre : inner radius : outer radius : cells"},
        {"enclosed_hyper_cube", "left : right : thickness : colorize"},
        {"general_cell", "vertices separated by ';' : colorize"},
        {"half_hyper_ball", "centre : radius"},
        {"half_hyper_shell",
         "centre : inner radius : outer radius : cells : colorize"},
        {"hyper_L", "left : right : colorize"},
        {"hyper_ball", "centre : radius : spherical inside"},
        {"hyper_ball_balanced", "centre : radius"},
        {"hyper_cross", "sizes of the arms : colorize"},
        {"hyper_cube", "left : right : colorize"},
        {"hyper_cube_slit", "left : right : colorize"},
        {"hyper_cube_with_cylindrical_hole",
         "inner radius : outer radius : length : repetitions : colorize"},
        {"hyper_rectangle", "corner : opposite corner : colorize"},
        {"hyper_shell",
         "centre : inner radius : outer radius : cells : colorize"},
        {"hyper_sphere", "centre : radius (a surface)"},
        {"moebius", "cells : quarter turns : radius of the ring : of the band"},
        {"pipe_junction", "openings : bifurcation : aspect ratio"},
        {"plate_with_a_hole",
         "inner radius : outer radius : pad below : above : left : right : "
         "centre : manifold id : inner manifold id : length : slices : "
         "colorize"},
        {"quarter_hyper_ball", "centre : radius"},
        {"quarter_hyper_shell",
         "centre : inner radius : outer radius : cells : colorize"},
        {"simplex", "vertices separated by ';'"},
        {"subdivided_cylinder", "cells along x : radius : half length"},
        {"subdivided_hyper_cube",
         "cells a direction : left : right : colorize"},
        {"subdivided_hyper_rectangle",
         "cells in x, y, ... : corner : opposite corner : colorize"},
        {"torus",
         "radius of the ring : of the tube : cells around : angle in rad"},
        {"truncated_cone", "radius at the left : at the right : half length"}};
      return arguments;
    }



    std::string text_of(const std::exception &error)
    {
      if (const auto *ours = dynamic_cast<const ExceptionBase *>(&error))
        {
          std::ostringstream text;
          ours->print_info(text);
          return Words::trim(text.str());
        }
      return error.what();
    }



    /** deal.II reads a negative number of cells as a huge one. */
    void check_cell_numbers(const ParameterFile  &file,
                            const MeshParameters &parameters,
                            const unsigned int    dim)
    {
      const std::string several = "subdivided_hyper_";
      if (parameters.generator.rfind(several, 0) != 0)
        return;
      const auto numbers =
        Words::split(Words::split(parameters.arguments, ':').front(), ',');
      double n_cells = 1;
      for (unsigned int d = 0; d < std::max<std::size_t>(dim, numbers.size());
           ++d)
        {
          // the cube has one number for all directions
          const auto &text =
            numbers[std::min<std::size_t>(d, numbers.size() - 1)];
          const double n = std::atof(text.c_str());
          n_cells *= n;
          if (n < 1)
            throw file.error(parameters.section + "/Arguments",
                             "'" + parameters.arguments +
                               "' has a number of cells below 1",
                             "Give numbers of cells of at least 1.");
        }
      std::ostringstream text;
      text << std::setprecision(2) << n_cells << " cells";
      if (n_cells > most_cells())
        throw file.error(parameters.section + "/Arguments",
                         "'" + parameters.arguments + "' makes " + text.str() +
                           ", more than this machine can hold",
                         "Give smaller numbers of cells.");
    }



    template <int dim, int spacedim>
    void call_generator(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh)
    {
      check_cell_numbers(file, parameters, dim);

      // Most generators end with a flag to number the sides of the boundary,
      // which everybody wants and nobody should have to write.
      std::string reason;
      for (const std::string flag : {"", " : true"})
        try
          {
            GridGenerator::generate_from_name_and_arguments(
              mesh, parameters.generator, parameters.arguments + flag);
            return;
          }
        catch (const std::exception &error)
          {
            reason = reason.empty() ? text_of(error) : reason;
            mesh.clear();
          }

      const std::string where = dim < spacedim ? "surfaces in " : "";
      const std::string space = where + std::to_string(spacedim) + "D";
      if (reason.find("not implemented") != std::string::npos)
        throw file.error(parameters.section + "/Generator",
                         "'" + parameters.generator + "' makes no meshes of " +
                           (where.empty() ? "cells in " : "") + space,
                         "Choose another generator, or give a mesh file.");
      const auto meaning = generator_arguments().find(parameters.generator);
      throw file.error(
        parameters.section + "/Arguments",
        "'" + parameters.arguments + "' does not suit the generator '" +
          parameters.generator + "' in " + space,
        "It takes " +
          (meaning == generator_arguments().end() ? reason : meaning->second) +
          ", coordinates of a point separated by ','.");
    }



    template <int dim, int spacedim>
    void read_mesh_file(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh)
    {
      const std::string entry = parameters.section + "/File";
      const std::string name  = file.absolute(entry);
      std::ifstream     stream(name);
      const std::string ending =
        name.substr(std::min(name.rfind('.'), name.size()));
      try
        {
          GridIn<dim, spacedim> reader;
          reader.attach_triangulation(mesh);
          if (ending == ".msh")
            reader.read_msh(stream);
          else if (ending == ".vtk")
            reader.read_vtk(stream);
          else
            reader.read_ucd(stream);
        }
      catch (const std::exception &error)
        {
          throw file.error(entry,
                           "the mesh file '" + name +
                             "' cannot be used: " + text_of(error),
                           "Give a mesh of " + std::to_string(dim) +
                             "D cells in one of the formats .msh (Gmsh, "
                             "version 2 or 4), .vtk or .inp (UCD).");
        }
    }
  } // namespace



  std::vector<std::string> generator_names()
  {
    std::vector<std::string> names;
    for (const auto &generator : generator_arguments())
      names.push_back(generator.first);
    return names;
  }



  std::vector<std::string> mesh_file_endings()
  {
    return {".msh", ".vtk", ".inp", ".ucd"};
  }



  double most_cells()
  {
    constexpr double bytes_of_a_cell = 200; // of any mesh: at least
    const double     memory =
      double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    return std::min<double>(std::numeric_limits<int>::max(),
                            memory / bytes_of_a_cell);
  }



  template <int dim, int spacedim>
  void generate_or_read(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh)
  {
    if (parameters.file.empty())
      call_generator(file, parameters, mesh);
    else
      read_mesh_file(file, parameters, mesh);

    if constexpr (dim == spacedim)
      for (const auto &cell : mesh.active_cell_iterators())
        if (!(cell->measure() > 0))
          throw file.error(parameters.section +
                             (parameters.file.empty() ? "/Arguments" : "/File"),
                           "the mesh has a cell of size " +
                             Words::exact(cell->measure()),
                           "Give lengths above 0 and corners in order.");
  }

#define IMPOINT_INSTANTIATE(dim, spacedim)               \
  template void generate_or_read(const ParameterFile &,  \
                                 const MeshParameters &, \
                                 Triangulation<dim, spacedim> &);

  IMPOINT_INSTANTIATE(2, 2)
  IMPOINT_INSTANTIATE(3, 3)
  IMPOINT_INSTANTIATE(1, 2)
  IMPOINT_INSTANTIATE(2, 3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
