#ifndef impoint_base_expression_h
#define impoint_base_expression_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>

namespace Impoint
{
  using namespace dealii;

  class ParameterFile;

  /**
   * A vector-valued (or scalar) function of place and time, written in a scene
   * with the variables x, y, (z,) t and the constants pi, e; components are
   * separated by ';'. An empty text is zero. One that names no variable is
   * constant, one that does not name t is steady, and both are known to be so,
   * to be skipped.
   */
  template <int dim>
  class Expression
  {
  public:
    /** The zero function with @p n_components. */
    explicit Expression(const unsigned int n_components = dim);

    /**
     * Parses the entry @p path of @p file; throws InputError if it is not an
     * expression or has not @p n_components components.
     */
    Expression(const ParameterFile &file,
               const std::string   &path,
               const unsigned int   n_components = dim);

    /** The same from a text, which messages give as the place. */
    Expression(const std::string &text, const unsigned int n_components);

    Expression(Expression &&) noexcept;
    Expression &operator=(Expression &&) noexcept;
    ~Expression();

    /** Throws RunFailed where the expression has no finite value. */
    double value(const Point<dim>  &x,
                 const double       t,
                 const unsigned int component) const;

    /** All components of an expression that has dim of them. */
    Tensor<1, dim> vector(const Point<dim> &x, const double t) const;

    bool is_zero() const;     // 0 in every component, always and everywhere
    bool is_constant() const; // neither place nor time occur
    bool is_steady() const;   // time does not occur

  private:
    struct Parser;

    Expression(const std::string &text,
               const unsigned int n_components,
               const std::string &place);

    double parsed_value(const Point<dim>  &x,
                        const double       t,
                        const unsigned int component) const;

    static constexpr unsigned int max_components = 6;

    std::unique_ptr<Parser>   parser; // of what is not constant
    Tensor<1, max_components> constant;
    unsigned int              n_components;
    bool                      constant_in_space = true, constant_in_time = true;
  };
} // namespace Impoint

#endif
