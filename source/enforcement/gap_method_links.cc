#include <impoint/enforcement/gap_method.h>

namespace Impoint
{
  namespace Enforcement
  {
    namespace
    {
      /** Without contact: what holds goes on holding. */
      template <int dim>
      typename GapPatch<dim>::Answer held(const GapPatch<dim> &patch,
                                          const double        *u)
      {
        typename GapPatch<dim>::Contact contact;
        contact.trial = patch.trial(u);
        return patch.answer(contact);
      }
    } // namespace



    template <int dim>
    bool GapMethod<dim>::shares_constraints() const
    {
      const Superfluous choice = this->condition.superfluous;
      return projected && is_linear() &&
             (choice == Superfluous::share ||
              (choice == Superfluous::automatic &&
               this->condition.has_multipliers()));
    }



    template <int dim>
    void GapMethod<dim>::make_links(const ActiveNodes<dim> &active,
                                    Links                  &links)
    {
      if (!shares_constraints())
        return;
      shared.find_groups(*this->boundary, active);
      shared.append_links(links);
    }



    /** What the cells of links contribute does not change within a step. */
    template <int dim>
    void GapMethod<dim>::make_link_patches()
    {
      if (!shares_constraints())
        return;
      const auto &ranges = this->boundary->ranges();
      link_patches       = shared.template collect<Patch>(
        *this->current.active,
        this->begin_link(),
        [&](const unsigned int n) { return Patch(normal_only, n); },
        [&](const unsigned int r) {
          return make_patch(r, ranges[r].begin, ranges[r].end);
        });
      for (unsigned int l = 0; l < link_patches.size(); ++l)
        link_patches[l].law = law(shared.middle(l), link_patches[l].area);
    }



    template <int dim>
    void GapMethod<dim>::add_link(const unsigned int l,
                                  const Strength     strength,
                                  CellSystem        &system) const
    {
      add_patch(link_patches[l],
                held(link_patches[l], system.u),
                shared.middle(l),
                strength,
                system);
    }



    template <int dim>
    void GapMethod<dim>::update_link_multipliers(const unsigned int l,
                                                 CellSystem        &system)
    {
      Patch               &patch = link_patches[l];
      const Tensor<1, dim> t     = held(patch, system.u).traction;
      patch.multiplier           = t;
      patch.add_force(held(patch, system.u).traction - t, system);
    }



    template <int dim>
    void GapMethod<dim>::end_links(
      const typename Method<dim>::LinkDisplacements &displacements)
    {
      if (!shares_constraints())
        return;
      std::vector<Tensor<1, dim>> tractions, gaps;
      std::vector<double>         u;
      for (unsigned int l = 0; l < link_patches.size(); ++l)
        {
          displacements(l, u);
          tractions.push_back(held(link_patches[l], u.data()).traction);
          gaps.push_back(link_patches[l].gap(u.data()));
        }
      const MPI_Comm comm = this->current.active->basis().grid().communicator();
      shared_tractions    = shared.distribute(tractions, comm);
      shared_gaps         = shared.distribute(gaps, comm);
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
