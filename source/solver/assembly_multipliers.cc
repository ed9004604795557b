#include <impoint/solver/assembly.h>

namespace Impoint
{
  template <int dim>
  void Assembly<dim>::update_multipliers(const Vector &u, Vector &change)
  {
    rest.reinit(active.unknowns());
    CellSystem system;
    const auto update = [&](const unsigned int k, const auto &add_change) {
      gather(k, u, cell_u);
      begin_cell(k, false, system);
      add_change();
      scatter_residual(k);
    };
    for (const auto &method : methods)
      {
        Enforcement::MultiplierUpdates *multipliers =
          method->multiplier_updates();
        if (!method->is_active() || multipliers == nullptr)
          continue;
        if (multipliers->augmented())
          {
            Enforcement::for_active_ranges(
              *method, active, [&](const unsigned int r, const unsigned int k) {
                update(k,
                       [&]() { multipliers->update_multipliers(r, system); });
              });
            Enforcement::for_links(
              *method, active, [&](const unsigned int l, const unsigned int k) {
                update(k, [&]() {
                  multipliers->update_link_multipliers(l, system);
                });
              });
          }
        if (multipliers->exchange_multipliers())
          Enforcement::for_active_ranges(
            *method, active, [&](const unsigned int r, const unsigned int k) {
              update(k, [&]() { multipliers->add_exchange(r, system); });
            });
      }
    rest.compress(VectorOperation::add);
    rest.zero_out_ghost_values();
    change = rest;
  }

  template class Assembly<2>;
  template class Assembly<3>;
} // namespace Impoint
