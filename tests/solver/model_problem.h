#ifndef impoint_tests_solver_model_problem_h
#define impoint_tests_solver_model_problem_h

#include <impoint/solver/linear_solver.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <iostream>
#include <map>
#include <random>
#include <set>

namespace ModelProblem
{
  using namespace Impoint;

  struct Settings
  {
    unsigned int cells   = 8;     // per edge of the unit square or cube
    bool         slip    = false; // with the far end held, else fixed
    bool         slivers = true;  // a free surface that cuts cells
    bool         lattice = true;
    double       ridge   = 1e-8; // of E h^(dim-2), on every node
    double       thin = 1e-4; // part of their volume that slivers' points have
  };

  /**
   * An elastic block (E = 1, nu = 0.3) of 2^dim jittered material points a
   * cell in a Cartesian grid under gravity. An inclined plane through the
   * cells holds one side by a penalty on the mean gap of each cell.
   */
  template <int dim>
  class Block
  {
  public:
    explicit Block(const Settings &settings);

    /** Sets the matrix for beta = @p factor E/h and, for another matrix of the
     * kind, raises the elastic part of each node by up to @p change. */
    void set_penalty(const double factor, const double change = 0);

    /** Fixes the nodes at x = 1 conformingly, with this diagonal entry. */
    void fix_far_end(const double diagonal);

    LinearProblem<dim>  problem;
    std::vector<double> load;

  private:
    using Index = std::array<int, dim>;
    using Shape = std::array<std::pair<double, Tensor<1, dim>>, 1u << dim>;
    struct Cell
    {
      std::vector<std::pair<Point<dim>, double>> points; // with volumes
      std::vector<Point<dim>>                    boundary;
      std::array<unsigned int, 1u << dim>        nodes;
    };

    Index cell_of(const Point<dim> &x) const;
    Shape shape(const Point<dim> &x) const;
    void  fill_cells();
    void  add_boundary();
    void  build_pattern();
    void  assemble(const Cell &cell);
    void  add(BlockMatrix<dim>     &matrix,
              const Cell           &cell,
              unsigned int          row,
              unsigned int          column,
              const Tensor<2, dim> &block) const;

    const Settings        settings;
    const double          h;
    Tensor<1, dim>        normal;
    Point<dim>            origin;
    std::map<Index, Cell> cells;
    BlockMatrix<dim>      elastic, penalty;
  };

  template <int dim>
  Block<dim>::Block(const Settings &settings)
    : settings(settings)
    , h(1. / settings.cells)
  {
    const double angle = 20. * numbers::PI / 180., turn = dim == 3 ? 0.3 : 0.;
    normal[dim - 1] = std::cos(angle) * std::sin(turn);
    normal[0]       = std::cos(angle) * std::cos(turn);
    normal[1]       = std::sin(angle);
    for (unsigned int d = 0; d < dim; ++d)
      origin[d] = d == 0 ? 0.31 : 0.5;
    fill_cells();
    add_boundary();
    build_pattern();
    elastic.reinit(problem.pattern);
    penalty.reinit(problem.pattern);
    load.assign(problem.points.size() * dim, 0.);
    for (const auto &[index, cell] : cells)
      assemble(cell);
    const double unit     = std::pow(h, dim - 2);
    const auto   diagonal = diagonal_blocks(problem.pattern);
    for (unsigned int node = 0; node < diagonal.size(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        elastic.values[diagonal[node] * dim * dim + d * (dim + 1)] +=
          unit * (settings.ridge +
                  (settings.slip && problem.points[node][0] > 1 - 0.5 * h));
    set_penalty(1.);
  }

  template <int dim>
  typename Block<dim>::Index Block<dim>::cell_of(const Point<dim> &x) const
  {
    Index cell;
    for (unsigned int d = 0; d < dim; ++d)
      cell[d] = static_cast<int>(std::floor(x[d] / h));
    return cell;
  }

  template <int dim>
  typename Block<dim>::Shape Block<dim>::shape(const Point<dim> &x) const
  {
    Shape result;
    for (unsigned int corner = 0; corner < result.size(); ++corner)
      {
        auto &[value, gradient] = result[corner];
        value                   = 1;
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d] = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double xi = x[d] / h - std::floor(x[d] / h);
            const bool   up = (corner >> d) & 1;
            value *= up ? xi : 1 - xi;
            for (unsigned int e = 0; e < dim; ++e)
              gradient[e] *= e == d ? (up ? 1 : -1) / h : (up ? xi : 1 - xi);
          }
      }
    return result;
  }

