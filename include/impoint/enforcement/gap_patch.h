#ifndef impoint_enforcement_gap_patch_h
#define impoint_enforcement_gap_patch_h

#include <impoint/enforcement/traction_law.h>
#include <impoint/grid/support_size.h>
#include <impoint/terms/term.h>

#include <boost/container/small_vector.hpp>

#include <limits>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Boundary particles of a cell that share a gap g = g_0 + sum_a L_a u_a and
     * a traction, L = sum_b A_b H_b / A and A = sum_b A_b.
     *
     * Where only the normal gap counts (frictionless slip), it, multiplier and
     * traction are in component 0, and normal is the first unit vector.
     */
    template <int dim>
    struct GapPatch
    {
      /** What the patch does, at the traction that it would take without
       * bounds. */
      struct Contact
      {
        Touch          touch = Touch::sticks;
        Tensor<1, dim> trial;
        bool           overruled = false; // the law says otherwise
      };

      /** The traction [Pa], and what it answers to a change of the trial. */
      struct Answer
      {
        Tensor<1, dim> traction;
        Tensor<2, dim> slope;
      };

      GapPatch(const bool normal_only, const unsigned int n_nodes);

      Tensor<1, dim> gap(const double *u) const;

      /** The traction without bounds at the displacements @p u of the cell. */
      Tensor<1, dim> trial(const double *u) const;

      Answer answer(const Contact &contact) const;

      /** Adds A L^T t to the residual. */
      void add_force(const Tensor<1, dim> &traction, CellSystem &system) const;

      /** Adds A L^T k L to the matrix. */
      void add_stiffness(const Tensor<2, dim> &stiffness,
                         CellSystem           &system) const;

      /** Sum over the nodes of L_a^T t. */
      Tensor<1, dim> total(const Tensor<1, dim> &traction) const;

      /** Adds @p part, whose nodes are at @p places of these: until all are
       * there, sums weighted by areas. Parts that are farther away than the
       * nearest one's reach do not belong to it. */
      void add_part(const GapPatch                  &part,
                    const std::vector<unsigned int> &places);
      void divide_by_area();

      /** What ranks tell each other of it as numbers, and back; returns what
       * follows. */
      void          pack(std::vector<double> &numbers) const;
      const double *unpack(const double *numbers);

      bool         normal_only;
      unsigned int n_nodes;
      unsigned int begin = 0, end = 0; // particles
      double       area = 0;
      // how far its nearest particle is away, and how far they all may be
      double         nearest = std::numeric_limits<double>::max();
      double         reach   = std::numeric_limits<double>::max();
      Tensor<1, dim> normal, start_gap, multiplier;
      TractionLaw    law;

      // L_a per node of the whole gap, and of the normal gap
      boost::container::small_vector<double, 27>         values;
      boost::container::small_vector<Tensor<1, dim>, 27> rows;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
