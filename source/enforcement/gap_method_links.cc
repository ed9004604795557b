#include <impoint/enforcement/gap_method.h>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    bool GapMethod<dim>::shares_constraints() const
    {
      const Superfluous choice = this->condition.superfluous;
      return projected && (choice == Superfluous::share ||
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
      const unsigned int n = this->boundary->n();
      for (unsigned int l = 0; l < link_patches.size(); ++l)
        {
          Patch &patch = link_patches[l];
          patch.begin = patch.end = n + l; // the place of its contact
          set_law(shared.middle(l), patch);
        }
      contacts.resize(n + link_patches.size());
      first_contacts = contacts;
    }



    template <int dim>
    void GapMethod<dim>::add_link(const unsigned int l,
                                  const Strength     strength,
                                  CellSystem        &system) const
    {
      add_patch(link_patches[l],
                answer(link_patches[l], system.u),
                shared.middle(l),
                strength,
                system);
    }



    template <int dim>
    void GapMethod<dim>::update_link_multipliers(const unsigned int l,
                                                 CellSystem        &system)
    {
      Patch &patch = link_patches[l];
      if (!patch.law.augmented)
        return;
      const Tensor<1, dim> t = linear_traction(patch, system.u);
      patch.multiplier       = t;
      patch.add_force(linear_traction(patch, system.u) - t, system);
    }



    template <int dim>
    void GapMethod<dim>::end_links(
      const typename Method<dim>::LinkDisplacements &displacements)
    {
      if (!shares_constraints())
        return;
      std::vector<Tensor<1, dim>> tractions, gaps, states;
      std::vector<double>         u;
      for (unsigned int l = 0; l < link_patches.size(); ++l)
        {
          const Patch &patch = link_patches[l];
          displacements(l, u);
          tractions.push_back(answer(patch, u.data()).traction);
          gaps.push_back(patch.gap(u.data()));
          states.emplace_back();
          states.back()[0] = int(contacts[patch.begin].touch);
          states.back()[1] = patch.reach;
        }
      const MPI_Comm comm = this->current.active->basis().grid().communicator();
      shared_tractions    = shared.distribute(tractions, comm);
      shared_gaps         = shared.distribute(gaps, comm);
      states              = shared.distribute(states, comm);
      shared_reaches.clear();
      for (unsigned int r = 0; r < states.size(); ++r)
        {
          shared_reaches.push_back(states[r][1]);
          if (shared.contains(r))
            contacts[this->boundary->ranges()[r].begin].touch =
              Touch(int(states[r][0]));
        }
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
