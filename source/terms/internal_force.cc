#include <impoint/grid/support_size.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    template <int dim>
    constexpr int voigt_index(const int i, const int j)
    {
      if constexpr (dim == 2)
        return i == j ? i : 2;
      else
        return i == j ? i : i + j + 2;
    }

    /** grad u = sum_a u_a x G_a (at the places of the supports). */
    template <int dim>
    Tensor<2, dim>
    displacement_gradient(const int n, const double *u, const double *gradients)
    {
      Tensor<2, dim> grad_u;
      for (int a = 0; a < n; ++a)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            grad_u[i][j] += u[a * dim + i] * gradients[a * dim + j];
      return grad_u;
    }

    /** Gradients at the end of the step: G_a f^-1. */
    template <int dim>
    void push_forward(const int             n,
                      const Tensor<2, dim> &f,
                      const double         *start,
                      double               *end)
    {
      const Tensor<2, dim> inverse = invert(f);
      for (int a = 0; a < n; ++a)
        for (int j = 0; j < dim; ++j)
          {
            double sum = 0;
            for (int i = 0; i < dim; ++i)
              sum += start[a * dim + i] * inverse[i][j];
            end[a * dim + j] = sum;
          }
    }

    /** r_a += V B_a^T tau */
    template <int dim>
    void add_force(const int               n,
                   const double            volume,
                   const VoigtVector<dim> &stress,
                   const double           *gradients,
                   double                 *residual)
    {
      for (int a = 0; a < n; ++a)
        for (int i = 0; i < dim; ++i)
          {
            double sum = 0;
            for (int j = 0; j < dim; ++j)
              sum += stress[voigt_index<dim>(i, j)] * gradients[a * dim + j];
            residual[a * dim + i] += volume * sum;
          }
    }

    /** K_ab += V B_a^T c B_b, for b >= a only if c is symmetric, and the
     * geometric part g_ab += V g_a . tau g_b, b >= a. */
    template <int dim, bool symmetric>
    void add_stiffness(const int                       n,
                       const double                    volume,
                       const Materials::Response<dim> &response,
                       const bool                      geometric,
                       const double                   *gradients,
                       double                         *blocks,
                       double                         *diagonal)
    {
      constexpr int n_v = Voigt<dim>::n;
      double        stress_column[dim]; // V tau g_b
      double        columns[n_v * dim]; // V c B_b

      // a copy that the compiler knows the writes below not to change
      const VoigtMatrix<dim> tangent = response.tangent;
      for (int b = 0; b < n; ++b)
        {
          const double *g = gradients + b * dim;
          for (int k = 0; k < n_v; ++k)
            for (int j = 0; j < dim; ++j)
              {
                double sum = 0;
                for (int l = 0; l < dim; ++l)
                  sum += tangent[k * n_v + voigt_index<dim>(j, l)] * g[l];
                columns[k * dim + j] = volume * sum;
              }
          for (int i = 0; i < dim; ++i)
            {
              stress_column[i] = 0;
              for (int j = 0; j < dim; ++j)
                stress_column[i] +=
                  volume * response.stress[voigt_index<dim>(i, j)] * g[j];
            }
          for (int a = 0; a < (symmetric ? b + 1 : n); ++a)
            {
              const double *h     = gradients + a * dim;
              double       *block = blocks + (a * n + b) * dim * dim;
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  {
                    double sum = 0;
                    for (int l = 0; l < dim; ++l)
                      sum += h[l] * columns[voigt_index<dim>(i, l) * dim + j];
                    block[i * dim + j] += sum;
                  }
              if (geometric && a <= b)
                {
                  double sum = 0;
                  for (int i = 0; i < dim; ++i)
                    sum += h[i] * stress_column[i];
                  diagonal[a * n + b] += sum;
                }
            }
        }
    }

    /** Adds up a cell's matrix: blocks, of which the upper ones may stand for
     * all, and diagonal parts, of which the upper ones do. */
    template <int dim, bool symmetric>
    void complete(const int     n,
                  const double *blocks,
                  const double *diagonal,
                  double       *matrix)
    {
      for (int b = 0; b < n; ++b)
        for (int a = 0; a <= b; ++a)
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              {
                const int    upper     = (a * n + b) * dim * dim + i * dim + j;
                const int    lower     = (b * n + a) * dim * dim + j * dim + i;
                const double geometric = i == j ? diagonal[a * n + b] : 0.;
                matrix[upper] += blocks[upper] + geometric;
                if (a != b)
                  matrix[lower] +=
                    blocks[symmetric ? upper : lower] + geometric;
              }
    }
  } // namespace



  template <int dim>
  InternalForce<dim>::InternalForce(const MaterialPoints<dim> &points,
                                    EndStates<dim>            *end_states)
    : points(points)
    , end_states(end_states)
  {}



  template <int dim>
  void InternalForce<dim>::add(const unsigned int k, CellSystem &system) const
  {
    const bool constant = system.matrix != nullptr && one_constant_tangent(k);
    with_support_size<dim>(system.n, [&](const auto n_static) {
      if (constant)
        add_constant<n_static>(k, system);
      else if (points.symmetric_tangent())
        add_cell<n_static, true>(k, system);
      else
        add_cell<n_static, false>(k, system);
    });
  }



  template <int dim>
  bool InternalForce<dim>::one_constant_tangent(const unsigned int k) const
  {
    const auto &range = points.ranges()[k];
    if (!points.material(range.begin).constant_tangent())
      return false;
    for (unsigned int p = range.begin + 1; p < range.end; ++p)
      if (points.body(p) != points.body(range.begin))
        return false;
    return true;
  }



  template <int dim>
  void InternalForce<dim>::respond(const unsigned int           p,
                                   const Tensor<2, dim>        &grad_u,
                                   const bool                   tangent_wanted,
                                   Materials::Deformation<dim> &deformation,
                                   Materials::Response<dim>    &response) const
  {
    double        unused[Materials::max_history];
    double *const end = end_states != nullptr ? end_states->data(p) : nullptr;
    points.respond(p,
                   grad_u,
                   tangent_wanted,
                   deformation,
                   response,
                   end != nullptr ? end + EndStates<dim>::n_fixed : unused);
    if (end != nullptr)
      EndStates<dim>::store(deformation, response, end);
  }



  template <int dim>
  template <int n_static, bool symmetric>
  void InternalForce<dim>::add_cell(const unsigned int k,
                                    CellSystem        &system) const
  {
    constexpr int size = array_size<n_static>;
    const int     n    = n_static > 0 ? n_static : system.n;
    double        blocks[size * size * dim * dim], diagonal[size * size];
    if (system.matrix)
      {
        std::fill(blocks, blocks + n * n * dim * dim, 0.);
        std::fill(diagonal, diagonal + n * n, 0.);
      }

    double                      pushed[size * dim];
    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    const auto                 &range = points.ranges()[k];
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        const double        *gradients = points.support(p) + n;
        const Tensor<2, dim> grad_u =
          displacement_gradient<dim>(n, system.u, gradients);
        respond(p, grad_u, system.matrix != nullptr, deformation, response);
        const bool finite = !points.material(p).small_strain();
        if (finite)
          {
            push_forward<dim>(n,
                              points.map_of_supports(deformation),
                              gradients,
                              pushed);
            gradients = pushed;
          }
        const double volume = points.data(p)[points.slots().volume];
        add_force<dim>(n, volume, response.stress, gradients, system.residual);
        if (system.matrix)
          add_stiffness<dim, symmetric>(
            n, volume, response, finite, gradients, blocks, diagonal);
      }
    if (system.matrix)
      complete<dim, symmetric>(n, blocks, diagonal, system.matrix);
  }



  /** One small-strain material with the same tangent c everywhere: the points
   * contribute M_ab = sum V g_a x g_b only, and K_ab,ij = c_ikjl M_ab,kl once a
   * cell. */
  template <int dim>
  template <int n_static>
  void InternalForce<dim>::add_constant(const unsigned int k,
                                        CellSystem        &system) const
  {
    constexpr int size = array_size<n_static>;
    const int     n    = n_static > 0 ? n_static : system.n;
    double        moments[size * size * dim * dim];
    std::fill(moments, moments + n * n * dim * dim, 0.);

    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    const auto                 &range = points.ranges()[k];
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        const double *gradients = points.support(p) + n;
        const double  volume    = points.data(p)[points.slots().volume];
        respond(p,
                displacement_gradient<dim>(n, system.u, gradients),
                p == range.begin,
                deformation,
                response);
        add_force<dim>(n, volume, response.stress, gradients, system.residual);
        for (int a = 0; a < n; ++a)
          for (int i = 0; i < dim; ++i)
            {
              const double weighted = volume * gradients[a * dim + i];
              double      *row      = moments + (a * dim + i) * n * dim;
              for (int bj = a * dim; bj < n * dim; ++bj)
                row[bj] += weighted * gradients[bj];
            }
      }

    constexpr int          n_v     = Voigt<dim>::n;
    const VoigtMatrix<dim> tangent = response.tangent;
    for (int a = 0; a < n; ++a)
      for (int b = a; b < n; ++b)
        {
          const double *M = moments + a * dim * n * dim + b * dim;
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              {
                double sum = 0;
                for (int r = 0; r < dim; ++r)
                  for (int s = 0; s < dim; ++s)
                    sum += tangent[voigt_index<dim>(i, r) * n_v +
                                   voigt_index<dim>(j, s)] *
                           M[r * n * dim + s];
                system.matrix[(a * n + b) * dim * dim + i * dim + j] += sum;
                if (a != b)
                  system.matrix[(b * n + a) * dim * dim + j * dim + i] += sum;
              }
        }
  }

  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace Impoint
