#include <impoint/grid/support_size.h>
#include <impoint/terms/internal_force.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    // Loops over nodes that are not unrolled (the pragmas below) become vector
    // instructions; unrolled ones do not.

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
    DEAL_II_ALWAYS_INLINE inline Tensor<2, dim>
    displacement_gradient(const int n, const double *u, const double *gradients)
    {
      Tensor<2, dim> grad_u;
      for (int a = 0; a < n; ++a)
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            grad_u[i][j] += u[a * dim + i] * gradients[a * dim + j];
      return grad_u;
    }

    /** The gradients dN_a/dx_d of a support at [d * n + a]: the kernels below
     * go over all nodes at once. */
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void
    by_component(const int n, const double *gradients, double *g)
    {
      for (int d = 0; d < dim; ++d)
        for (int a = 0; a < n; ++a)
          g[d * n + a] = gradients[a * dim + d];
    }

    /** The same at the end of the step: G_a f^-1. */
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void push_forward(const int             n,
                                                   const Tensor<2, dim> &f,
                                                   const double *gradients,
                                                   double       *g)
    {
      const Tensor<2, dim> inverse = invert(f);
      for (int d = 0; d < dim; ++d)
        for (int a = 0; a < n; ++a)
          {
            double sum = 0;
            for (int i = 0; i < dim; ++i)
              sum += gradients[a * dim + i] * inverse[i][d];
            g[d * n + a] = sum;
          }
    }

    /** r_a += V B_a^T tau */
    template <int dim>
    DEAL_II_ALWAYS_INLINE inline void add_force(const int               n,
                                                const double            volume,
                                                const VoigtVector<dim> &stress,
                                                const double           *g,
                                                double *residual)
    {
      for (int i = 0; i < dim; ++i)
        for (int a = 0; a < n; ++a)
          {
            double sum = 0;
            for (int j = 0; j < dim; ++j)
              sum += stress[voigt_index<dim>(i, j)] * g[j * n + a];
            residual[a * dim + i] += volume * sum;
          }
    }

    /** K_ij,ab += V (B_a^T c B_b + (g_a . tau g_b) 1)_ij, the latter if @p
     * geometric; for j >= i only if c is symmetric. */
    template <int dim, int size, bool symmetric>
    DEAL_II_ALWAYS_INLINE inline void
    add_stiffness(const int                       n,
                  const double                    volume,
                  const Materials::Response<dim> &response,
                  const bool                      geometric,
                  const double                   *g,
                  double                         *K)
    {
      // copies that the compiler knows the writes below not to change
      const VoigtMatrix<dim> tangent = response.tangent;
      const VoigtVector<dim> stress  = response.stress;
      double                 factors[dim * size]; // of g_a
      for (int i = 0; i < dim; ++i)
        for (int j = symmetric ? i : 0; j < dim; ++j)
          {
            for (int k = 0; k < dim; ++k)
              {
                double c[dim];
                for (int l = 0; l < dim; ++l)
                  c[l] =
                    volume *
                    (tangent[voigt_index<dim>(i, k) * Voigt<dim>::n +
                             voigt_index<dim>(j, l)] +
                     (geometric && i == j ? stress[voigt_index<dim>(k, l)] :
                                            0.));
#pragma GCC unroll 1
                for (int b = 0; b < n; ++b)
                  {
                    double sum = 0;
                    for (int l = 0; l < dim; ++l)
                      sum += c[l] * g[l * n + b];
                    factors[k * n + b] = sum;
                  }
              }
            double *K_ij = K + (i * dim + j) * n * n;
            for (int a = 0; a < n; ++a)
              {
                double *row = K_ij + a * n;
#pragma GCC unroll 1
                for (int b = 0; b < n; ++b)
                  {
                    double sum = row[b];
                    for (int k = 0; k < dim; ++k)
                      sum += g[k * n + a] * factors[k * n + b];
                    row[b] = sum;
                  }
              }
          }
    }

    /** Adds K_ij,ab, of which j >= i may stand for all, to the cell's matrix.
     */
    template <int dim, bool symmetric>
    DEAL_II_ALWAYS_INLINE inline void
    add_blocks(const int n, const double *K, double *matrix)
    {
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < n; ++b)
          for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
              *matrix++ += symmetric && j < i ?
                             K[((j * dim + i) * n + b) * n + a] :
                             K[((i * dim + j) * n + a) * n + b];
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



  /** The place at the end of the step of a point with the n shape values of
   * its support. */
  template <int dim>
  DEAL_II_ALWAYS_INLINE inline void
  InternalForce<dim>::store_place(const unsigned int p,
                                  const int          n,
                                  const double      *u) const
  {
    const double *N = points.support(p), *x = points.data(p);
    double        displacement[dim] = {};
    for (int a = 0; a < n; ++a)
      for (int d = 0; d < dim; ++d)
        displacement[d] += N[a] * u[a * dim + d];
    for (int d = 0; d < dim; ++d)
      end_states->places[p][d] = x[d] + displacement[d];
  }



  template <int dim>
  template <int n_static, bool symmetric>
  void InternalForce<dim>::add_cell(const unsigned int k,
                                    CellSystem        &system) const
  {
    constexpr int size = array_size<n_static>;
    const int     n    = n_static > 0 ? n_static : system.n;
    double        K[size * size * dim * dim];
    if (system.matrix)
      std::fill(K, K + n * n * dim * dim, 0.);

    double                      g[size * dim];
    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    const auto                 &range = points.ranges()[k];
    const bool keeps_ends = end_states != nullptr && end_states->are_kept();
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        points.prefetch_after(p);
        const double        *gradients = points.support(p) + n;
        const Tensor<2, dim> grad_u =
          displacement_gradient<dim>(n, system.u, gradients);
        respond(p, grad_u, system.matrix != nullptr, deformation, response);
        if (keeps_ends)
          store_place(p, n, system.u);
        const bool finite = !points.material(p).small_strain();
        if (finite)
          push_forward<dim>(n,
                            points.map_of_supports(deformation),
                            gradients,
                            g);
        else
          by_component<dim>(n, gradients, g);
        const double volume = points.data(p)[points.slots().volume];
        add_force<dim>(n, volume, response.stress, g, system.residual);
        if (system.matrix)
          add_stiffness<dim, size, symmetric>(
            n, volume, response, finite, g, K);
      }
    if (system.matrix)
      add_blocks<dim, symmetric>(n, K, system.matrix);
  }



  /** One small-strain material with the same tangent c everywhere: the points
   * contribute M_kl,ab = sum V g_a,k g_b,l only (l >= k stand for all), and
   * K_ij,ab = c_ikjl M_kl,ab once a cell. */
  template <int dim>
  template <int n_static>
  void InternalForce<dim>::add_constant(const unsigned int k,
                                        CellSystem        &system) const
  {
    constexpr int size = array_size<n_static>;
    const int     n    = n_static > 0 ? n_static : system.n;
    double        moments[size * size * dim * dim];
    std::fill(moments, moments + n * n * dim * dim, 0.);

    double                      g[size * dim];
    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    const auto                 &range = points.ranges()[k];
    const bool keeps_ends = end_states != nullptr && end_states->are_kept();
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        points.prefetch_after(p);
        const double *gradients = points.support(p) + n;
        const double  volume    = points.data(p)[points.slots().volume];
        respond(p,
                displacement_gradient<dim>(n, system.u, gradients),
                p == range.begin,
                deformation,
                response);
        if (keeps_ends)
          store_place(p, n, system.u);
        by_component<dim>(n, gradients, g);
        add_force<dim>(n, volume, response.stress, g, system.residual);
        for (int d = 0; d < dim; ++d)
          for (int e = d; e < dim; ++e)
            for (int a = 0; a < n; ++a)
              {
                const double weighted = volume * g[d * n + a];
                double      *row      = moments + ((d * dim + e) * n + a) * n;
#pragma GCC unroll 1
                for (int b = 0; b < n; ++b)
                  row[b] += weighted * g[e * n + b];
              }
      }
    for (int d = 0; d < dim; ++d)
      for (int e = 0; e < d; ++e)
        for (int a = 0; a < n; ++a)
          for (int b = 0; b < n; ++b)
            moments[((d * dim + e) * n + a) * n + b] =
              moments[((e * dim + d) * n + b) * n + a];

    double                 K[size * size * dim * dim];
    const VoigtMatrix<dim> tangent = response.tangent;
    std::fill(K, K + n * n * dim * dim, 0.);
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        for (int d = 0; d < dim; ++d)
          for (int e = 0; e < dim; ++e)
            {
              const double  c = tangent[voigt_index<dim>(i, d) * Voigt<dim>::n +
                                       voigt_index<dim>(j, e)];
              const double *M = moments + (d * dim + e) * n * n;
              double       *K_ij = K + (i * dim + j) * n * n;
              if (c != 0)
#pragma GCC unroll 1
                for (int ab = 0; ab < n * n; ++ab)
                  K_ij[ab] += c * M[ab];
            }
    add_blocks<dim, true>(n, K, system.matrix);
  }

  template class InternalForce<2>;
  template class InternalForce<3>;
} // namespace Impoint
