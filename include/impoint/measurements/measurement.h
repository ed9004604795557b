#ifndef impoint_measurements_measurement_h
#define impoint_measurements_measurement_h

#include <impoint/base/condition_numbers.h>
#include <impoint/base/state_archive.h>
#include <impoint/enforcement/enforcement.h>
#include <impoint/measurements/measurement_parameters.h>
#include <impoint/measurements/totals.h>
#include <impoint/output/run_record.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Impoint
{
  /** What a scene measures: errors, probes, reactions, paths. */
  namespace Measurements
  {
    /** What a boundary does to the material. */
    template <int dim>
    struct BoundaryForce
    {
      std::string    name;
      Tensor<1, dim> force;  // [N]
      Tensor<1, 3>   moment; // about the origin [Nm]; 2D: z only
    };

    /** What a measurement may look at. */
    template <int dim>
    struct State
    {
      const MaterialPoints<dim>                                    &points;
      const std::vector<std::unique_ptr<Enforcement::Method<dim>>> &methods;
      const ActiveNodes<dim>                                       &active;

      double time      = 0; // at the end of the step [s]
      double time_step = 0; // [s]

      std::vector<BoundaryForce<dim>> forces; // of every boundary, as listed in
                                              // the scene; sums of all ranks
      std::vector<double> residuals; // relative, of the step's iteration
      Totals<dim>         totals;    // of the material points
      double strain_of_forces = 0;   // that residuals refer to, by E h^(dim-1)

      /** Of the matrix that was solved with last; in follow(). Collective. */
      std::function<ConditionNumbers()> condition_numbers = []() {
        return ConditionNumbers();
      };
    };

    /**
     * One quantity that a scene measures. A new one is a header, a source and a
     * row in quantities.cc. Everything is collective, and all ranks get the
     * same numbers, whatever their number.
     */
    template <int dim>
    class Measurement
    {
    public:
      virtual ~Measurement() = default;

      /** Throws InputError where entries that all measurements have make no
       * sense for this one; hidden by those that ask for more. Seen by --check,
       * before anything is set up. */
      static void check(const ParameterFile & /*file*/,
                        const MeasurementParameters & /*parameters*/)
      {}

      /** Before the first step: points are placed, no nodes are active yet. */
      virtual void start(const State<dim> & /*state*/)
      {}

      /** Whether begin() wants the forces at the start. */
      virtual bool integrates_forces() const
      {
        return false;
      }

      /** Before the first step: nodes are active; forces are those at the
       * start, without moments. */
      virtual void begin(const State<dim> & /*state*/)
      {}

      /** A step converged, points have not moved yet: @p u, ghosts up to date,
       * is its displacement on the active nodes. */
      virtual void
      follow(const State<dim> & /*state*/,
             const LinearAlgebra::distributed::Vector<double> & /*u*/)
      {}

      /** Points are at their new places with their new state. */
      virtual void end_step(const State<dim> & /*state*/)
      {}

      /** Adds the columns of history.csv. */
      virtual void columns(HistoryRow & /*row*/) const
      {}

      /** Adds the lines of the table of results. */
      virtual void results(std::vector<Result> &results) const = 0;

      /** What the user should be told, once; all ranks the same. */
      virtual std::string take_warning()
      {
        return "";
      }

      /** What a resumed run must know of earlier steps. */
      virtual void save_or_load(StateArchive & /*archive*/)
      {}
    };

    /** What @p parameters, already checked, ask for. Throws InputError. */
    template <int dim>
    std::unique_ptr<Measurement<dim>>
    create(const ParameterFile &file, const MeasurementParameters &parameters);
  } // namespace Measurements
} // namespace Impoint

#endif
