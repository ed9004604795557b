#ifndef impoint_measurements_probe_h
#define impoint_measurements_probe_h

#include <impoint/base/exceptions.h>
#include <impoint/measurements/named_values.h>

namespace Impoint
{
  namespace Measurements
  {
    /**
     * A place without mass that rides along with the material. It takes the
     * displacement of the cell with material that holds it; if there is none,
     * of the nearest one within one cell size, whose functions are continued.
     * Where there is none, either, it has lost its material for good: its
     * numbers are nan from then on.
     *
     * Results: "NAME u_x", "NAME u_y"(, "NAME u_z"): displacement since the
     * start [m]. The history also has the place: "NAME x", ...
     */
    template <int dim>
    class Probe : public NamedValues<dim>
    {
    public:
      Probe(const ParameterFile &file, const MeasurementParameters &parameters);

      static void check(const ParameterFile         &file,
                        const MeasurementParameters &parameters);

      /** Throws InputError if there is no material at the place. */
      void start(const State<dim> &state) override;

      void        follow(const State<dim>                                 &state,
                         const LinearAlgebra::distributed::Vector<double> &u) override;
      void        end_step(const State<dim> &state) override;
      void        columns(HistoryRow &row) const override;
      std::string take_warning() override;
      void        save_or_load(StateArchive &archive) override;

    private:
      /** A cell that the probe may belong to. */
      struct Candidate
      {
        double         distance; // in cell sizes, 0: inside
        Point<dim>     centre;   // of the cell
        Tensor<1, dim> increment;

        template <class Archive>
        void serialize(Archive &archive, const unsigned int)
        {
          archive &distance &centre &increment;
        }
      };

      std::vector<Candidate>
                  candidates(const State<dim>                                 &state,
                             const LinearAlgebra::distributed::Vector<double> *u) const;
      static bool choose(const std::vector<Candidate> &own,
                         const MPI_Comm                communicator,
                         Tensor<1, dim>               &increment);

      bool is_lost() const;

      InputError     misplaced;
      Point<dim>     place;
      Tensor<1, dim> displacement, increment;
      double         search_radius = 0;
      std::string    warning;
    };
  } // namespace Measurements
} // namespace Impoint

#endif
