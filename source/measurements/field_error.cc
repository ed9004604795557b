#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/tensor_functions.h>
#include <impoint/measurements/field_error.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace Measurements
  {
    namespace
    {
      /** Names of a field's components in the order in which expressions give
       * them: x, y(, z), or those of base/voigt.h, followed by zz in 2D. */
      template <int dim>
      std::vector<std::string> field_components(const std::string &quantity)
      {
        using Names = std::vector<std::string>;
        if (quantity != "stress error")
          return dim == 2 ? Names{"x", "y"} : Names{"x", "y", "z"};
        return dim == 2 ? Names{"xx", "yy", "xy", "zz"} :
                          Names{"xx", "yy", "zz", "xy", "xz", "yz"};
      }
    } // namespace



    template <int dim>
    FieldError<dim>::Selection::Selection(
      const ParameterFile         &file,
      const MeasurementParameters &parameters)
    {
      const std::string path       = parameters.section + "/Exact";
      const auto        components = field_components<dim>(parameters.quantity);
      const unsigned int n         = Words::split(file.value(path), ';').size();
      const unsigned int one =
        std::find(components.begin(), components.end(), parameters.component) -
        components.begin();
      const bool single = one < components.size();
      const bool stress = parameters.quantity == "stress error";
      const bool plane  = stress && dim == 2 && n == 3;
      if (single && n == 1)
        given = {one};
      else if (n == components.size() || plane)
        for (unsigned int k = 0; k < n; ++k)
          given.push_back(k);
      const auto found = std::find(given.begin(), given.end(), one);
      if (given.empty() || (single && found == given.end()))
        throw file.error(path,
                         "'" + file.value(path) + "' has " + std::to_string(n) +
                           " components",
                         "Give expressions for " +
                           Words::join(components, "; ") + ".");

      for (const unsigned int k : given)
        weights.push_back(components[k][0] == components[k].back() ? 1. : 2.);
      if (parameters.component == "norm")
        {
          wanted = {ErrorNorm::whole};
          names  = {""};
        }
      else if (single)
        {
          wanted = {static_cast<unsigned int>(found - given.begin())};
          names  = {""};
        }
      else
        for (unsigned int i = 0; i < given.size(); ++i)
          {
            wanted.push_back(i);
            names.push_back(components[given[i]]);
          }
    }



    template <int dim>
    FieldError<dim>::FieldError(const ParameterFile         &file,
                                const MeasurementParameters &parameters)
      : FieldError(file, parameters, Selection(file, parameters))
    {}



    template <int dim>
    void FieldError<dim>::check(const ParameterFile         &file,
                                const MeasurementParameters &parameters)
    {
      const std::string path = parameters.section + "/Exact";
      if (file.value(path).empty())
        throw file.error(path,
                         "an error needs exact values",
                         "Set expressions of x, y(, z), t separated by ';'.");
      const auto  components = field_components<dim>(parameters.quantity);
      const auto &component  = parameters.component;
      if (component != "norm" && component != "all" &&
          std::count(components.begin(), components.end(), component) == 0)
        throw file.error(parameters.section + "/Component",
                         "'" + component + "' is no component of the field",
                         "Set norm, all, or one of " +
                           Words::join(components, ", ") + ".");
    }



    template <int dim>
    FieldError<dim>::FieldError(const ParameterFile         &file,
                                const MeasurementParameters &parameters,
                                const Selection             &selection)
      : NamedValues<dim>(file, parameters, selection.names)
      , parameters(parameters)
      , selection(selection)
      , no_velocity(file.error(parameters.section + "/Quantity",
                               "the scene is quasi-static and has no velocity",
                               "Measure something else, or make it dynamic."))
      , body(body_number(file, parameters))
      , exact(file, parameters.section + "/Exact", selection.given.size())
      , origin(to_vector<dim>(parameters.point))
    {
      const double angle = parameters.frame_angle * numbers::PI / 180;
      for (unsigned int d = 0; d < dim; ++d)
        frame[d][d] = 1;
      if (angle != 0)
        {
          frame[0][0] = frame[1][1] = std::cos(angle);
          frame[0][1]               = std::sin(angle);
          frame[1][0]               = -std::sin(angle);
        }
    }



    template <int dim>
    void FieldError<dim>::start(const State<dim> &state)
    {
      if (parameters.quantity == "velocity error" &&
          !state.points.carried().dynamic)
        throw no_velocity;
    }



    template <int dim>
    void FieldError<dim>::end_step(const State<dim> &state)
    {
      this->set(all_errors(state).errors(
                  state.active.basis().grid().communicator()),
                state.time);
    }



    template <int dim>
    ErrorNorm FieldError<dim>::all_errors(const State<dim> &state) const
    {
      const auto &points = state.points;
      ErrorNorm   norm(parameters.norm,
                     parameters.scale,
                     selection.weights,
                     selection.wanted);
      on_all_ranks(state.active.basis().grid().communicator(), [&]() {
        for (unsigned int p = 0; p < points.n(); ++p)
          if (is_in_body(points, p, body))
            {
              const Values     all = values(points, p);
              const Point<dim> x   = place(points, p);
              Values           here, should;
              for (unsigned int i = 0; i < selection.given.size(); ++i)
                {
                  here[i]   = all[selection.given[i]];
                  should[i] = exact.value(x, state.time, i);
                }
              norm.add(here.data(),
                       should.data(),
                       points.data(p)[points.slots().volume]);
            }
      });
      return norm;
    }



    template <int dim>
    typename FieldError<dim>::Values
    FieldError<dim>::values(const MaterialPoints<dim> &points,
                            const unsigned int         p) const
    {
      Values      result = {};
      const auto &slots  = points.slots();
      if (parameters.quantity != "stress error")
        {
          const Tensor<1, dim> vector =
            frame * points.vector(p,
                                  parameters.quantity == "displacement error" ?
                                    slots.u :
                                    slots.v);
          std::copy(vector.begin_raw(), vector.end_raw(), result.begin());
          return result;
        }

      // Small-strain materials return Cauchy's stress, others Kirchhoff's.
      const double     J      = points.material(p).small_strain() ?
                                  1. :
                                  determinant(points.deformation_gradient(p));
      const double    *stress = points.data(p) + slots.stress;
      VoigtVector<dim> fixed;
      std::copy(stress, stress + Voigt<dim>::n, fixed.begin());
      const Tensor<2, dim> turned =
        frame * to_tensor<dim>(fixed) * transpose(frame);
      for (int k = 0; k < Voigt<dim>::n; ++k)
        result[k] = turned[Voigt<dim>::row(k)][Voigt<dim>::column(k)] / J;
      if (dim == 2)
        result[Voigt<dim>::n] = stress[Voigt<dim>::n] / J;
      return result;
    }



    template <int dim>
    Point<dim> FieldError<dim>::place(const MaterialPoints<dim> &points,
                                      const unsigned int         p) const
    {
      Tensor<1, dim> way = points.position(p) - origin;
      if (parameters.position == "initial")
        way -= points.vector(p, points.slots().u);
      return Point<dim>(frame * way);
    }
  } // namespace Measurements
} // namespace Impoint

template class Impoint::Measurements::FieldError<2>;
template class Impoint::Measurements::FieldError<3>;
