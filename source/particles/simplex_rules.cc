#include <impoint/particles/simplex_rules.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <vector>

namespace Impoint
{
  namespace
  {
    /** Arguments and size of a QWitherdenVincentSimplex. */
    struct SimplexRule
    {
      unsigned int n_points, order;
      bool         odd;
    };



    const std::vector<SimplexRule> &simplex_rules(const unsigned int dim)
    {
      static const std::vector<SimplexRule> triangles  = {{1, 1, true},
                                                          {3, 1, false},
                                                          {6, 2, false},
                                                          {7, 3, true},
                                                          {12, 3, false},
                                                          {15, 4, true},
                                                          {16, 4, false},
                                                          {19, 5, true},
                                                          {25, 5, false},
                                                          {28, 6, true},
                                                          {33, 6, false},
                                                          {37, 7, true},
                                                          {42, 7, false}};
      static const std::vector<SimplexRule> tetrahedra = {{1, 1, true},
                                                          {4, 1, false},
                                                          {8, 2, true},
                                                          {14, 3, true},
                                                          {24, 3, false},
                                                          {35, 4, true},
                                                          {46, 4, false},
                                                          {59, 5, true},
                                                          {81, 5, false}};
      return dim == 2 ? triangles : tetrahedra;
    }
  } // namespace



  bool has_simplex_rule(const unsigned int dim, const unsigned int n_points)
  {
    const auto &rules = simplex_rules(dim);
    return std::any_of(rules.begin(), rules.end(), [&](const auto &rule) {
      return rule.n_points == n_points;
    });
  }



  std::string simplex_rule_sizes_text(const unsigned int dim)
  {
    std::string text;
    for (const auto &rule : simplex_rules(dim))
      text += (text.empty() ? "" : ", ") + std::to_string(rule.n_points);
    return text;
  }



  template <int dim>
  Quadrature<dim> simplex_rule(const unsigned int n_points)
  {
    Quadrature<dim> quadrature;
    for (const auto &rule : simplex_rules(dim))
      if (rule.n_points == n_points)
        quadrature = QWitherdenVincentSimplex<dim>(rule.order, rule.odd);
    AssertDimension(quadrature.size(), n_points);
    return quadrature;
  }



  unsigned int max_simplex_order(const unsigned int dim)
  {
    return dim == 2 ? 7 : 5;
  }



  template <int dim>
  Quadrature<dim> simplex_rule_of_order(const unsigned int n)
  {
    AssertIndexRange(n, max_simplex_order(dim) + 1);
    return QWitherdenVincentSimplex<dim>(n, true);
  }

  template Quadrature<2> simplex_rule<2>(const unsigned int);
  template Quadrature<3> simplex_rule<3>(const unsigned int);
  template Quadrature<2> simplex_rule_of_order<2>(const unsigned int);
  template Quadrature<3> simplex_rule_of_order<3>(const unsigned int);
} // namespace Impoint
