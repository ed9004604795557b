// What a basis must be in a cell: the checks of basis.cc.
#ifndef tests_grid_basis_checks_h
#define tests_grid_basis_checks_h

#include <impoint/base/parameter_file.h>
#include <impoint/grid/basis.h>

#include <cmath>

using namespace Impoint;

struct GridScene
{
  explicit GridScene(const std::vector<std::string> &entries)
    : file("", entries)
  {
    parameters.declare(file);
    file.apply();
  }

  ParameterFile  file;
  GridParameters parameters;
};

// a smooth field of the nodes' places, the same for all ranks
template <int dim>
double coefficient(const Point<dim> &x)
{
  return std::sin(3 * x[0] + 1) * std::cos(2 * x[1]) + x[dim - 1];
}

template <int dim>
struct Values
{
  Values(const Basis<dim> &basis, const unsigned int c, const Point<dim> &x)
  {
    std::vector<double> support(basis.support_size(c));
    basis.evaluate(c, basis.grid().to_reference(c, x), support.data());
    const unsigned int n = basis.n_nodes_of(c);
    for (unsigned int a = 0; a < n; ++a)
      {
        const Point<dim> &place = basis.point(basis.nodes(c)[a]);
        one += support[a];
        linear += support[a] * place;
        field += support[a] * coefficient(place);
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] += support[n + a * dim + d] * coefficient(place);
      }
  }

  double         one = 0, field = 0;
  Tensor<1, dim> linear, gradient;
};

struct Errors
{
  double one = 0, linear = 0, gradient = 0, jump = 0, kink = 0, side = 0;
};

template <int dim>
void check_cell(const Basis<dim> &basis, const unsigned int c, Errors &errors)
{
  const auto &grid  = basis.grid();
  const auto  cell  = grid.cell(c);
  const auto  raise = [](double &error, const double found) {
    error = std::max(error, std::abs(found));
  };
  const Point<dim> x =
    cell->center() + 0.1 * (cell->vertex(1) - cell->center());
  const Values<dim> at(basis, c, x);
  raise(errors.one, at.one - 1);
  raise(errors.linear, (at.linear - x).norm());
  for (unsigned int d = 0; d < dim; ++d)
    {
      Tensor<1, dim> step;
      step[d] = 1e-4 * grid.size(c);
      const Values<dim> above(basis, c, x + step), below(basis, c, x - step);
      raise(errors.gradient,
            (above.field - below.field) / (2 * step[d]) - at.gradient[d]);
    }
  for (const unsigned int f : cell->face_indices())
    {
      const Point<dim> middle = cell->face(f)->center();
      if (cell->at_boundary(f) || !cell->neighbor(f)->is_active())
        continue;
      const unsigned int other = cell->neighbor(f)->active_cell_index();
      const Values<dim>  here(basis, c, middle), there(basis, other, middle);
      raise(errors.jump, here.field - there.field);
      raise(errors.kink, (here.gradient - there.gradient).norm());
    }
}

#endif
