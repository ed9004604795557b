#include <impoint/base/exceptions.h>
#include <impoint/base/expression.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>

#include <deal.II/base/function_parser.h>
#include <deal.II/base/numbers.h>

#include <cctype>
#include <cmath>
#include <iostream>
#include <set>
#include <sstream>

namespace Impoint
{
  namespace
  {
    template <int dim>
    std::string expression_variables()
    {
      return dim == 2 ? "x, y, t" : "x, y, z, t";
    }



    template <int dim>
    std::string expression_advice()
    {
      return "Use " + expression_variables<dim>() +
             ", pi, e, + - * / ^, comparisons and functions such as sin, exp, "
             "sqrt, pow(a, b), if(condition, a, b).";
    }



    // The names in @p text; the e of 1e-3 is none.
    std::set<std::string> identifiers(const std::string &text)
    {
      std::set<std::string> names;
      const auto            in_word = [&](const std::size_t i) {
        return i < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[i])) ||
                text[i] == '_' || text[i] == '.');
      };
      for (std::size_t i = 0; i < text.size(); ++i)
        if (in_word(i))
          {
            const std::size_t begin = i;
            while (in_word(i + 1))
              ++i;
            // an unspaced sequence that starts with a digit is a number
            if (!std::isdigit(static_cast<unsigned char>(text[begin])) &&
                text[begin] != '.')
              names.insert(text.substr(begin, i + 1 - begin));
          }
      return names;
    }



    // muparser takes "a, b" as b and "x = 1" as an assignment; neither is meant
    std::string misunderstood(const std::string &text)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          depth += (text[i] == '(') - (text[i] == ')');
          if (text[i] == ',' && depth == 0)
            return "',' between components: separate them by ';'";
          if (text[i] != '=')
            continue;
          const bool comparison =
            text[i + 1] == '=' ||
            (i > 0 &&
             std::string("=<>!").find(text[i - 1]) != std::string::npos);
          if (!comparison)
            return "'=' sets nothing here: write '==' to compare";
        }
      const auto names = identifiers(text);
      if (names.count("rand") + names.count("rand_seed") > 0)
        return "random numbers would make every run another one";
      return "";
    }



    // deal.II writes muparser's complaint to std::cerr on every rank before it
    // throws; ours is the only message.
    class QuietErrorStream
    {
    public:
      QuietErrorStream()
        : original(std::cerr.rdbuf(swallowed.rdbuf()))
      {}

      ~QuietErrorStream()
      {
        std::cerr.rdbuf(original);
      }

    private:
      std::ostringstream swallowed;
      std::streambuf    *original;
    };



    std::string parser_complaint(const ExceptionBase &exception)
    {
      std::ostringstream text;
      exception.print_info(text);
      const std::string  marker = "The parser said: ";
      const auto         found  = text.str().find(marker);
      std::istringstream words(found == std::string::npos ?
                                 text.str() :
                                 text.str().substr(found + marker.size()));
      std::string        line;
      for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
      return line.substr(0, line.find_last_not_of('.') + 1);
    }
  } // namespace



  // value() of the base takes the time from set_time(); this one is const.
  template <int dim>
  struct Expression<dim>::Parser : public FunctionParser<dim>
  {
    Parser(const std::vector<std::string> &components, const std::string &place)
      : FunctionParser<dim>(components.size())
      , place(place)
    {
      this->initialize(expression_variables<dim>(),
                       components,
                       {{"pi", numbers::PI}, {"e", numbers::E}},
                       true);
    }

    double evaluate(const Point<dim>  &x,
                    const double       t,
                    const unsigned int component) const
    {
      return this->do_value(x, t, component);
    }

    const std::string place;
  };



  template <int dim>
  Expression<dim>::Expression(const unsigned int n_components)
    : n_components(n_components)
  {}



  template <int dim>
  Expression<dim>::Expression(const ParameterFile &file,
                              const std::string   &path,
                              const unsigned int   n_components)
    : Expression(file.value(path), n_components, file.place(path))
  {}



  template <int dim>
  Expression<dim>::Expression(const std::string &text,
                              const unsigned int n_components)
    : Expression(text, n_components, "expression '" + text + "'")
  {}



  template <int dim>
  Expression<dim>::Expression(const std::string &text,
                              const unsigned int n_components,
                              const std::string &place)
    : n_components(n_components)
  {
    AssertIndexRange(n_components, max_components + 1);
    const auto fail = [&](const std::string &wrong) {
      throw InputError("'" + text + "': " + wrong,
                       place,
                       expression_advice<dim>());
    };
    if (text.find_first_not_of(" \t") == std::string::npos)
      return; // nothing written: zero
    const auto components = Words::split(text, ';');
    for (const auto &component : components)
      if (!misunderstood(component).empty())
        fail(misunderstood(component));
    if (components.size() != n_components)
      throw InputError("'" + text + "' has " +
                         std::to_string(components.size()) +
                         " components instead of " +
                         std::to_string(n_components),
                       place,
                       n_components == 1 ? "Write one expression." :
                                           "Separate the components by ';'.");

    const auto names = identifiers(text);
    constant_in_time = names.count("t") == 0;
    constant_in_space =
      names.count("x") + names.count("y") + names.count("z") == 0;
    try
      {
        const QuietErrorStream quiet;
        parser = std::make_unique<Parser>(components, place);
        for (unsigned int c = 0; c < n_components; ++c)
          constant[c] = parser->evaluate(Point<dim>(), 0., c);
      }
    catch (const ExceptionBase &exception)
      {
        fail(parser_complaint(exception));
      }

    if (!is_constant())
      return;
    for (unsigned int c = 0; c < n_components; ++c)
      if (!std::isfinite(constant[c]))
        fail("not a finite number");
    parser.reset();
  }



  template <int dim>
  Expression<dim>::Expression(Expression &&) noexcept = default;

  template <int dim>
  Expression<dim> &Expression<dim>::operator=(Expression &&) noexcept = default;

  template <int dim>
  Expression<dim>::~Expression() = default;



  template <int dim>
  double Expression<dim>::value(const Point<dim>  &x,
                                const double       t,
                                const unsigned int component) const
  {
    AssertIndexRange(component, n_components);
    return parser ? parsed_value(x, t, component) : constant[component];
  }



  template <int dim>
  Tensor<1, dim> Expression<dim>::vector(const Point<dim> &x,
                                         const double      t) const
  {
    AssertDimension(n_components, dim);
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = value(x, t, d);
    return result;
  }



  template <int dim>
  double Expression<dim>::parsed_value(const Point<dim>  &x,
                                       const double       t,
                                       const unsigned int component) const
  {
    const double result = parser->evaluate(x, t, component);
    if (!std::isfinite(result))
      {
        std::ostringstream message;
        message << parser->place << " has no finite value at (" << x
                << "), t = " << t;
        throw RunFailed(message.str());
      }
    return result;
  }



  template <int dim>
  bool Expression<dim>::is_zero() const
  {
    return is_constant() && constant.norm_square() == 0.;
  }



  template <int dim>
  bool Expression<dim>::is_constant() const
  {
    return constant_in_space && constant_in_time;
  }



  template <int dim>
  bool Expression<dim>::is_steady() const
  {
    return constant_in_time;
  }
} // namespace Impoint

template class Impoint::Expression<2>;
template class Impoint::Expression<3>;
