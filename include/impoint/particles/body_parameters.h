#ifndef impoint_particles_body_parameters_h
#define impoint_particles_body_parameters_h

#include <impoint/grid/mesh.h>

#include <string>

namespace Impoint
{
  class EntryHandler;

  /**
   * A body: its shape, how points fill it, its density and initial state.
   *
   * The entries "Initial velocity" [m/s], "Body force" (per mass, [m/s2]) and
   * "Initial stress" ([Pa], Voigt order of base/voigt.h, then zz in 2D if
   * given) are declared here and read by Expression from the section; empty
   * means zero.
   */
  struct BodyParameters
  {
    void declare(ParameterFile &file, const std::string &name);

    /** Throws InputError for entries that clash in @p dim dimensions. */
    void check(const ParameterFile &file, const unsigned int dim) const;

    /** Fills in what entries leave to the @p degree of the basis. */
    void complete(const unsigned int degree);

    std::string name;    // "beam"
    std::string section; // "Bodies/beam"

    MeshParameters mesh; // the body's shape, section "Bodies/beam/Mesh"

    bool         clipped = false; // points, else of the body's mesh
    unsigned int rule    = 0;     // a direction: Gauss points, or sub-cells
    unsigned int points_per_simplex = 0;     // 0: dim + 1
    bool         gauss_pieces       = false; // clipped; else centroids
    std::string  outline; // clipped: 2D polygon "x y; ..."; empty: the mesh

    std::string signed_distance; // clipped: expression; empty: another shape

    double density   = 0; // [kg/m3]
    double thickness = 1; // 2D [m]

    bool force_at_start = false; // x, y(, z) of the body force; else now

  private:
    void declare_shape(EntryHandler &prm);
    void check_signed_distance(const ParameterFile &file) const;
    void declare_state(EntryHandler &prm);
    void check_outline(const ParameterFile &file, const unsigned int dim) const;
    void check_points(const ParameterFile &file, const unsigned int dim) const;
  };
} // namespace Impoint

#endif
