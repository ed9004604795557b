#ifndef impoint_scene_h
#define impoint_scene_h

#include <impoint/enforcement/condition.h>
#include <impoint/measurements/measurement_parameters.h>
#include <impoint/particles/body_parameters.h>
#include <impoint/particles/boundary_parameters.h>
#include <impoint/solver/linear_solver.h>
#include <impoint/solver/newton.h>
#include <impoint/solver/time_parameters.h>

#include <algorithm>
#include <deque>
#include <string>
#include <vector>

namespace Impoint
{
  class ParameterFile;

  /** What a run writes, and what it tells on the terminal. */
  struct OutputParameters
  {
    void declare(ParameterFile &file);

    std::string  folder           = "output";
    std::string  verbosity        = "normal"; // silent|results|normal|talkative
    unsigned int every            = 1;        // steps between pictures; 0: none
    unsigned int checkpoint_every = 0;        // steps; 0: none
    double       checkpoint_minutes = 10;     // 0: none
  };

  /**
   * All parameters of a scene: the module's structs, in the order of the
   * computation. Declares what the file's lists of names call for, takes over
   * what the user set, and checks what clashes.
   */
  template <int dim>
  struct Scene
  {
    /** Throws InputError. */
    explicit Scene(ParameterFile &file);

    /** Declares every entry of the scenes that @p file may be. */
    static void declare(ParameterFile &file);

    /** Whether boundary @p i acts by particles: not on sides of the grid that
     * it holds. */
    bool has_particles(const unsigned int i) const
    {
      return !boundaries[i].conforming ||
             conditions[i].constraint == Constraint::traction;
    }

    /** Of the ghost penalty; 0: none. Nitsche's method in its symmetric form
     * is stable for small strains, and linear functions in a sliver of a cell
     * strain as they like: curved boundaries cost it steps. */
    double ghost_factor() const
    {
      return grid.ghost_factor(
        !time.is_dynamic() && std::any_of(conditions.begin(),
                                          conditions.end(),
                                          [](const auto &condition) {
                                            return condition.carries_material();
                                          }));
    }

    /** What is allowed but doubtful, for a person to judge. */
    std::vector<std::string> doubts() const;

    std::string            title;
    GridParameters         grid;
    TimeParameters         time;
    NewtonParameters       newton;
    LinearSolverParameters linear_solver;
    OutputParameters       output;

    // deque: the handler keeps addresses of members
    std::deque<BodyParameters>        bodies;
    std::deque<BoundaryParameters>    boundaries;
    std::deque<ConditionParameters>   conditions; // of the boundaries
    std::deque<MeasurementParameters> measurements;

  private:
    Scene() = default;
    void declare_entries(ParameterFile &file);
    void check(const ParameterFile &file) const;
    void check_effect(const ParameterFile       &file,
                      const ConditionParameters &condition) const;
    void check_support(const ParameterFile &file) const;
    void check_reset(const ParameterFile &file) const;
  };
} // namespace Impoint

#endif
