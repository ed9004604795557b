#include <impoint/base/parameter_file.h>
#include <impoint/particles/boundary_parameters.h>
#include <impoint/particles/outline.h>
#include <impoint/particles/simplex_rules.h>

namespace Impoint
{
  void BoundaryParameters::declare(ParameterFile     &file,
                                   const std::string &boundary)
  {
    name    = boundary;
    section = "Boundaries/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Boundaries");
    prm.enter_subsection(name);
    prm.add_choice("Kind",
                   conforming,
                   "'nonconforming': particles on a shape that runs anywhere "
                   "through the grid; 'conforming': sides of the grid.",
                   {{"nonconforming", false}, {"conforming", true}});
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
    prm.add_choice("Rule",
                   rule,
                   "'equal': in the middle of n equal parts; 'gauss': at "
                   "Gauss points; 'cut': cut at the faces of the grid's "
                   "cells, then Gauss points on each piece.",
                   {{"equal", BoundaryRule::equal},
                    {"gauss", BoundaryRule::gauss},
                    {"cut", BoundaryRule::cut}});
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
        rule == BoundaryRule::cut || conforming ? degree + 1 : 2;
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
    if (conforming)
      return check_conforming(file);
    if (file.is_set(section + "/Boundary id"))
      throw file.error(section + "/Boundary id",
                       "nonconforming boundaries have no id",
                       "Set 'Kind = conforming', or take the entry away.");
    check_shape(file, dim);
    const unsigned int most = max_simplex_order(2);
    if (dim == 3 && rule != BoundaryRule::equal && particles_per_segment > most)
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
    if (!polyline.empty() && mesh.is_given())
      throw file.error(section + "/Polyline",
                       "both corners and a mesh are given",
                       "Take one of them away.");
    if (!polyline.empty())
      {
        if (dim == 2)
          parse_corners<2>(file, section + "/Polyline", polyline, 2);
        else
          parse_corners<3>(file, section + "/Polyline", polyline, 3);
        return;
      }
    if (!mesh.is_given())
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
