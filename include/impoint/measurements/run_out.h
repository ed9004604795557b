#ifndef impoint_measurements_run_out_h
#define impoint_measurements_run_out_h

#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * How far the material has come in a direction: coordinate of the furthest
     * point, and that which 99 % of the mass have not passed, found in bins of
     * 1e-12 of the material's extent.
     *
     * Results: "NAME furthest", "NAME 99 %" [m].
     */
    template <int dim>
    class RunOut : public NamedValues<dim>
    {
    public:
      RunOut(const ParameterFile         &file,
             const MeasurementParameters &parameters);

      void start(const State<dim> &state) override;
      void end_step(const State<dim> &state) override;

    private:
      /** Coordinates of a set of points, and their masses. */
      struct Row
      {
        std::vector<double> coordinates, masses;
      };

      static double quantile(const Row     &row,
                             double         lower,
                             double         upper,
                             const double   share,
                             const MPI_Comm communicator);

      const unsigned int body;
      Tensor<1, dim>     direction;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