  template <int dim>
  void Block<dim>::fill_cells()
  {
    std::mt19937 generator;
    const int    n = 2 * settings.cells;
    for (int i = 0; i < std::pow(n, dim); ++i)
      {
        Point<dim> x;
        for (int d = dim - 1, rest = i; d >= 0; --d, rest /= n)
          x[d] =
            (rest % n + 0.5 + 0.3 * (generator() / 4294967296. - 0.5)) * h / 2;
        const double depth = 0.9 - (x[dim - 1] + 0.2 * x[0]);
        if ((x - origin) * normal > 0 && (depth > 0 || !settings.slivers))
          cells[cell_of(x)].points.emplace_back(
            x,
            std::pow(h / 2, dim) *
              (settings.slivers && depth < 0.3 * h ? settings.thin : 1.));
      }
  }

  template <int dim>
  void Block<dim>::add_boundary()
  {
    Tensor<1, dim> across, along; // tangents; none along in 2D
    across[0] = normal[1] / std::hypot(normal[0], normal[1]);
    across[1] = -normal[0] / std::hypot(normal[0], normal[1]);
    if (dim == 3)
      along = cross_product_3d(normal, across);
    const int n = 6 * settings.cells;
    for (int i = -n; i < n; ++i)
      for (int j = dim == 3 ? -n : 0; j < (dim == 3 ? n : 1); ++j)
        {
          const Point<dim> x = origin + 1e-3 * h * normal +
                               h / 3 * ((i + 0.5) * across + (j + 0.5) * along);
          const auto cell = cells.find(cell_of(x));
          if (cell != cells.end())
            cell->second.boundary.push_back(x);
        }
  }

  template <int dim>
  void Block<dim>::build_pattern()
  {
    std::map<Index, unsigned int> nodes;
    if (settings.lattice)
      problem.lines.assign(dim, SplineLine(1, settings.cells));
    const auto corner_of = [](Index index, const unsigned int corner) {
      for (unsigned int d = 0; d < dim; ++d)
        index[d] += (corner >> d) & 1;
      return index;
    };
    for (const auto &[index, cell] : cells)
      for (unsigned int corner = 0; corner < cell.nodes.size(); ++corner)
        nodes[corner_of(index, corner)] = 0;
    for (auto &[index, number] : nodes)
      {
        number = problem.points.size();
        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = index[d] * h;
        problem.points.push_back(x);
        if (settings.lattice)
          problem.lattice.push_back(index);
      }
    problem.enforced.assign(nodes.size(), false);

    std::vector<std::set<unsigned int>> neighbours(nodes.size());
    for (auto &[index, cell] : cells)
      {
        for (unsigned int corner = 0; corner < cell.nodes.size(); ++corner)
          cell.nodes[corner] = nodes.at(corner_of(index, corner));
        for (const unsigned int node : cell.nodes)
          {
            neighbours[node].insert(cell.nodes.begin(), cell.nodes.end());
            if (!cell.boundary.empty())
              problem.enforced[node] = true;
          }
      }
    problem.pattern.row_start.assign(1, 0);
    for (const std::set<unsigned int> &row : neighbours)
      {
        problem.pattern.columns.insert(problem.pattern.columns.end(),
                                       row.begin(),
                                       row.end());
        problem.pattern.row_start.push_back(problem.pattern.columns.size());
      }
  }

  template <int dim>
  void Block<dim>::add(BlockMatrix<dim>     &matrix,
                       const Cell           &cell,
                       const unsigned int    row,
                       const unsigned int    column,
                       const Tensor<2, dim> &block) const
  {
    const auto begin = problem.pattern.columns.begin() +
                       problem.pattern.row_start[cell.nodes[row]];
    const auto end = problem.pattern.columns.begin() +
                     problem.pattern.row_start[cell.nodes[row] + 1];
    const std::size_t position =
      std::lower_bound(begin, end, cell.nodes[column]) -
      problem.pattern.columns.begin();
    for (unsigned int i = 0; i < dim * dim; ++i)
      matrix.values[position * dim * dim + i] += block[i / dim][i % dim];
  }

