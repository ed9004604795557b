#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/grid/mesh.h>
#include <impoint/grid/mesh_source.h>
#include <impoint/grid/mesh_tools.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>

namespace Impoint
{
  void MeshParameters::declare(ParameterFile     &scene,
                               const std::string &section_path,
                               const std::string &default_generator,
                               const std::string &default_arguments)
  {
    section   = section_path;
    generator = default_generator;
    arguments = default_arguments;

    auto      &prm   = scene.handler();
    const auto parts = Words::split(section, '/');
    for (const auto &part : parts)
      prm.enter_subsection(part);

    prm.add_parameter("Generator",
                      generator,
                      "Name of a function of deal.II's GridGenerator.");
    prm.add_parameter("Arguments",
                      arguments,
                      "Its arguments, separated by ':'. A last 'true', which "
                      "gives the sides of the boundary different ids, may be "
                      "left out.");
    prm.add_parameter("File",
                      this->file,
                      "A mesh file instead of a generator: .msh (Gmsh), .vtk "
                      "or .inp/.ucd.");
    prm.add_parameter("Cells",
                      cells,
                      "'as made'; 'triangles': two a quadrilateral; "
                      "'tetrahedra': six a hexahedron; '8 triangles', '24 "
                      "tetrahedra': finer, without a preferred diagonal.",
                      Patterns::Selection("as made|triangles|8 triangles|"
                                          "tetrahedra|24 tetrahedra"));
    prm.add_parameter("Refinements",
                      refinements,
                      "How often all cells are halved; before they are split "
                      "into triangles or tetrahedra.",
                      Patterns::Integer(0, 20));
    prm.add_parameter("Distortion",
                      distortion,
                      "Inner vertices are moved in random directions (the same "
                      "ones in every run) by this part of their shortest edge. "
                      "Cells that are not split are refined afterwards.",
                      Patterns::Double(0, 0.3));
    prm.add_parameter("Scale",
                      scale,
                      "Factor to multiply the coordinates with.",
                      Patterns::Double(std::numeric_limits<double>::min()));
    prm.add_parameter("Rotation",
                      rotation,
                      "Angle of a rotation about the origin [degrees], after "
                      "the scaling.");
    prm.add_parameter("Axis", axis, "3D: axis of the rotation; empty: z.");
    prm.add_parameter("Shift",
                      shift,
                      "Vector to add to the coordinates [m], after the "
                      "rotation; empty: none.");

    for (unsigned int i = 0; i < parts.size(); ++i)
      prm.leave_subsection();
    scene.declare_as_path(section + "/File");
  }



  void MeshParameters::check(const ParameterFile &scene,
                             const unsigned int   dim) const
  {
    check_source(scene);
    const auto size = std::to_string(dim);
    if (!shift.empty() && shift.size() != dim)
      throw scene.error(section + "/Shift",
                        "a vector of " + std::to_string(shift.size()) +
                          " components in " + size + "D",
                        "Give " + size + " numbers separated by ','.");
    if (!axis.empty() && dim == 2)
      throw scene.error(
        section + "/Axis",
        "an axis of rotation in 2D",
        "Take the entry away: rotations in the plane have none.");
    if (!axis.empty() && (axis.size() != 3 ||
                          std::all_of(axis.begin(), axis.end(), [](double a) {
                            return a == 0;
                          })))
      throw scene.error(section + "/Axis",
                        "the axis is no direction in space",
                        "Give 3 numbers separated by ',', not all of them 0.");
    if (dim == 2 && cells.find("tetrahedra") != std::string::npos)
      throw scene.error(section + "/Cells",
                        "tetrahedra in 2D",
                        "Set 'as made' or 'triangles'.");
  }



