#include <impoint/enforcement/gap_method.h>

#include <algorithm>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    typename GapMethod<dim>::Patch::Answer
    GapMethod<dim>::answer(const Patch &patch, const double *u) const
    {
      auto &contact = contacts[patch.begin];
      contact.trial = patch.trial(u);
      if (!frozen)
        {
          contact.touch     = patch.law.touch(patch.normal, contact.trial);
          contact.overruled = reverses(patch, contact);
          if (contact.overruled)
            contact.touch = Touch::sticks;
        }
      return patch.answer(contact);
    }



    /** Whether it slides against the way that it was thought to slide when the
     * correction began. Between such directions lies a state that sticks; a
     * correction that went from one to the other could do so for ever. */
    template <int dim>
    bool GapMethod<dim>::reverses(const Patch                   &patch,
                                  const typename Patch::Contact &contact) const
    {
      const auto &first = first_contacts[patch.begin];
      return contact.touch == Touch::slides && first.touch == Touch::slides &&
             contact.trial * first.trial <
               (contact.trial * patch.normal) * (first.trial * patch.normal);
    }



    /** Linear about the last answer(). */
    template <int dim>
    Tensor<1, dim> GapMethod<dim>::linear_traction(const Patch  &patch,
                                                   const double *u) const
    {
      const auto &contact = contacts[patch.begin];
      const auto  answer  = patch.answer(contact);
      return answer.traction + answer.slope * (patch.trial(u) - contact.trial);
    }



    template <int dim>
    bool GapMethod<dim>::contact_changed() const
    {
      for (unsigned int b = 0; b < contacts.size(); ++b)
        if (contacts[b].touch != first_contacts[b].touch)
          return true;
      return false;
    }



    template <int dim>
    bool GapMethod<dim>::contact_settled() const
    {
      return std::none_of(contacts.begin(),
                          contacts.end(),
                          [](const auto &contact) {
                            return contact.overruled;
                          });
    }



    /** What is frozen is not asked what the law says: the first answer()
     * afterwards is. */
    template <int dim>
    void GapMethod<dim>::freeze(const bool wanted)
    {
      frozen = wanted;
      if (frozen)
        for (auto &contact : contacts)
          contact.overruled = false;
    }

    template class GapMethod<2>;
    template class GapMethod<3>;
  } // namespace Enforcement
} // namespace Impoint