  template <int dim>
  void Block<dim>::assemble(const Cell &cell)
  {
    const double         lambda = 0.3 / (1.3 * 0.4), mu = 1 / 2.6;
    const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
    for (const auto &[x, volume] : cell.points)
      {
        const Shape N = shape(x);
        for (unsigned int i = 0; i < N.size(); ++i)
          {
            load[cell.nodes[i] * dim + dim - 1] -= volume * N[i].first;
            for (unsigned int j = 0; j < N.size(); ++j)
              {
                const Tensor<1, dim> &a = N[i].second, &b = N[j].second;
                add(elastic,
                    cell,
                    i,
                    j,
                    volume *
                      (lambda * outer_product(a, b) + mu * outer_product(b, a) +
                       mu * (a * b) * identity));
              }
          }
      }
    if (cell.boundary.empty())
      return;
    const double                  area = std::pow(h / 3, dim - 1);
    std::array<double, 1u << dim> mean = {};
    for (const Point<dim> &x : cell.boundary)
      for (unsigned int i = 0; i < mean.size(); ++i)
        mean[i] += shape(x)[i].first / cell.boundary.size();
    const Tensor<2, dim> held =
      settings.slip ? outer_product(normal, normal) : identity;
    for (unsigned int i = 0; i < mean.size(); ++i)
      for (unsigned int j = 0; j < mean.size(); ++j)
        add(penalty,
            cell,
            i,
            j,
            area * cell.boundary.size() / h * mean[i] * mean[j] * held);
  }

  template <int dim>
  void Block<dim>::set_penalty(const double factor, const double change)
  {
    problem.has_moderate = true;
    problem.matrix       = elastic;
    const auto raise     = [&](const unsigned int node) {
      return 1 + change * (node % 7) / 6.;
    };
    for (unsigned int row = 0; row < problem.points.size(); ++row)
      for (std::size_t k = problem.pattern.row_start[row];
           k < problem.pattern.row_start[row + 1];
           ++k)
        for (unsigned int i = 0; i < dim * dim; ++i)
          problem.matrix.values[k * dim * dim + i] *=
            raise(row) * raise(problem.pattern.columns[k]);
    problem.moderate = problem.matrix;
    for (std::size_t i = 0; i < penalty.values.size(); ++i)
      {
        problem.matrix.values[i] += factor * penalty.values[i];
        problem.moderate.values[i] += 10. * penalty.values[i];
      }
  }

  template <int dim>
  void Block<dim>::fix_far_end(const double diagonal)
  {
    const auto fixed = [&](const unsigned int node) {
      return problem.points[node][0] > 1 - 0.5 * h;
    };
    for (unsigned int row = 0; row < problem.points.size(); ++row)
      for (std::size_t k = problem.pattern.row_start[row];
           k < problem.pattern.row_start[row + 1];
           ++k)
        if (fixed(row) || fixed(problem.pattern.columns[k]))
          for (unsigned int i = 0; i < dim * dim; ++i)
            problem.matrix.values[k * dim * dim + i] =
              problem.moderate.values[k * dim * dim + i] =
                row == problem.pattern.columns[k] && i % (dim + 1) == 0 ?
                  diagonal :
                  0.;
  }

  /** A linear solver at work on a problem. */
  template <int dim>
  struct Run
  {
    Run(const std::string &kind, const LinearProblem<dim> &problem)
      : parameters{kind}
      , solver(parameters, counters)
      , problem(problem)
    {
      solver.new_pattern(problem);
      solver.new_matrix(problem);
    }

    const std::vector<double> &solve(const std::vector<double> &b)
    {
      solver.solve(problem, b, x);
      return x;
    }

    LinearSolverParameters    parameters;
    Counters                  counters;
    LinearSolver<dim>         solver;
    const LinearProblem<dim> &problem;
    std::vector<double>       x;
  };

  inline void check(const std::string &what, const bool passed)
  {
    std::cout << "  " << what << ": " << (passed ? "yes" : "no") << std::endl;
  }

  /** Relative distance in the energy norm of the matrix. */
  template <int dim>
  double distance(const BlockMatrix<dim>    &A,
                  std::vector<double>        x,
                  const std::vector<double> &y)
  {
    const auto energy = [&A](const std::vector<double> &u) {
      std::vector<double> f(u.size());
      A.vmult(u.data(), f.data());
      double sum = 0;
      for (std::size_t i = 0; i < u.size(); ++i)
        sum += u[i] * f[i];
      return sum;
    };
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] -= y[i];
    return std::sqrt(std::abs(energy(x)) / energy(y));
  }
} // namespace ModelProblem

#endif
