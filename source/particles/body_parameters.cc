#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/body_parameters.h>
#include <impoint/particles/outline.h>
#include <impoint/particles/simplex_rules.h>

#include <algorithm>
#include <limits>

namespace Impoint
{
  void BodyParameters::declare(ParameterFile &file, const std::string &body)
  {
    name    = body;
    section = "Bodies/" + name;

    auto &prm = file.handler();
    prm.enter_subsection("Bodies");
    prm.enter_subsection(name);
    prm.add_choice("Points",
                   clipped,
                   "'body mesh': at the Gauss points of the cells of the "
                   "body's mesh; 'clipped': of the parts of the grid's cells "
                   "that lie in the body.",
                   {{"body mesh", false}, {"clipped", true}});
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
    prm.add_choice("Piece",
                   gauss_pieces,
                   "Clipped: 'centroid': a point for each clipped sub-cell; "
                   "'gauss': a Gauss rule for each clipped cell. With n points "
                   "a direction it is exact to degree 2 n - 1, and for "
                   "products of polynomials of degree n - 1 in each "
                   "coordinate: a basis of degree p wants n = p + 1.",
                   {{"centroid", false}, {"gauss", true}});
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
    prm.add_choice("Body force place",
                   force_at_start,
                   "What x, y(, z) of the body force are of a point: where "
                   "it is at the start of the step, or where it was at the "
                   "start of the run.",
                   {{"now", false}, {"start", true}});
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
    if (!clipped || !gauss_pieces)
      throw file.error(path,
                       "a signed distance without Gauss rules in clipped cells",
                       "Set 'Points = clipped' and 'Piece = gauss'.");
    if (!outline.empty() || mesh.is_given())
      throw file.error(path,
                       "the body '" + name + "' has a signed distance and " +
                         (outline.empty() ? "a mesh" : "an outline"),
                       "Take one of them away.");
  }



  void BodyParameters::complete(const unsigned int degree)
  {
    if (rule == 0)
      rule = clipped ? degree + 1 : 2;
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
    else if (mesh.is_given())
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
    if (!clipped)
      throw file.error(
        path,
        "an outline has no mesh to put points into",
        "Set 'Points = clipped', or give the shape in section '" + section +
          "/Mesh'.");
    if (mesh.is_given())
      throw file.error(path,
                       "both an outline and a mesh are given",
                       "Take one of them away.");
    convex_parts(file, path, parse_corners<2>(file, path, outline, 3));
  }



  void BodyParameters::check_points(const ParameterFile &file,
                                    const unsigned int   dim) const
  {
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
    if (clipped && gauss_pieces && rule > max_simplex_order(dim))
      throw file.error(section + "/Points per direction",
                       "Gauss rules on clipped cells are known up to " +
                         std::to_string(max_simplex_order(dim)) +
                         " points a direction, not " + std::to_string(rule),
                       "Set a smaller number, or 'Piece = centroid'.");
  }
} // namespace Impoint
