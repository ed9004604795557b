#ifndef impoint_grid_mesh_h
#define impoint_grid_mesh_h

#include <deal.II/grid/tria.h>

#include <string>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  class ParameterFile;

  /** A mesh, of the background grid or of a body or surface. */
  struct MeshParameters
  {
    /** Declares the entries in @p section of @p file. */
    void declare(ParameterFile     &file,
                 const std::string &section,
                 const std::string &default_generator,
                 const std::string &default_arguments);

    /** Throws InputError for what cannot be in @p dim space dimensions. */
    void check(const ParameterFile &file, const unsigned int dim) const;

    std::string generator; // of dealii::GridGenerator
    std::string arguments; // separated by ':'
    std::string file;      // a mesh file instead of a generator
    // as made|triangles|8 triangles|tetrahedra|24 tetrahedra
    std::string         cells      = "as made";
    double              distortion = 0; // of interior vertices, in edge lengths
    unsigned int        refinements = 0;
    double              scale       = 1;
    std::vector<double> shift;
    double              rotation = 0; // degrees
    std::vector<double> axis;         // 3D: of the rotation
    std::string         section;      // where the entries stand

    bool is_given() const
    {
      return !generator.empty() || !file.empty();
    }

    /** Path of the entry that gives the mesh. */
    std::string source_entry() const
    {
      return section + (file.empty() ? "/Generator" : "/File");
    }

    /** Whether the cells are split into triangles or tetrahedra. */
    bool split() const
    {
      return cells != "as made";
    }

  private:
    void check_source(const ParameterFile &file) const;
  };

  struct GridParameters : public MeshParameters
  {
    void declare(ParameterFile &file);
    void check(const ParameterFile &file, const unsigned int dim) const;

    // linear|quadratic|quadratic spline|cubic spline
    std::string basis = "linear";

    /** Highest power of one coordinate in the basis. */
    unsigned int degree() const
    {
      return basis == "linear" ? 1 : (basis == "cubic spline" ? 3 : 2);
    }

    /** Whether no function is negative anywhere. */
    bool is_positive() const
    {
      return basis != "quadratic";
    }

    double ghost_penalty = -1; // entry; below 0: automatic

    /** Factor of Young's modulus; 0: no ghost penalty. @p cuts_matter: even to
     * linear functions. */
    double ghost_factor(const bool cuts_matter) const
    {
      constexpr double smallest_that_serves = 1e-3;
      if (ghost_penalty >= 0)
        return ghost_penalty;
      return degree() > 1 || cuts_matter ? smallest_that_serves : 0.;
    }

    std::string reset = "every step"; // every step|never
    bool        is_kept() const
    {
      return reset == "never";
    }

    // expression of x: cells whose centre has a value > 0 are refined further
    std::string  refine_where;
    unsigned int refine_times = 1;
  };

  /**
   * Makes the mesh that @p parameters describe but for the refinements:
   * generated or read, scaled, rotated, shifted. @p mesh may be a
   * parallel::distributed::Triangulation if the cells are not split.
   * Simplices come out refined and distorted: nothing is left for
   * refine_mesh(). Throws InputError. @p spacedim > dim makes a surface.
   */
  template <int dim, int spacedim>
  void make_coarse_mesh(const ParameterFile          &file,
                        const MeshParameters         &parameters,
                        Triangulation<dim, spacedim> &mesh);

  /** Refines what make_coarse_mesh() made as often as asked for. */
  template <int dim, int spacedim>
  void refine_mesh(const MeshParameters         &parameters,
                   Triangulation<dim, spacedim> &mesh);

  /** Both steps: the mesh that @p parameters describe. */
  template <int dim, int spacedim>
  void make_mesh(const ParameterFile          &file,
                 const MeshParameters         &parameters,
                 Triangulation<dim, spacedim> &mesh);
} // namespace Impoint

#endif
