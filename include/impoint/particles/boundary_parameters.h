#ifndef impoint_particles_boundary_parameters_h
#define impoint_particles_boundary_parameters_h

#include <impoint/base/exceptions.h>
#include <impoint/grid/mesh.h>

#include <string>

namespace Impoint
{
  /** How particles are put on a segment: see the entry. */
  enum class BoundaryRule
  {
    equal,
    gauss,
    cut
  };

  /** A nonconforming boundary: its shape and its particles. Or the sides of the
   * grid with an id, if it is conforming: a traction has particles on them. */
  struct BoundaryParameters
  {
    void declare(ParameterFile &file, const std::string &name);

    /** Throws InputError for entries that clash in @p dim dimensions. */
    void check(const ParameterFile &file, const unsigned int dim) const;

    /** Fills in what entries leave to the @p degree of the basis. */
    void complete(const unsigned int degree);

    std::string name;    // "clamp"
    std::string section; // "Boundaries/clamp"

    bool         conforming  = false;
    unsigned int boundary_id = 0; // conforming

    // shape of a nonconforming one: corners, or a surface mesh
    std::string    polyline;
    MeshParameters mesh;                      // section ".../Mesh"
    double         segment_length        = 0; // 0: as given
    unsigned int   particles_per_segment = 0;
    BoundaryRule   rule                  = BoundaryRule::equal;
    bool           flip_normal           = false;

    /** The grid has no sides with the id. */
    InputError no_such_side(const ParameterFile &file) const;

  private:
    void check_conforming(const ParameterFile &file) const;
    void check_shape(const ParameterFile &file, const unsigned int dim) const;
  };
} // namespace Impoint

#endif
