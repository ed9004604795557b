#include <impoint/base/exceptions.h>
#include <impoint/solver/conjugate_gradients.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    /** Of the first @p n entries on each rank. */
    double dot_product(const std::vector<double> &a,
                       const std::vector<double> &b,
                       const std::size_t          n,
                       const MPI_Comm             comm)
    {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
      return Utilities::MPI::sum(sum, comm);
    }

    /** Also catches NaN, which compares false. */
    void require_positive(const double value, const std::string &meaning)
    {
      if (!(value > 0) || !std::isfinite(value))
        throw StepFailed(
          "The linear system is not positive definite: conjugate gradients met " +
          meaning + " = " + std::to_string(value) +
          ". A body without sufficient supports, a material that softens, or "
          "values that are not finite bring this about.");
    }

    /** Whether the mean rate so far will not reach the tolerance within the
     * iterations allowed: with a margin for the pace picking up, which is the
     * smaller the more iterations have shown it. */
    bool hopeless(const IterationControl &control,
                  const IterationResult  &result)
    {
      constexpr unsigned int probation = 3;
      if (!control.give_up_early || result.iterations < probation)
        return false;
      if (result.reduction >= 1)
        return true;
      const double expected = result.iterations * std::log(control.tolerance) /
                              std::log(result.reduction);
      return expected > (1. + 1. / result.iterations) * control.max_iterations;
    }

    /** r -= q = A x */
    template <int dim>
    void subtract_product(const BlockMatrix<dim> &matrix,
                          const NodeExchange     &nodes,
                          std::vector<double>    &x,
                          std::vector<double>    &q,
                          std::vector<double>    &r)
    {
      nodes.update(x);
      matrix.vmult(x.data(), q.data());
      for (std::size_t i = 0; i < q.size(); ++i)
        r[i] -= q[i];
    }
  } // namespace

  template <int dim>
  IterationResult conjugate_gradients(const BlockMatrix<dim>    &matrix,
                                      const NodeExchange        &nodes,
                                      const Preconditioner      &preconditioner,
                                      const std::vector<double> &b,
                                      const IterationControl    &control,
                                      std::vector<double>       &x)
  {
    const std::size_t n       = b.size();
    const std::size_t n_local = n + std::size_t(nodes.n_ghosts()) * dim;
    const auto        dot     = [&](const std::vector<double> &a,
                         const std::vector<double> &c) {
      return dot_product(a, c, n, nodes.communicator());
    };
    IterationResult     result;
    std::vector<double> r = b, z(n_local), q(n);
    r.resize(n_local);
    x.assign(n_local, 0.);

    const auto nothing_to_do = [&]() {
      result.converged = true;
      result.reduction = 0;
      x.assign(n, 0.);
      return result;
    };
    if (dot(b, b) == 0)
      return nothing_to_do();

    const bool   started = preconditioner.start(b, x);
    const double solved  = started ? dot(b, x) : 0.;
    if (started)
      {
        subtract_product(matrix, nodes, x, q, r);
        preconditioner.clear(r);
      }
    preconditioner.vmult(r, z);
    std::vector<double> p       = z;
    double              r_dot_z = dot(r, z);
    const double        initial = solved + r_dot_z; // b . M b
    require_positive(initial, "r . M r");
    result.start           = std::sqrt(initial);
    const double reference = std::max(result.start, control.reference);
    const double enough    = control.tolerance * reference;
    if (result.start <= enough)
      return nothing_to_do();
    result.converged = std::sqrt(std::abs(r_dot_z)) <= enough;

    while (!result.converged && result.iterations < control.max_iterations &&
           !hopeless(control, result))
      {
        nodes.update(p);
        matrix.vmult(p.data(), q.data());
        const double p_dot_q = dot(p, q);
        require_positive(p_dot_q, "p . A p");

        const double alpha = r_dot_z / p_dot_q;
        for (std::size_t i = 0; i < n; ++i)
          {
            x[i] += alpha * p[i];
            r[i] -= alpha * q[i];
          }
        ++result.iterations;

        if (started)
          preconditioner.clear(r);
        preconditioner.vmult(r, z);
        const double previous = r_dot_z;
        r_dot_z               = dot(r, z);
        // at round-off the product may have either sign
        result.reduction = std::sqrt(std::abs(r_dot_z)) / reference;
        result.converged = result.reduction <= control.tolerance;
        if (result.converged)
          break;
        require_positive(r_dot_z, "r . M r");

        const double beta = r_dot_z / previous;
        for (std::size_t i = 0; i < n; ++i)
          p[i] = z[i] + beta * p[i];
      }
    if (started)
      {
        nodes.update(x);
        preconditioner.finish(b, x);
      }
    x.resize(n);
    return result;
  }

  template IterationResult conjugate_gradients<2>(const BlockMatrix<2> &,
                                                  const NodeExchange &,
                                                  const Preconditioner &,
                                                  const std::vector<double> &,
                                                  const IterationControl &,
                                                  std::vector<double> &);
  template IterationResult conjugate_gradients<3>(const BlockMatrix<3> &,
                                                  const NodeExchange &,
                                                  const Preconditioner &,
                                                  const std::vector<double> &,
                                                  const IterationControl &,
                                                  std::vector<double> &);
} // namespace Impoint