  void MeshParameters::check_source(const ParameterFile &scene) const
  {
    if (file.empty())
      {
        const auto names = generator_names();
        if (std::find(names.begin(), names.end(), generator) == names.end())
          throw scene.error(section + "/Generator",
                            "there is no generator '" + generator + "'",
                            Words::suggestion(generator, names, "There are"));
        return;
      }
    // A scene that includes another one empties the entries of that one.
    for (const auto &[entry, value] :
         {std::pair("Generator", generator), std::pair("Arguments", arguments)})
      if (scene.is_set(section + "/" + entry) && !value.empty())
        throw scene.error(section + "/" + entry,
                          "both a mesh file and the entry '" +
                            std::string(entry) + "' are given",
                          "Take one of them away, or set it to nothing where "
                          "an included scene gives it.");
    const std::string name    = scene.absolute(section + "/File");
    const auto        endings = mesh_file_endings();
    const std::string ending =
      name.substr(std::min(name.rfind('.'), name.size()));
    if (std::find(endings.begin(), endings.end(), ending) == endings.end())
      throw scene.error(section + "/File",
                        "'" + name + "' does not end like a mesh file",
                        "Known endings are " + Words::join(endings, ", ") +
                          ".");
    if (!std::ifstream(name))
      throw scene.error(section + "/File",
                        "the mesh file '" + name + "' cannot be read",
                        "Give the name of a file that exists, relative to the "
                        "folder of this scene file.");
  }



  void GridParameters::declare(ParameterFile &scene)
  {
    MeshParameters::declare(scene, "Grid", "hyper_cube", "0 : 1");
    auto &prm = scene.handler();
    prm.enter_subsection("Grid");
    prm.add_parameter("Basis",
                      basis,
                      "Functions that carry the displacement. linear and "
                      "quadratic: on the cells, whatever they are; splines: "
                      "continuous gradients, on Cartesian grids (rotated and "
                      "shifted as you like).",
                      Patterns::Selection("linear|quadratic|quadratic spline|"
                                          "cubic spline"));
    prm.add_parameter(
      "Ghost penalty",
      ghost_penalty,
      "Part of Young's modulus with which neighbours hold the functions of "
      "cells filled by less than 0.3, so that the error does not depend on how "
      "little that is: 1e-3 serves all bases, more adds to the error; 0: none; "
      "-1: 1e-3, for 'linear', which a cut costs next to nothing, only in "
      "statics where 'nitsche' holds a boundary; errors of the others grow up "
      "to 3000 times without.",
      Patterns::Double(-1));
    prm.add_parameter(
      "Reset",
      reset,
      "every step: points lend their state to the grid as it was, wherever "
      "they have moved to (updated Lagrangian). never: the grid deforms with "
      "the body and keeps what it knows (total Lagrangian): steps cost less "
      "and nothing crosses a cell, but cells must not be distorted much, "
      "and there is no contact.",
      Patterns::Selection("every step|never"));
    prm.add_parameter("Refine where",
                      refine_where,
                      "Expression of x, y(, z): cells at whose centre it is "
                      "above 0 are refined further; empty: none.");
    prm.add_parameter("Refine times",
                      refine_times,
                      "How often they are.",
                      Patterns::Integer(1, 10));
    prm.leave_subsection();
  }



  void GridParameters::check(const ParameterFile &scene,
                             const unsigned int   dim) const
  {
    MeshParameters::check(scene, dim);
    if (!refine_where.empty() && split())
      throw scene.error(section + "/Refine where",
                        "triangles and tetrahedra cannot be refined locally",
                        "Set 'Cells = as made', or give a mesh file that is "
                        "finer where needed.");
    if (refine_where.empty() && scene.is_set(section + "/Refine times"))
      throw scene.error(section + "/Refine times",
                        "a number of refinements, but not where to refine",
                        "Set 'Refine where', or 'Refinements' for all cells.");
  }



  namespace
  {
    template <int dim, int spacedim>
    bool is_turned_inside_out(const Triangulation<dim, spacedim> &mesh)
    {
      if constexpr (dim == spacedim)
        for (const auto &cell : mesh.active_cell_iterators())
          if (!(cell->measure() > 0))
            return true;
      return false;
    }



    /** Refuses what is too many, before a mesh of that size is tried. */
    template <int dim, int spacedim>
    void check_refinements(const ParameterFile                &file,
                           const MeshParameters               &parameters,
                           const Triangulation<dim, spacedim> &coarse)
    {
      const double       n_coarse = coarse.n_active_cells();
      const unsigned int most =
        std::log2(std::max(1., most_cells() / n_coarse)) / dim;
      if (parameters.refinements <= most)
        return;
      std::ostringstream n_cells;
      n_cells << std::setprecision(2)
              << std::ldexp(n_coarse, dim * parameters.refinements);
      throw file.error(parameters.section + "/Refinements",
                       std::to_string(parameters.refinements) +
                         " refinements make " + n_cells.str() + " cells",
                       "Set at most " + std::to_string(most) + ".");
    }



