#include <impoint/solver/motion.h>

#include <algorithm>

namespace Impoint
{
  using NodalVector = LinearAlgebra::distributed::Vector<double>;

  namespace
  {
    template <int dim>
    void gather_at(const ArrayView<const unsigned int> nodes,
                   const NodalVector                  &vector,
                   std::vector<double>                &values)
    {
      values.resize(nodes.size() * dim);
      for (unsigned int i = 0; i < values.size(); ++i)
        values[i] = vector.local_element(nodes[i / dim] * dim + i % dim);
    }
  } // namespace



  template <int dim>
  std::vector<Point<dim>> new_places(const MaterialPoints<dim> &points,
                                     const ActiveNodes<dim>    &active,
                                     const NodalVector         &u)
  {
    std::vector<Point<dim>> places(points.n());
    std::vector<double>     cell_u;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points.ranges()[k];
        gather_at<dim>(nodes, u, cell_u);
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            const double *N = points.support(p);
            places[p]       = points.position(p);
            for (unsigned int a = 0; a < nodes.size(); ++a)
              for (unsigned int d = 0; d < dim; ++d)
                places[p][d] += N[a] * cell_u[a * dim + d];
          }
      }
    return places;
  }



  template <int dim>
  void set_accelerations(const ActiveNodes<dim> &active,
                         const NodalVector      &accelerations,
                         MaterialPoints<dim>    &points)
  {
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto  nodes = active.nodes(k);
        const auto &range = points.ranges()[k];
        for (unsigned int p = range.begin; p < range.end; ++p)
          for (unsigned int d = 0; d < dim; ++d)
            {
              double sum = 0;
              for (unsigned int a = 0; a < nodes.size(); ++a)
                sum += points.support(p)[a] *
                       accelerations.local_element(nodes[a] * dim + d);
              points.data(p)[points.slots().a + d] = sum;
            }
      }
  }



  namespace
  {
    /** Velocity @p v and acceleration @p a of a point after the step, from the
     * nodes' accelerations and, if there is a filter, the velocities that they
     * saw at its start. */
    template <int dim>
    void update_velocity(const Inertia<dim>        &inertia,
                         const unsigned int         n,
                         const double              *N,
                         const std::vector<double> &nodal_accelerations,
                         const std::vector<double> &seen,
                         double                    *v,
                         double                    *a)
    {
      const double filtered = inertia.filtered_part();
      for (unsigned int d = 0; d < dim; ++d)
        {
          double unseen = v[d], a_new = 0;
          for (unsigned int i = 0; i < n; ++i)
            {
              a_new += N[i] * nodal_accelerations[i * dim + d];
              if (filtered > 0)
                unseen -= N[i] * seen[i * dim + d];
            }
          v[d] = inertia.new_velocity(v[d] - filtered * unseen, a[d], a_new);
          a[d] = a_new;
        }
    }
  } // namespace



  template <int dim>
  void update_points(const ActiveNodes<dim> &active,
                     const NodalVector      &u,
                     const Inertia<dim>     *inertia,
                     MaterialPoints<dim>    &points)
  {
    const auto                 &slots   = points.slots();
    const bool                  dynamic = inertia != nullptr;
    Materials::Deformation<dim> deformation;
    Materials::Response<dim>    response;
    std::vector<double>         new_history(points.carried().n_history);
    std::vector<double>         cell_u, cell_a, cell_seen;
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      {
        const auto         nodes = active.nodes(k);
        const unsigned int n     = nodes.size();
        const auto        &range = points.ranges()[k];
        gather_at<dim>(nodes, u, cell_u);
        if (dynamic)
          {
            cell_a.resize(n * dim);
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int d = 0; d < dim; ++d)
                cell_a[a * dim + d] =
                  inertia->acceleration(nodes[a] * dim + d,
                                        cell_u[a * dim + d]);
          }
        if (dynamic && inertia->filtered_part() > 0)
          {
            cell_seen.resize(n * dim);
            for (unsigned int i = 0; i < n * dim; ++i)
              cell_seen[i] =
                inertia->seen_velocity(nodes[i / dim] * dim + i % dim);
          }
        for (unsigned int p = range.begin; p < range.end; ++p)
          {
            double        *state = points.data(p);
            const double  *N     = points.support(p);
            const double  *G     = N + n;
            Tensor<2, dim> grad_u;
            for (unsigned int a = 0; a < n; ++a)
              for (unsigned int i = 0; i < dim; ++i)
                {
                  state[slots.x + i] += N[a] * cell_u[a * dim + i];
                  state[slots.u + i] += N[a] * cell_u[a * dim + i];
                  for (unsigned int j = 0; j < dim; ++j)
                    grad_u[i][j] += cell_u[a * dim + i] * G[a * dim + j];
                }
            points.respond(
              p, grad_u, false, deformation, response, new_history.data());
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = 0; j < dim; ++j)
                state[slots.F + i * dim + j] = deformation.F[i][j];
            std::copy(response.stress.begin(),
                      response.stress.end(),
                      state + slots.stress);
            if (dim == 2)
              state[slots.stress + Voigt<dim>::n] = response.stress_zz;
            if (!new_history.empty())
              std::copy(new_history.begin(),
                        new_history.end(),
                        state + slots.history);
            if (dynamic)
              update_velocity<dim>(*inertia,
                                   n,
                                   N,
                                   cell_a,
                                   cell_seen,
                                   state + slots.v,
                                   state + slots.a);
          }
      }
  }

#define IMPOINT_INSTANTIATE(dim)                                               \
  template std::vector<Point<dim>> new_places(const MaterialPoints<dim> &,     \
                                              const ActiveNodes<dim> &,        \
                                              const NodalVector &);            \
  template void                    set_accelerations(const ActiveNodes<dim> &, \
                                                     const NodalVector &,      \
                                                     MaterialPoints<dim> &);   \
  template void                    update_points(const ActiveNodes<dim> &,     \
                                                 const NodalVector &,          \
                                                 const Inertia<dim> *,         \
                                                 MaterialPoints<dim> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
