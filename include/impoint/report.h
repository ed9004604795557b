#ifndef impoint_report_h
#define impoint_report_h

#include <impoint/output/history.h>
#include <impoint/output/pictures.h>
#include <impoint/output/terminal.h>
#include <impoint/stepper.h>

#include <memory>
#include <string>
#include <vector>

namespace Impoint
{
  /**
   * What a run tells: measurements, history, pictures, summary and terminal,
   * as the steps go on.
   */
  template <int dim>
  class Report : public StepObserver<dim>
  {
  public:
    using typename StepObserver<dim>::State;
    using typename StepObserver<dim>::Vector;

    /** Writes nothing. Throws InputError. */
    Report(ParameterFile      &file,
           const Scene<dim>   &scene,
           const OutputFolder &folder,
           Counters           &counters,
           Seconds            &seconds);

    /** What of the scene and of its @p state before the first step a person
     * should judge; finds measurements without material. Throws InputError. */
    void examine(const State &state);

    /** Decides on the columns of the history. Throws InputError. */
    void choose_columns(const State &state);

    /** Opens the history, which has a row for each step done. */
    void open();

    /** Says what will be computed. */
    void header(const State &state, const std::string &solver);

    void picture(const State &state, const Vector &u);
    void picture_if_missing(const State &state, const Vector &u);

    /** Writes the summary and tells the results. */
    void finish(const State       &state,
                const std::string &solver,
                const std::string &status,
                const std::string &message);

    void warn(const std::string &text);

    Terminal &terminal()
    {
      return speaker;
    }

    void save_or_load(StateArchive &archive);

    bool wants_first_forces() const override;
    void begin(const State &state) override;
    void prepared(const State &state) override;
    void follow(const State &state, const Vector &u) override;
    void end_step(const State &state, const Vector &u) override;

  private:
    void warn_of_round_off(const double residual);
    void record(const State &state, const Vector &u);
    void describe(const State &state, const std::string &solver);

    ParameterFile                                               &file;
    const Scene<dim>                                            &scene;
    const OutputFolder                                          &folder;
    MPI_Comm                                                     comm;
    Counters                                                    &counters;
    Seconds                                                     &seconds;
    Terminal                                                     speaker;
    std::vector<std::unique_ptr<Measurements::Measurement<dim>>> measurements;
    std::vector<std::string>                                     columns;
    HistoryWriter                                                history;
    Pictures<dim>                                                pictures;
    RunRecord                                                    run_record;

    std::size_t       linear_iterations_before = 0; // the last step
    std::size_t       pictured_step            = 0; // the last one
    std::vector<char> told_of_lost_load;            // per method
    bool              told_of_round_off = false;
  };
} // namespace Impoint

#endif
