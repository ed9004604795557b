#include <impoint/grid/support_size.h>
#include <impoint/solver/motion.h>

#include <algorithm>
#include <array>

namespace Impoint
{
  using NodalVector = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    /** The vectors of nodes, with @p n_before numbers before each and @p m in
     * all. */
    template <int dim, int m = dim>
    void gather_at(const ArrayView<const unsigned int> nodes,
                   const double                       *local,
                   std::vector<double>                &values,
                   const unsigned int                  n_before = 0)
    {
      values.resize(nodes.size() * m);
      for (unsigned int a = 0; a < nodes.size(); ++a)
        for (unsigned int d = 0; d < dim; ++d)
          values[a * m + n_before + d] = local[nodes[a] * dim + d];
    }

    /** At the end of the step, of the active nodes and ghosts. */
    template <int dim>
    std::vector<double> nodal_accelerations(const ActiveNodes<dim> &active,
                                            const NodalVector      &u,
                                            const Inertia<dim>     &inertia)
    {
      std::vector<double> values(active.n_nodes() * dim);
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] = inertia.acceleration(i, u.local_element(i));
      return values;
    }

    /** sum_a N_a u_a; the @p m numbers u_a stand next to each other. */
    template <int m, int n_static>
    DEAL_II_ALWAYS_INLINE inline std::array<double, m>
    interpolate(const unsigned int n_nodes, const double *N, const double *u)
    {
      const unsigned int    n = n_static > 0 ? n_static : n_nodes;
      std::array<double, m> value{};
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < m; ++d)
          value[d] += N[a] * u[a * m + d];
      return value;
    }

    /** sum_a u_a x G_a */
    template <int dim, int n_static>
    inline Tensor<2, dim> interpolate_gradient(const unsigned int n_nodes,
                                               const double      *G,
                                               const double      *u,
                                               const unsigned int stride)
    {
      const unsigned int n = n_static > 0 ? n_static : n_nodes;
      Tensor<2, dim>     gradient;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            gradient[i][j] += u[a * stride + i] * G[a * dim + j];
      return gradient;
    }

    /** The points' state after the step, for those of one cell at a time. */
    template <int dim>
    class CellUpdate
    {
    public:
      CellUpdate(MaterialPoints<dim>  &points,
                 const Inertia<dim>   *inertia,
                 const EndStates<dim> &end_states)
        : points(points)
        , slots(points.slots())
        , inertia(inertia)
        , filtered_part(inertia != nullptr ? inertia->filtered_part() : 0.)
        , end_states(end_states)
        , own_end_state(EndStates<dim>::n_fixed + points.carried().n_history)
      {}

      /** @p motion: the displacement of each of the cell's nodes and, if m is
       * more than dim, its acceleration; @p seen: the velocities that they saw
       * at the start, or null. */
      template <int m, int n_static>
      void run(const typename PointCloud<dim>::Range &range,
               const unsigned int                     n,
               const double                          *motion,
               const double                          *seen)
      {
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            points.prefetch_after(p);
            const double *N    = points.support(p);
            const auto    here = interpolate<m, n_static>(n, N, motion);
            displace(p, here.data());
            if (const double *end_state = end_states.data(p))
              points.set_end_state(p, end_state);
            else
              deform(p,
                     interpolate_gradient<dim, n_static>(n, N + n, motion, m));
            if (seen != nullptr)
              filter(p, interpolate<dim, n_static>(n, N, seen).data());
            if constexpr (m > dim)
              accelerate(p, here.data() + dim);
          }
      }

    private:
      void displace(const unsigned int p, const double *u)
      {
        double *state = points.data(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            state[slots.x + d] += u[d];
            state[slots.u + d] += u[d];
          }
      }

      void deform(const unsigned int p, const Tensor<2, dim> &grad_u)
      {
        points.respond(p,
                       grad_u,
                       false,
                       deformation,
                       response,
                       own_end_state.data() + EndStates<dim>::n_fixed);
        EndStates<dim>::store(deformation, response, own_end_state.data());
        points.set_end_state(p, own_end_state.data());
      }

      /** Takes the filtered part of what the grid doesn't see of the velocity.
       */
      void filter(const unsigned int p, const double *seen)
      {
        double *state = points.data(p);
        for (unsigned int d = 0; d < dim; ++d)
          state[slots.v + d] -= filtered_part * (state[slots.v + d] - seen[d]);
      }

      void accelerate(const unsigned int p, const double *a)
      {
        double *state = points.data(p);
        for (unsigned int d = 0; d < dim; ++d)
          {
            state[slots.v + d] = inertia->new_velocity(state[slots.v + d],
                                                       state[slots.a + d],
                                                       a[d]);
            state[slots.a + d] = a[d];
          }
      }

      MaterialPoints<dim>                       &points;
      const typename MaterialPoints<dim>::Slots &slots;
      const Inertia<dim>                        *inertia;
      const double                               filtered_part;
      const EndStates<dim>                      &end_states;
      Materials::Deformation<dim>                deformation;
      Materials::Response<dim>                   response;
      std::vector<double>                        own_end_state;
    };
  } // namespace



  template <int dim>
  void new_places(const MaterialPoints<dim> &points,
                  const ActiveNodes<dim>    &active,
                  const NodalVector         &u,
                  std::vector<Point<dim>>   &places)
  {
    std::vector<double> cell_u;
    places.resize(points.n());
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points.ranges()[k];
        gather_at<dim>(nodes, u.begin(), cell_u);
        with_support_size<dim>(nodes.size(), [&](const auto n_static) {
          for (unsigned int p = range.begin; p < range.end; ++p)
            {
              const auto    u = interpolate<dim, n_static>(nodes.size(),
                                                        points.support(p),
                                                        cell_u.data());
              const double *x = points.data(p);
              for (unsigned int d = 0; d < dim; ++d)
                places[p][d] = x[d] + u[d];
            }
        });
      }
  }



  template <int dim>
  void set_accelerations(const ActiveNodes<dim> &active,
                         const NodalVector      &accelerations,
                         MaterialPoints<dim>    &points)
  {
    std::vector<double> cell_a;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points.ranges()[k];
        gather_at<dim>(nodes, accelerations.begin(), cell_a);
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            const auto a = interpolate<dim, -1>(nodes.size(),
                                                points.support(p),
                                                cell_a.data());
            for (unsigned int d = 0; d < dim; ++d)
              points.data(p)[points.slots().a + d] = a[d];
          }
      }
  }



  template <int dim>
  void update_points(
    const ActiveNodes<dim> &active,
    const NodalVector      &u,
    const Inertia<dim>     *inertia,
    const EndStates<dim>   &end_states,
    MaterialPoints<dim>    &points,
    const std::function<void(const typename PointCloud<dim>::Range &)> &updated)
  {
    CellUpdate<dim>     update(points, inertia, end_states);
    std::vector<double> accelerations, motion, cell_seen;
    if (inertia != nullptr)
      accelerations = nodal_accelerations(active, u, *inertia);
    const bool filters = inertia != nullptr && inertia->filtered_part() > 0;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto nodes = active.nodes(k);
        if (filters)
          {
            cell_seen.resize(nodes.size() * dim);
            for (unsigned int i = 0; i < nodes.size() * dim; ++i)
              cell_seen[i] =
                inertia->seen_velocity(nodes[i / dim] * dim + i % dim);
          }
        with_support_size<dim>(nodes.size(), [&](const auto n_static) {
          constexpr int n   = decltype(n_static)::value;
          const auto    run = [&](const auto m) {
            update.template run<m, n>(points.ranges()[k],
                                      nodes.size(),
                                      motion.data(),
                                      filters ? cell_seen.data() : nullptr);
          };
          if (inertia == nullptr)
            {
              gather_at<dim>(nodes, u.begin(), motion);
              return run(std::integral_constant<int, dim>());
            }
          gather_at<dim, 2 * dim>(nodes, u.begin(), motion);
          gather_at<dim, 2 * dim>(nodes, accelerations.data(), motion, dim);
          run(std::integral_constant<int, 2 * dim>());
        });
        if (updated)
          updated(points.ranges()[k]);
      }
  }

#define IMPOINT_INSTANTIATE(dim)                            \
  template void new_places(const MaterialPoints<dim> &,     \
                           const ActiveNodes<dim> &,        \
                           const NodalVector &,             \
                           std::vector<Point<dim>> &);      \
  template void set_accelerations(const ActiveNodes<dim> &, \
                                  const NodalVector &,      \
                                  MaterialPoints<dim> &);   \
  template void update_points(                              \
    const ActiveNodes<dim> &,                               \
    const NodalVector &,                                    \
    const Inertia<dim> *,                                   \
    const EndStates<dim> &,                                 \
    MaterialPoints<dim> &,                                  \
    const std::function<void(const PointCloud<dim>::Range &)> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
