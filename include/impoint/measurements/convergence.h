#ifndef impoint_measurements_convergence_h
#define impoint_measurements_convergence_h

#include <impoint/measurements/measurement.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * How Newton's iteration converges. The order of a step is that of its last
     * two reductions above round-off, log(r_k+1 / r_k) / log(r_k / r_k-1).
     *
     * Results: "NAME iterations": most of a step; "NAME order": smallest of all
     * steps that have one (left out if none has: three residuals above 1e-13
     * are needed). The history has the iterations of each step.
     */
    template <int dim>
    class Convergence : public Measurement<dim>
    {
    public:
      Convergence(const ParameterFile         &file,
                  const MeasurementParameters &parameters);

      void end_step(const State<dim> &state) override;
      void columns(HistoryRow &row) const override;
      void results(std::vector<Result> &results) const override;
      void save_or_load(StateArchive &archive) override;

    private:
      const std::string name;
      unsigned int      iterations = 0, most_iterations = 0;
      double            smallest_order; // infinite: none yet
    };



    /** The order of convergence of relative @p residuals, infinite if there are
     * too few. */
    double order_of_convergence(const std::vector<double> &residuals);
  } // namespace Measurements
} // namespace Impoint

#endif
