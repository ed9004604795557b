#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/body_parameters.h>
#include <impoint/particles/outline.h>
#include <impoint/particles/simplex_rules.h>

#include <algorithm>
#include <limits>

namespace Impoint
{
  namespace
  {
    bool has_mesh(const MeshParameters &mesh)
    {
      return !mesh.generator.empty() || !mesh.file.empty();
    }



    void check_corners(const ParameterFile &file,
                       const std::string   &path,
                       const std::string   &text,
                       const unsigned int   dim,
                       const unsigned int   at_least)
    {
      if (dim == 2)
        parse_corners<2>(file, path, text, at_least);
      else
        parse_corners<3>(file, path, text, at_least);
    }
  } // namespace



  void BodyParameters::declare(ParameterFile &file, const std::string &body)
  {
    name    = body;
    section = "Bodies/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Bodies");
    prm.enter_subsection(name);
    prm.add_parameter(
      "Points",
      points,
      "'body mesh': at the Gauss points of the cells of the "
      "body's mesh; 'clipped': of the parts of the grid's cells "
      "that lie in the body.",
      Patterns::Selection("body mesh|clipped"));
    prm.add_parameter(
      "Points per direction",
      rule,
      "Body mesh: Gauss points in a quadrilateral or hexahedron. "
      "Clipped: sub-cells of a grid cell that are clipped, or "
      "Gauss points if 'Piece = gauss'. 0: clipped, one more than the degree "
      "of the basis; body mesh, 2.",
      Patterns::Integer(0, 100));
    prm.add_parameter("Points per simplex",
                      points_per_simplex,
                      "Body mesh: points in a triangle (" +
                        simplex_rule_sizes_text(2) + ") or a tetrahedron (" +
                        simplex_rule_sizes_text(3) +
                        "); 0: as many as it has corners.",
                      Patterns::Integer(0, 81));
    prm.add_parameter(
      "Piece",
      piece,
      "Clipped: 'centroid': a point for each clipped sub-cell; "
      "'gauss': a Gauss rule for each clipped cell. With n points "
      "a direction it is exact to degree 2 n - 1, and for "
      "products of polynomials of degree n - 1 in each "
      "coordinate: a basis of degree p wants n = p + 1.",
      Patterns::Selection("centroid|gauss"));
    declare_shape(prm);
    prm.add_parameter("Density",
                      density,
                      "Mass per volume [kg/m3]; must be set.",
                      Patterns::Double(0));
    prm.add_parameter("Thickness",
                      thickness,
                      "2D: across the plane [m].",
                      Patterns::Double(std::numeric_limits<double>::min()));
    declare_state(prm);
    prm.leave_subsection();
    prm.leave_subsection();
    mesh.declare(file, section + "/Mesh", "", "");
  }



  /** How the body begins, and its load. */
  void BodyParameters::declare_state(EntryHandler &prm)
  {
    prm.declare_entry("Initial velocity",
                      "",
                      Patterns::Anything(),
                      "Expressions of x, y(, z), components separated by ';' "
                      "[m/s]; empty: none.");
    prm.declare_entry("Initial acceleration",
                      "",
                      Patterns::Anything(),
                      "Expressions of x, y(, z), components separated by ';' "
                      "[m/s2], for 'Initial acceleration = expression' in "
                      "section 'Time'; empty: none.");
    prm.declare_entry("Body force",
                      "",
                      Patterns::Anything(),
                      "Force per mass, such as gravity: expressions of x, "
                      "y(, z), t, components separated by ';' [m/s2]; empty: "
                      "none.");
    prm.add_parameter("Body force place",
                      force_place,
                      "What x, y(, z) of the body force are of a point: where "
                      "it is at the start of the step, or where it was at the "
                      "start of the run.",
                      Patterns::Selection("now|start"));
    prm.declare_entry(
      "Initial stress",
      "",
      Patterns::Anything(),
      "Expressions of x, y(, z), tension positive: in 2D xx; yy; xy or xx; yy; "
      "xy; zz (zz is 0 if left out), in 3D xx; yy; zz; xy; xz; yz [Pa]; empty: "
      "none. Plastic models begin with its elastic strain.");
  }



  void BodyParameters::declare_shape(EntryHandler &prm)
  {
    prm.add_parameter("Outline",
                      outline,
                      "Clipped, 2D: corners 'x y; x y; ...' [m] instead of a "
                      "mesh; more rings, such as holes, after '|'.");
    prm.add_parameter(
      "Signed distance",
      signed_distance,
      "Clipped, with 'Piece = gauss': expression of x, y(, z) instead of a "
      "mesh, below 0 in the body, above 0 outside, such as the distance from "
      "its surface [m]; smooth where it is 0.");
  }



  void BodyParameters::check_signed_distance(const ParameterFile &file) const
  {
    const std::string path = section + "/Signed distance";
    if (points != "clipped" || piece != "gauss")
      throw file.error(path,
                       "a signed distance without Gauss rules in clipped cells",
                       "Set 'Points = clipped' and 'Piece = gauss'.");
    if (!outline.empty() || has_mesh(mesh))
      throw file.error(path,
                       "the body '" + name + "' has a signed distance and " +
                         (outline.empty() ? "a mesh" : "an outline"),
                       "Take one of them away.");
  }



  void BodyParameters::complete(const unsigned int degree)
  {
    if (rule == 0)
      rule = points == "clipped" ? degree + 1 : 2;
  }



  void BodyParameters::check(const ParameterFile &file,
                             const unsigned int   dim) const
  {
    if (dim == 3 && file.is_set(section + "/Thickness"))
      throw file.error(section + "/Thickness",
                       "a thickness in 3D",
                       "Take the entry away.");
    if (!signed_distance.empty())
      check_signed_distance(file);
    else if (!outline.empty())
      check_outline(file, dim);
    else if (has_mesh(mesh))
      mesh.check(file, dim);
    else
      throw file.error(section + "/Mesh/Generator",
                       "the body '" + name + "' has no shape",
                       "Set 'Generator' or 'File' in section '" + section +
                         "/Mesh'" + (dim == 2 ? ", or 'Outline'." : "."));
    check_points(file, dim);
  }



  void BodyParameters::check_outline(const ParameterFile &file,
                                     const unsigned int   dim) const
  {
    const std::string path = section + "/Outline";
    if (dim == 3)
      throw file.error(path,
                       "an outline in 3D",
                       "Give the shape in section '" + section + "/Mesh'.");
    if (points == "body mesh")
      throw file.error(
        path,
        "an outline has no mesh to put points into",
        "Set 'Points = clipped', or give the shape in section '" + section +
          "/Mesh'.");
    if (has_mesh(mesh))
      throw file.error(path,
                       "both an outline and a mesh are given",
                       "Take one of them away.");
    convex_parts(file, path, parse_corners<2>(file, path, outline, 3));
  }



  void BodyParameters::check_points(const ParameterFile &file,
                                    const unsigned int   dim) const
  {
    const bool clipped = points == "clipped";
    if (!clipped && file.is_set(section + "/Piece"))
      throw file.error(section + "/Piece",
                       "the points of a body mesh have no pieces",
                       "Set 'Points = clipped', or take the entry away.");
    if (clipped && file.is_set(section + "/Points per simplex"))
      throw file.error(section + "/Points per simplex",
                       "clipped cells don't use this number",
                       "Set 'Points per direction' instead.");
    if (points_per_simplex > 0 && !has_simplex_rule(dim, points_per_simplex))
      throw file.error(section + "/Points per simplex",
                       "no rule has " + std::to_string(points_per_simplex) +
                         " points",
                       "Set one of " + simplex_rule_sizes_text(dim) + ".");
    if (clipped && piece == "gauss" && rule > max_simplex_order(dim))
      throw file.error(section + "/Points per direction",
                       "Gauss rules on clipped cells are known up to " +
                         std::to_string(max_simplex_order(dim)) +
                         " points a direction, not " + std::to_string(rule),
                       "Set a smaller number, or 'Piece = centroid'.");
  }



  void BoundaryParameters::declare(ParameterFile     &file,
                                   const std::string &boundary)
  {
    name    = boundary;
    section = "Boundaries/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Boundaries");
    prm.enter_subsection(name);
    prm.add_parameter(
      "Kind",
      kind,
      "'nonconforming': particles on a shape that runs anywhere "
      "through the grid; 'conforming': sides of the grid.",
      Patterns::Selection("nonconforming|conforming"));
    prm.add_parameter(
      "Boundary id",
      boundary_id,
      "Conforming: which sides, by the id that the generator or "
      "the mesh file of the grid gives them.",
      Patterns::Integer(0));
    prm.add_parameter("Polyline",
                      polyline,
                      "2D: corners 'x y; x y; ...' of a line; the normal is on "
                      "its right, so out of a body walked round "
                      "counter-clockwise. 3D: corners 'x y z; ...' of a planar "
                      "polygon; the normal points to whom it is "
                      "counter-clockwise. More after '|' [m].");
    prm.add_parameter(
      "Segment length",
      segment_length,
      "A polyline (3D: polygon) is divided evenly into segments "
      "no longer than this [m]; 0: the given sides.",
      Patterns::Double(0));
    prm.add_parameter("Particles per segment",
                      particles_per_segment,
                      "Number n of particles on a segment (3D: n by n on a "
                      "quadrilateral); with 'Rule = cut' on each piece: a "
                      "basis of degree p wants n = p + 1. 0: with 'Rule = cut' "
                      "this, else 2.",
                      Patterns::Integer(0, 1000));
    prm.add_parameter("Rule",
                      rule,
                      "'equal': in the middle of n equal parts; 'gauss': at "
                      "Gauss points; 'cut': cut at the faces of the grid's "
                      "cells, then Gauss points on each piece.",
                      Patterns::Selection("equal|gauss|cut"));
    prm.add_parameter(
      "Flip normal",
      flip_normal,
      "The normal must point out of the material. That of a "
      "closed surface mesh points outward; 'true' turns it round.");
    prm.leave_subsection();
    prm.leave_subsection();
    mesh.declare(file, section + "/Mesh", "", "");
  }



  void BoundaryParameters::complete(const unsigned int degree)
  {
    if (particles_per_segment == 0)
      particles_per_segment =
        rule == "cut" || kind == "conforming" ? degree + 1 : 2;
  }



  InputError BoundaryParameters::no_such_side(const ParameterFile &file) const
  {
    return file.error(section + "/Boundary id",
                      "the grid's boundary has no part with id " +
                        std::to_string(boundary_id),
                      "Use an id that the grid's generator or file gives; "
                      "rectangles and boxes have 0 to 2 dim - 1 (left, right, "
                      "bottom, top, back, front).");
  }



  void BoundaryParameters::check(const ParameterFile &file,
                                 const unsigned int   dim) const
  {
    if (kind == "conforming")
      return check_conforming(file);
    if (file.is_set(section + "/Boundary id"))
      throw file.error(section + "/Boundary id",
                       "nonconforming boundaries have no id",
                       "Set 'Kind = conforming', or take the entry away.");
    check_shape(file, dim);
    const unsigned int most = max_simplex_order(2);
    if (dim == 3 && rule != "equal" && particles_per_segment > most)
      throw file.error(section + "/Particles per segment",
                       "Gauss rules on surfaces are known up to " +
                         std::to_string(most) + ", not " +
                         std::to_string(particles_per_segment),
                       "Set a smaller number and 'Segment length' or the "
                       "mesh's 'Refinements'.");
  }



  void BoundaryParameters::check_conforming(const ParameterFile &file) const
  {
    for (const std::string entry : {"Polyline",
                                    "Segment length",
                                    "Particles per segment",
                                    "Rule",
                                    "Flip normal",
                                    "Mesh/Generator",
                                    "Mesh/File"})
      if (file.is_set(section + "/" + entry))
        throw file.error(
          section + "/" + entry,
          "conforming boundaries have neither shape nor particles",
          "Take the entry away, or set 'Kind = nonconforming'.");
  }



  void BoundaryParameters::check_shape(const ParameterFile &file,
                                       const unsigned int   dim) const
  {
    if (!polyline.empty() && has_mesh(mesh))
      throw file.error(section + "/Polyline",
                       "both corners and a mesh are given",
                       "Take one of them away.");
    if (!polyline.empty())
      return check_corners(file, section + "/Polyline", polyline, dim, dim);
    if (!has_mesh(mesh))
      throw file.error(section + "/Polyline",
                       "the boundary '" + name + "' has no shape",
                       "Set 'Polyline', or 'Generator' or 'File' in section '" +
                         section + "/Mesh'.");
    if (segment_length > 0)
      throw file.error(section + "/Segment length",
                       "the cells of a surface mesh are its segments",
                       "Set the mesh's 'Refinements' instead.");
    mesh.check(file, dim);
  }
} // namespace Impoint
