#include <impoint/base/parameter_file.h>
#include <impoint/measurements/named_values.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Impoint
{
  namespace Measurements
  {
    template <int dim>
    NamedValues<dim>::NamedValues(const ParameterFile            &file,
                                  const MeasurementParameters    &parameters,
                                  const std::vector<std::string> &quantities)
      : name(parameters.name)
      , values(quantities.size(), 0.)
    {
      for (const auto &quantity : quantities)
        labels.push_back(quantity.empty() ? name : name + " " + quantity);
      read_references(file, parameters.section + "/Reference");
    }



    template <int dim>
    void NamedValues<dim>::read_references(const ParameterFile &file,
                                           const std::string   &path)
    {
      references.resize(labels.size());
      const auto texts = Words::split(file.value(path), ';');
      if (texts.size() > labels.size())
        throw file.error(path,
                         "'" + file.value(path) + "' has " +
                           std::to_string(texts.size()) + " references for " +
                           std::to_string(labels.size()) + " results",
                         "The results are: " + Words::join(labels, ", ") + ".");
      for (unsigned int i = 0; i < texts.size(); ++i)
        if (!texts[i].empty() && texts[i] != "none")
          try
            {
              references[i] = std::make_unique<Expression<dim>>(texts[i], 1);
            }
          catch (const InputError &)
            {
              throw file.error(path,
                               "'" + texts[i] + "' is no expression of t",
                               "Separate expressions by ';'; 'none' stands for "
                               "no reference.");
            }
    }



    template <int dim>
    void NamedValues<dim>::set(const std::vector<double> &new_values,
                               const double               new_time)
    {
      AssertDimension(new_values.size(), labels.size());
      values = new_values;
      time   = new_time;
    }



    template <int dim>
    void NamedValues<dim>::columns(HistoryRow &row) const
    {
      for (unsigned int i = 0; i < labels.size(); ++i)
        row.emplace_back(labels[i], values[i]);
    }



    template <int dim>
    void NamedValues<dim>::results(std::vector<Result> &results) const
    {
      for (unsigned int i = 0; i < labels.size(); ++i)
        {
          results.push_back({labels[i], values[i]});
          if (references[i])
            try
              {
                results.back().reference =
                  references[i]->value(Point<dim>(), time, 0);
              }
            catch (const RunFailed &failure)
              {
                results.back().warning =
                  "'" + labels[i] + "' has no reference: " + failure.what();
              }
        }
    }



    template <int dim>
    void NamedValues<dim>::save_or_load(StateArchive &archive)
    {
      archive.tag(Words::join(labels, ", "));
      archive &values &time;
    }



    template <int dim>
    std::vector<std::string> with_components(const std::string &symbol)
    {
      std::vector<std::string> names;
      for (unsigned int d = 0; d < dim; ++d)
        names.push_back(symbol + "_" + "xyz"[d]);
      return names;
    }



    template <int dim>
    std::vector<std::string> with_moments(const std::string &symbol,
                                          const std::string &moment)
    {
      auto names = with_components<dim>(symbol);
      for (unsigned int d = dim == 2 ? 2 : 0; d < 3; ++d)
        names.push_back(moment + "_" + "xyz"[d]);
      return names;
    }



    template <int dim>
    Tensor<1, dim> to_vector(const std::vector<double> &numbers)
    {
      Tensor<1, dim> vector;
      std::copy(numbers.begin(), numbers.end(), vector.begin_raw());
      return vector;
    }



    unsigned int body_number(const ParameterFile         &file,
                             const MeasurementParameters &parameters)
    {
      if (parameters.body.empty())
        return numbers::invalid_unsigned_int;
      const auto names = file.names("Bodies/Names");
      return std::find(names.begin(), names.end(), parameters.body) -
             names.begin();
    }



    void sum_over_ranks(std::vector<double> &sums, const MPI_Comm communicator)
    {
      const std::vector<double> own = sums;
      Utilities::MPI::sum(own, communicator, sums);
    }



    template std::vector<std::string> with_components<2>(const std::string &);
    template std::vector<std::string> with_components<3>(const std::string &);
    template std::vector<std::string> with_moments<2>(const std::string &,
                                                      const std::string &);
    template std::vector<std::string> with_moments<3>(const std::string &,
                                                      const std::string &);
    template Tensor<1, 2>             to_vector<2>(const std::vector<double> &);
    template Tensor<1, 3>             to_vector<3>(const std::vector<double> &);
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::NamedValues<2>;
template class Impoint::Measurements::NamedValues<3>;
