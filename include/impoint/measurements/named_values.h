#ifndef impoint_measurements_named_values_h
#define impoint_measurements_named_values_h

#include <impoint/base/expression.h>
#include <impoint/measurements/measurement.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * A measurement of numbers with names: columns of the history and, with
     * their last values and references, lines of the results. "tip u_x" is
     * quantity "u_x" of the measurement "tip"; one without a name is "tip".
     */
    template <int dim>
    class NamedValues : public Measurement<dim>
    {
    public:
      /** Throws InputError for an entry "Reference" that does not fit. */
      NamedValues(const ParameterFile            &file,
                  const MeasurementParameters    &parameters,
                  const std::vector<std::string> &quantities);

      void columns(HistoryRow &row) const override;
      void results(std::vector<Result> &results) const override;
      void save_or_load(StateArchive &archive) override;

    protected:
      /** One value for each quantity, at @p time. */
      void set(const std::vector<double> &values, const double time);

      const std::string name;

    private:
      void read_references(const ParameterFile &file, const std::string &path);

      std::vector<std::string>                      labels;
      std::vector<double>                           values;
      double                                        time = 0;
      std::vector<std::unique_ptr<Expression<dim>>> references; // null: none
    };



    /** "u_x", "u_y", ... for "u". */
    template <int dim>
    std::vector<std::string> with_components(const std::string &symbol);

    /** The same, and the components of a moment: in 2D that about z only. */
    template <int dim>
    std::vector<std::string> with_moments(const std::string &symbol,
                                          const std::string &moment);

    /** The vector given by @p numbers, zero if there are none. */
    template <int dim>
    Tensor<1, dim> to_vector(const std::vector<double> &numbers);

    /** Number of the body named in @p parameters, or invalid_unsigned_int if
     * all are meant. */
    unsigned int body_number(const ParameterFile         &file,
                             const MeasurementParameters &parameters);

    /** Whether point @p p belongs to the body of that number. */
    template <int dim>
    bool is_in_body(const MaterialPoints<dim> &points,
                    const unsigned int         p,
                    const unsigned int         number)
    {
      return number == numbers::invalid_unsigned_int ||
             points.body(p) == number;
    }

    /** Sums over ranks, in place. */
    void sum_over_ranks(std::vector<double> &sums, const MPI_Comm communicator);
  } // namespace Measurements
} // namespace Impoint

#endif