    template <int dim, int spacedim>
    void make_simplices(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh)
    {
      const std::string wanted = dim == 3 ? "tetrahedra" : "triangles";
      if (dim == 1 || parameters.cells.find(wanted) == std::string::npos)
        throw file.error(parameters.section + "/Cells",
                         "cells of a mesh of dimension " + std::to_string(dim) +
                           " cannot become " + parameters.cells,
                         dim == 1 ? "Set 'as made'." :
                                    "Set 'as made' or '" + wanted + "'.");
      Triangulation<dim, spacedim> source;
      generate_or_read(file, parameters, source);
      if (!source.all_reference_cells_are_hyper_cube())
        throw file.error(parameters.section + "/Cells",
                         "the mesh has triangles or tetrahedra already",
                         "Set 'as made'.");
      check_refinements(file, parameters, source);
      source.refine_global(parameters.refinements);
      if (parameters.cells == wanted)
        split_into_simplices(source, mesh);
      else if constexpr (dim > 1)
        {
          Triangulation<dim, spacedim> flat;
          GridGenerator::flatten_triangulation(source, flat);
          GridGenerator::convert_hypercube_to_simplex_mesh(flat, mesh);
          mesh.reset_all_manifolds();
          mesh.set_all_manifold_ids(numbers::flat_manifold_id);
        }
      if (is_turned_inside_out(mesh))
        throw file.error(parameters.section + "/Cells",
                         "the cells are too warped to be cut along the "
                         "diagonals of their faces",
                         "Set 'as made' or '24 tetrahedra', or give a mesh "
                         "file.");
    }



    template <int dim, int spacedim>
    void distort(const ParameterFile          &file,
                 const MeshParameters         &parameters,
                 Triangulation<dim, spacedim> &mesh)
    {
      const std::string entry = parameters.section + "/Distortion";
      if (dim < spacedim)
        throw file.error(entry, "surfaces are not distorted", "Set 0.");
      if (dim == 3 && !mesh.all_reference_cells_are_simplex())
        throw file.error(entry,
                         "the faces of distorted hexahedra are not planar",
                         "Set 0, or 'Cells = tetrahedra'.");
      GridTools::distort_random(parameters.distortion, mesh);
      if (is_turned_inside_out(mesh))
        throw file.error(entry,
                         "moving vertices by " +
                           Words::exact(parameters.distortion) +
                           " of an edge turns cells inside out",
                         "Set a smaller value.");
    }
  } // namespace



  template <int dim, int spacedim>
  void make_coarse_mesh(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh)
  {
    if (parameters.split())
      make_simplices(file, parameters, mesh);
    else
      {
        generate_or_read(file, parameters, mesh);
        check_refinements(file, parameters, mesh);
      }
    if (parameters.distortion > 0)
      distort(file, parameters, mesh);
    move_mesh(Similarity<spacedim>(parameters), mesh);
  }



  template <int dim, int spacedim>
  void refine_mesh(const MeshParameters         &parameters,
                   Triangulation<dim, spacedim> &mesh)
  {
    renew_transfinite_manifolds(mesh);
    if (!parameters.split())
      mesh.refine_global(parameters.refinements);
  }



  template <int dim, int spacedim>
  void make_mesh(const ParameterFile          &file,
                 const MeshParameters         &parameters,
                 Triangulation<dim, spacedim> &mesh)
  {
    make_coarse_mesh(file, parameters, mesh);
    refine_mesh(parameters, mesh);
  }

#define IMPOINT_INSTANTIATE(dim, spacedim)                        \
  template void make_coarse_mesh(const ParameterFile &,           \
                                 const MeshParameters &,          \
                                 Triangulation<dim, spacedim> &); \
  template void refine_mesh(const MeshParameters &,               \
                            Triangulation<dim, spacedim> &);      \
  template void make_mesh(const ParameterFile &,                  \
                          const MeshParameters &,                 \
                          Triangulation<dim, spacedim> &);

  IMPOINT_INSTANTIATE(2, 2)
  IMPOINT_INSTANTIATE(3, 3)
  IMPOINT_INSTANTIATE(1, 2)
  IMPOINT_INSTANTIATE(2, 3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
