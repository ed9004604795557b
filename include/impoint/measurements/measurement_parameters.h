#ifndef impoint_measurements_measurement_parameters_h
#define impoint_measurements_measurement_parameters_h

#include <limits>
#include <string>
#include <vector>

namespace Impoint
{
  class ParameterFile;

  /** Something that a scene measures: the entries of "Measurements/<name>".
   * The expressions "Reference" and "Exact" are read from the section. */
  struct MeasurementParameters
  {
    void declare(ParameterFile &file, const std::string &name);

    /** Throws InputError for what clashes in @p dim dimensions, and for bodies
     * and boundaries that the scene does not have. */
    void check(const ParameterFile &file, const unsigned int dim) const;

    /** Throws InputError if 'Boundary' is conforming and so has none. */
    void require_boundary_particles(const ParameterFile &file) const;

    std::string name;    // "tip"
    std::string section; // "Measurements/tip"

    std::string quantity = "probe";
    std::string body;     // empty: all
    std::string boundary; // whose reaction, or what points shall not cross

    std::vector<double> point;     // of a probe; about which; origin of a frame
    std::vector<double> direction; // of a path or a run-out, any length
    std::vector<double> axis;      // of a path's angle in 3D

    // errors of fields
    std::string position    = "initial";     // initial|current
    std::string norm        = "volume mean"; // volume mean|L2|maximum
    std::string component   = "norm";        // norm|all|x|y|z|xx|yy|zz|xy|xz|yz
    double      frame_angle = 0;             // degrees
    double      scale       = 0;             // 0: relative to the exact values

    double until = std::numeric_limits<double>::max(); // [s]

  private:
    void declare_object(ParameterFile &file);
    void declare_field(ParameterFile &file);
    void check_unused(const ParameterFile &file) const;
    void check_members(const ParameterFile &file) const;
    void check_places(const ParameterFile &file, const unsigned int dim) const;
  };
} // namespace Impoint

#endif
