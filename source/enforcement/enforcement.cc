#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/enforcement/kinds.h>
#include <impoint/enforcement/traction.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    Method<dim>::Method(const ConditionParameters              &parameters,
                        PrescribedMotion<dim>                   motion,
                        std::unique_ptr<BoundaryParticles<dim>> particles)
      : condition(parameters)
      , motion(std::move(motion))
      , boundary(std::move(particles))
    {
      if (condition.motion == Moves::automatic)
        condition.motion = condition.constraint == Constraint::traction ||
                               (condition.constraint == Constraint::slip &&
                                condition.carries_material()) ?
                             Moves::with_material :
                             Moves::with_value;
    }



    template <int dim>
    void Method<dim>::begin_step(const Step<dim> &step)
    {
      current    = step;
      active_now = condition.is_active(step.start, step.end);
      if (motion.is_zero())
        return;
      const auto &slots = boundary->slots();
      on_all_ranks(step.active->basis().grid().communicator(), [&]() {
        for (unsigned int b = 0; b < boundary->n(); ++b)
          boundary->set_vector(
            b,
            slots.increment,
            motion.increment(boundary->position(b),
                             Point<dim>(boundary->vector(b, slots.start)),
                             step.start,
                             step.end));
      });
    }



    template <int dim>
    void Method<dim>::find_links(const double            start,
                                 const double            end,
                                 const ActiveNodes<dim> &active,
                                 Links                  &links)
    {
      first_link = links.size();
      if (condition.is_active(start, end))
        make_links(active, links);
      last_link = links.size();
    }



    template <int dim>
    void Method<dim>::make_links(const ActiveNodes<dim> &, Links &)
    {}



    template <int dim>
    void Method<dim>::add_link(const unsigned int,
                               const Strength,
                               CellSystem &) const
    {}



    template <int dim>
    void Method<dim>::end_links(const LinkDisplacements &)
    {}



    template <int dim>
    Tensor<1, dim> Method<dim>::displacement(const unsigned int b,
                                             const unsigned int n,
                                             const double      *u) const
    {
      const double  *N = boundary->support(b);
      Tensor<1, dim> result;
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int d = 0; d < dim; ++d)
          result[d] += N[a] * u[a * dim + d];
      return result;
    }



    template <int dim>
    void Method<dim>::follow_material(const unsigned int r, const double *u)
    {
      if (!boundary->carried().keeps_grid)
        return;
      const auto        &slots = boundary->slots();
      const auto        &range = boundary->ranges()[r];
      const unsigned int n     = current.active->basis().n_nodes_of(range.cell);
      for (unsigned int b = range.begin; b < range.end; ++b)
        boundary->set_vector(
          b, slots.u, boundary->vector(b, slots.u) + displacement(b, n, u));
    }



    template <int dim>
    Tensor<1, dim> Method<dim>::material_place(const unsigned int b,
                                               const unsigned int n,
                                               const double      *u) const
    {
      const auto &slots = boundary->slots();
      return boundary->carried().keeps_grid ?
               boundary->vector(b, slots.start) + boundary->vector(b, slots.u) :
               boundary->vector(b, slots.x) + displacement(b, n, u);
    }



    template <int dim>
    bool Method<dim>::moves() const
    {
      return condition.motion == Moves::with_material ||
             (condition.motion == Moves::with_value && !motion.is_zero());
    }



    template <int dim>
    void Method<dim>::new_places(const unsigned int       r,
                                 const double            *u,
                                 std::vector<Point<dim>> &places) const
    {
      const auto        &range = boundary->ranges()[r];
      const unsigned int n     = current.active->basis().n_nodes_of(range.cell);
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          places[b] = boundary->position(b);
          if (condition.motion == Moves::with_value)
            places[b] += boundary->vector(b, boundary->slots().increment);
          else if (condition.motion == Moves::with_material && u != nullptr)
            places[b] += displacement(b, n, u);
        }
    }



    template <int dim>
    void Method<dim>::finish_step(const std::vector<Point<dim>> &places)
    {
      const auto    &slots = boundary->slots();
      Tensor<2, dim> rotation;
      if (motion.rotates())
        rotation = motion.rotation(current.start, current.end);
      for (unsigned int b = 0; b < boundary->n(); ++b)
        {
          boundary->set_vector(b, slots.x, places[b]);
          // the wall turns, whichever places its particles keep up with
          if (motion.rotates())
            boundary->set_vector(b,
                                 slots.normal,
                                 rotation * boundary->vector(b, slots.normal));
        }
      boundary->move();
    }



    template <int dim>
    std::vector<unsigned int> cells(const Methods<dim> &methods,
                                    const double        start,
                                    const double        end,
                                    const bool          all)
    {
      std::vector<unsigned int> result;
      for (const auto &method : methods)
        if (all || method->parameters().is_active(start, end))
          for (const auto &range : method->particles().ranges())
            result.push_back(range.cell);
      std::sort(result.begin(), result.end());
      result.erase(std::unique(result.begin(), result.end()), result.end());
      return result;
    }



    template <int dim>
    std::unique_ptr<Method<dim>>
    create(const ParameterFile                    &file,
           const ConditionParameters              &parameters,
           std::unique_ptr<BoundaryParticles<dim>> particles)
    {
      PrescribedMotion<dim> motion(file, parameters);
      if (parameters.constraint == Constraint::traction)
        return std::make_unique<Traction<dim>>(
          parameters,
          std::move(motion),
          std::move(particles),
          Expression<dim>(file, parameters.section + "/Traction", dim));
      return std::get<dim - 2>(kind(parameters.enforcement).make)(
        parameters, std::move(motion), std::move(particles));
    }

    template class Method<2>;
    template class Method<3>;
    template std::vector<unsigned int>
    cells(const Methods<2> &, const double, const double, const bool);
    template std::vector<unsigned int>
    cells(const Methods<3> &, const double, const double, const bool);
    template std::unique_ptr<Method<2>>
    create(const ParameterFile &,
           const ConditionParameters &,
           std::unique_ptr<BoundaryParticles<2>>);
    template std::unique_ptr<Method<3>>
    create(const ParameterFile &,
           const ConditionParameters &,
           std::unique_ptr<BoundaryParticles<3>>);
  } // namespace Enforcement
} // namespace Impoint
