// Expressions of place and time: values, what is known to be zero, constant or
// steady, and what is said about mistakes.

#include <impoint/base/exceptions.h>
#include <impoint/base/expression.h>
#include <impoint/base/parameter_file.h>

#include <iostream>

using namespace Impoint;

template <int dim>
void evaluate(const std::string &text)
{
  const Expression<dim> expression(text, dim);
  Point<dim>            x;
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = 0.5 + 1.5 * d;
  std::cout << text << " = " << expression.vector(x, 3.)
            << (expression.is_zero() ? ", zero" : "")
            << (expression.is_constant() ? ", constant" : "")
            << (expression.is_steady() ? ", steady" : "") << std::endl;
}

template <int dim>
void attempt(const std::string &text)
{
  try
    {
      std::cout << Expression<dim>(text, 1).value(Point<dim>(), 0., 0)
                << std::endl;
    }
  catch (const std::runtime_error &error)
    {
      std::cout << error.what() << std::endl;
    }
}

int main()
{
  evaluate<2>("0; 0.0");
  evaluate<2>("2*pi; exp(1e0) - e");
  evaluate<2>("x*y^2; if(x > 1, 1, 2)");
  evaluate<2>("1e-3; t*y");
  evaluate<3>("x; z; t");

  // moved, as modules hold them
  Expression<2> held;
  std::cout << held.vector(Point<2>(), 0.) << std::endl;
  held = Expression<2>("x; t", 2);
  std::cout << held.vector(Point<2>(7, 8), 9.) << std::endl;

  for (const std::string text :
       {"1/0", "z", "2x", "x = 1", "rand()", "1; 2", "1, 2", "", "sin(", "1/x"})
    attempt<2>(text);

  ParameterFile file("", {"Load/Traction = 0; -g"});
  try
    {
      const Expression<2> traction(file, "Load/Traction");
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}
