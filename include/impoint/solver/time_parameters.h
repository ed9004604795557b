#ifndef impoint_solver_time_parameters_h
#define impoint_solver_time_parameters_h


namespace Impoint
{
  class ParameterFile;

  enum class InitialAcceleration
  {
    equilibrium,
    zero,
    expression
  };

  enum class MassMatrix
  {
    automatic, // as the functions of the grid want it
    lumped,
    consistent
  };

  /** How time is discretised. */
  struct TimeParameters
  {
    void declare(ParameterFile &file);
    /** Decides what is automatic. @p positive: no function of the grid is
     * negative anywhere. */
    void complete(const bool positive);
    void check(const ParameterFile &file) const;

    bool       dynamic               = false; // else quasi-static
    double     end                   = 1;
    double     step                  = 1;
    double     smallest              = 1e-3; // of the given step
    double     beta                  = 0.25;
    double     gamma                 = 0.5;
    double     dynamic_from          = 0; // [s]; load steps until then
    double     spectral_radius       = 1; // of the highest frequencies, a step
    double     filter                = 0; // of unseen velocities [s]; 0: none
    double     filter_at_rest        = 0; // instead, near rest [s]; 0: the same
    bool       consistent_projection = false; // else lumped
    MassMatrix mass                  = MassMatrix::automatic;
    InitialAcceleration initial      = InitialAcceleration::equilibrium;
    bool                is_dynamic() const
    {
      return dynamic;
    }
    /** Whether no step follows @p time, but for round-off. */
    bool is_over(const double time) const
    {
      return time >= end - 1e-9 * step;
    }
    /** Whether a step that begins at @p start is a load step before motion. */
    bool rests_after(const double start) const
    {
      return is_dynamic() && start < dynamic_from - 1e-9 * step;
    }
    /** Whether it has inertia. */
    bool moves_after(const double start) const
    {
      return is_dynamic() && !rests_after(start);
    }

  private:
    void declare_masses(ParameterFile &file);
  };
} // namespace Impoint

#endif
