#include <impoint/solver/nonlinear_system.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  void NonlinearSystem<dim>::cut_multipliers(const double fraction)
  {
    if (is_augmented())
      multipliers.cut(fraction);
  }



  template <int dim>
  bool NonlinearSystem<dim>::has_kinks() const
  {
    return std::any_of(methods.begin(), methods.end(), [](const auto &method) {
      return method->is_active() && !method->is_linear();
    });
  }



  template <int dim>
  bool NonlinearSystem<dim>::contact_changed() const
  {
    bool changed = false;
    for (const auto &method : methods)
      if (const auto *states = method->contact_states())
        changed |= method->is_active() && states->contact_changed();
    return has_kinks() &&
           Utilities::MPI::max(int(changed),
                               active.basis().grid().communicator());
  }



  template <int dim>
  bool NonlinearSystem<dim>::contact_settled() const
  {
    bool settled = true;
    for (const auto &method : methods)
      if (const auto *states = method->contact_states())
        settled &= !method->is_active() || states->contact_settled();
    return !has_kinks() ||
           Utilities::MPI::min(int(settled),
                               active.basis().grid().communicator());
  }



  template <int dim>
  void NonlinearSystem<dim>::freeze(const bool wanted)
  {
    for (const auto &method : methods)
      if (auto *states = method->contact_states())
        states->freeze(wanted);
  }

  template class NonlinearSystem<2>;
  template class NonlinearSystem<3>;
} // namespace Impoint
