#ifndef impoint_enforcement_shared_constraints_h
#define impoint_enforcement_shared_constraints_h

#include <impoint/enforcement/constraint_groups.h>

#include <functional>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Constraints that several cells of a boundary share (ConstraintGroups):
     * each is a link of the rank that owns the cell in the middle, and what
     * other ranks' particles contribute goes there and comes back.
     */
    template <int dim>
    class SharedConstraints
    {
    public:
      using Choice = typename ConstrainedCells<dim>::Choice;

      void clear();

      /** Finds the groups of @p boundary among the ranges that @p may_share
       * wants (all, by default), unless neither its particles nor these nor the
       * active cells that hold them changed since the last call. Collective. */
      void find_groups(const BoundaryParticles<dim> &boundary,
                       const ActiveNodes<dim>       &active,
                       const Choice                 &may_share = nullptr);

      /** Appends this rank's links: one for each group of several cells. */
      void append_links(Links &links) const;

      /** Whether the cell of range @p r shares its constraint. */
      bool contains(const unsigned int r) const
      {
        return r < parts.size() && parts[r].rank != nobody;
      }

      /** Whether the cell of range @p r has so few beside it that means over
       * them would not hold the boundary's rotations. */
      bool is_lonely(const unsigned int r) const
      {
        return r < lonely.size() && lonely[r];
      }

      unsigned int n_links() const
      {
        return links.size();
      }

      /** The range of the cell in the middle of link @p l. */
      unsigned int middle(const unsigned int l) const
      {
        return links[l].middle;
      }

      /** The patches (GapPatch, BandPatch) of links, from those that @p patch
       * gives for ranges of particles; @p empty makes one of so many nodes. @p
       * first: place of the first link among all. Collective. */
      template <typename Patch>
      std::vector<Patch>
      collect(const ActiveNodes<dim>                         &active,
              const unsigned int                              first,
              const std::function<Patch(const unsigned int)> &empty,
              const std::function<Patch(const unsigned int)> &patch) const;

      /** A vector for each range, from those of links. Collective. */
      std::vector<Tensor<1, dim>>
      distribute(const std::vector<Tensor<1, dim>> &of_links,
                 const MPI_Comm                     communicator) const;

    private:
      static constexpr unsigned int nobody = numbers::invalid_unsigned_int;

      /** A range's place: the rank of its link, the link there, the cell in
       * the link. */
      struct Part
      {
        unsigned int rank = nobody, link = 0, member = 0;
      };

      bool anything_changed(const BoundaryParticles<dim> &boundary,
                            const ActiveNodes<dim>       &active,
                            const Choice                 &may_share);

      struct Link
      {
        unsigned int              middle; // range
        std::vector<unsigned int> cells;  // of this rank, ghosts included
        std::vector<unsigned int> ranks;  // that own them
      };

      std::vector<Part> parts;  // per range
      std::vector<Link> links;  // of this rank
      std::vector<char> lonely; // per range

      // Of the last groups: each cell and whether it was active and could
      // share; places, normals and areas of the particles.
      std::vector<unsigned int> last_cells;
      std::vector<double>       last_particles;
      bool                      fresh = true;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
