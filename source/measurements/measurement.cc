#include <impoint/measurements/quantities.h>

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

        bool integrates_forces() const override
        {
          return limited->integrates_forces();
        }

        void begin(const State<dim> &state) override
        {
          limited->begin(state);
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

    } // namespace



    template <int dim>
    std::unique_ptr<Measurement<dim>>
    create(const ParameterFile &file, const MeasurementParameters &parameters)
    {
      const auto &functions = quantity(parameters.quantity).functions<dim>();
      return std::make_unique<TimeLimit<dim>>(functions.create(file,
                                                               parameters),
                                              parameters.until);
    }

    template std::unique_ptr<Measurement<2>>
    create(const ParameterFile &, const MeasurementParameters &);
    template std::unique_ptr<Measurement<3>>
    create(const ParameterFile &, const MeasurementParameters &);
  } // namespace Measurements
} // namespace Impoint
