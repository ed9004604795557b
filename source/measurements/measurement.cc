#include <impoint/measurements/body_path.h>
#include <impoint/measurements/convergence.h>
#include <impoint/measurements/energy.h>
#include <impoint/measurements/field_error.h>
#include <impoint/measurements/impulse.h>
#include <impoint/measurements/penetration.h>
#include <impoint/measurements/probe.h>
#include <impoint/measurements/reaction.h>
#include <impoint/measurements/run_out.h>
#include <impoint/measurements/surface_slope.h>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      /** A measurement that looks away after a certain time. */
      template <int dim>
      class TimeLimit : public Measurement<dim>
      {
      public:
        TimeLimit(std::unique_ptr<Measurement<dim>> limited, const double until)
          : limited(std::move(limited))
          , until(until)
        {}

        void start(const State<dim> &state) override
        {
          limited->start(state);
        }

        void
        follow(const State<dim>                                 &state,
               const LinearAlgebra::distributed::Vector<double> &u) override
        {
          if (looks(state))
            limited->follow(state, u);
        }

        void end_step(const State<dim> &state) override
        {
          if (looks(state))
            limited->end_step(state);
        }

        void columns(HistoryRow &row) const override
        {
          limited->columns(row);
        }

        void results(std::vector<Result> &results) const override
        {
          limited->results(results);
        }

        std::string take_warning() override
        {
          return limited->take_warning();
        }

        void save_or_load(StateArchive &archive) override
        {
          limited->save_or_load(archive);
        }

      private:
        /** The end of a step may miss the limit by the round-off of its time.
         */
        bool looks(const State<dim> &state) const
        {
          return state.time <= until + 1e-6 * state.time_step;
        }

        std::unique_ptr<Measurement<dim>> limited;
        const double                      until;
      };



      template <int dim>
      std::unique_ptr<Measurement<dim>>
      create_quantity(const ParameterFile         &file,
                      const MeasurementParameters &parameters)
      {
        const std::string &quantity = parameters.quantity;
        if (quantity == "probe")
          return std::make_unique<Probe<dim>>(file, parameters);
        if (quantity == "reaction")
          return std::make_unique<Reaction<dim>>(file, parameters);
        if (quantity == "impulse")
          return std::make_unique<Impulse<dim>>(file, parameters);
        if (quantity == "path")
          return std::make_unique<BodyPath<dim>>(file, parameters);
        if (quantity == "penetration")
          return std::make_unique<Penetration<dim>>(file, parameters);
        if (quantity == "run-out")
          return std::make_unique<RunOut<dim>>(file, parameters);
        if (quantity == "slope")
          return std::make_unique<SurfaceSlope<dim>>(file, parameters);
        if (quantity == "energy")
          return std::make_unique<Energy<dim>>(file, parameters);
        if (quantity == "newton")
          return std::make_unique<Convergence<dim>>(parameters);
        return std::make_unique<FieldError<dim>>(file, parameters);
      }
    } // namespace



    template <int dim>
    std::unique_ptr<Measurement<dim>>
    create(const ParameterFile &file, const MeasurementParameters &parameters)
    {
      return std::make_unique<TimeLimit<dim>>(create_quantity<dim>(file,
                                                                   parameters),
                                              parameters.until);
    }

    template std::unique_ptr<Measurement<2>>
    create(const ParameterFile &, const MeasurementParameters &);
    template std::unique_ptr<Measurement<3>>
    create(const ParameterFile &, const MeasurementParameters &);
  } // namespace Measurements
} // namespace Impoint
