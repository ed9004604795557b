#include <impoint/base/scoped_seconds.h>
#include <impoint/solver/held_nodes.h>
#include <impoint/solver/nonlinear_system.h>
#include <impoint/solver/spectrum.h>

#include <cmath>

namespace Impoint
{
  namespace
  {
    using Vector = LinearAlgebra::distributed::Vector<double>;

    /** Roots of the diagonal entries, each of which the ranks have parts of. */
    template <int dim>
    Vector roots_of_diagonal(const ActiveNodes<dim>   &active,
                             const LinearProblem<dim> &problem)
    {
      Vector     roots(active.unknowns());
      const auto blocks = diagonal_blocks(problem.pattern);
      for (unsigned int i = 0; i < blocks.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          roots.local_element(i * dim + d) =
            problem.matrix.values[(blocks[i] * dim + d) * dim + d];
      roots.compress(VectorOperation::add);
      for (double &value : roots)
        value = std::sqrt(value);
      return roots;
    }



    /** Like nothing that a grid's symmetries could hide. */
    template <int dim>
    Vector irregular(const ActiveNodes<dim> &active)
    {
      Vector start(active.unknowns());
      for (unsigned int i = 0; i < start.locally_owned_size(); ++i)
        start.local_element(i) =
          1.5 + std::sin(1. + start.get_partitioner()->local_to_global(i));
      return start;
    }
  } // namespace



  template <int dim>
  ConditionNumbers NonlinearSystem<dim>::condition_numbers()
  {
    ConditionNumbers numbers;
    if (problem.matrix.values.empty() || !problem.symmetric)
      return numbers;
    ScopedSeconds  timer(seconds.solve);
    const Counters counters_before = counters; // what is measured counts not
    prepare_solver();
    Vector     right(active.unknowns());
    const auto multiply = [&](const Vector &x, Vector &y) {
      right = x;
      right.update_ghost_values();
      y = 0.;
      problem.matrix.vmult(right.begin(), y.begin());
      y.compress(VectorOperation::add);
    };
    const auto divide = [&](const Vector &x, Vector &y) {
      right = x;
      right.update_ghost_values();
      solve(right, 1., y);
    };
    const auto free_part = [&](Vector &x) {
      x.update_ghost_values();
      cut(held, false, x);
      x.zero_out_ghost_values();
    };
    Vector start = irregular(active);
    free_part(start);
    const auto largest = [&](const auto &apply, const Vector *factors) {
      return largest_eigenvalue(
        [&](const Vector &x, Vector &y) {
          Vector scaled(x);
          if (factors != nullptr)
            scaled.scale(*factors);
          apply(scaled, y);
          if (factors != nullptr)
            y.scale(*factors);
          free_part(y);
        },
        start);
    };
    const Vector roots = roots_of_diagonal(active, problem);
    Vector       inverse(roots);
    for (double &value : inverse)
      value = 1. / value;
    try
      {
        numbers.whole  = largest(multiply, nullptr) * largest(divide, nullptr);
        numbers.scaled = largest(multiply, &inverse) * largest(divide, &roots);
      }
    catch (const StepFailed &)
      {
        // what cannot be solved with has none; the step itself was solved
        numbers = {};
      }
    counters = counters_before;
    return numbers;
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
