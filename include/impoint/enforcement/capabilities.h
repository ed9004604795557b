#ifndef impoint_enforcement_capabilities_h
#define impoint_enforcement_capabilities_h

#include <impoint/terms/term.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    // What some methods have besides those of class Method.

    /**
     * Multipliers by which a condition holds, and which a linear solve has to
     * find together with the displacements.
     */
    class MultiplierUpdates
    {
    public:
      virtual ~MultiplierUpdates() = default;

      /** Whether it has any multipliers on this rank. */
      virtual bool augmented() const = 0;

      /** New multipliers of the particles of range @p r from the gaps at the
       * displacements of @p system, to whose residual it adds what that
       * changes. */
      virtual void update_multipliers(const unsigned int r,
                                      CellSystem        &system) = 0;

      /** Those of link @p l. */
      virtual void update_link_multipliers(const unsigned int l,
                                           CellSystem        &system) = 0;

      /** After all updates: tells neighbours the new multipliers. Whether that
       * changes the residual by add_exchange(). Collective. */
      virtual bool exchange_multipliers()                 = 0;
      virtual void add_exchange(const unsigned int r,
                                CellSystem        &system) const = 0;

      /** The multipliers of the iterate as numbers in an order of the method's
       * own. */
      virtual std::vector<double> multipliers() const                 = 0;
      virtual void set_multipliers(const std::vector<double> &values) = 0;
    };



    /**
     * Contact within Newton's method. begin_correction() remembers what touches
     * and slides where a correction starts; after it contact_changed() tells
     * whether that is otherwise now, so that the correction isn't shortened
     * though residuals grow. The step has converged only if contact_settled().
     * Where contacts come and go for half of all iterations, freeze(true) keeps
     * what touches touching; what converges so must be a solution after
     * freeze(false), too.
     */
    class ContactStates
    {
    public:
      virtual ~ContactStates() = default;

      /** The last add() was at the place that a correction starts from. */
      virtual void begin_correction() = 0;

      /** Whether something touches, lets go or slides that did not when the
       * correction began. */
      virtual bool contact_changed() const = 0;

      /** Whether all that was assumed of contact in the last add() is what the
       * law says. */
      virtual bool contact_settled() const = 0;

      /** Whether what touches shall go on touching: ends a cycle of the active
       * set. */
      virtual void freeze(const bool wanted) = 0;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
