#ifndef impoint_enforcement_jump_penalty_h
#define impoint_enforcement_jump_penalty_h

#include <impoint/grid/active_nodes.h>
#include <impoint/particles/boundary_particles.h>

#include <map>
#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * Multipliers of all cells, held together by a penalty on their jumps
     * (Burman and Hansbo 2010): the stabilised alternative to leaving
     * superfluous ones out (L Section 3.2.2). The work of tractions loses
     * w/2 |lambda_i - lambda_j|^2 for each face between two cells of a
     * boundary, so that the constraint of cell i becomes
     *
     *   A_i g_i = sum_j w (lambda_i - lambda_j),    w = factor h^dim / E.
     *
     * Nothing changes where the traction is even; where it is smooth, jumps of
     * O(h) leave gaps of O(h^2). There is no penalty around a corner, where
     * tractions jump.
     *
     * For TractionLaw a cell's own multiplier is a compliance, and those of its
     * neighbours shift the gap; so no matrix knows of neighbours, and the
     * iteration for the multipliers, which knows, stays that of a matrix that
     * is positive definite.
     */
    template <int dim>
    class JumpPenalty
    {
    public:
      void clear();

      /** Collective. */
      void reinit(const BoundaryParticles<dim> &boundary,
                  const ActiveNodes<dim>       &active,
                  const double                  factor,
                  const double                  young);

      bool acts() const
      {
        return on;
      }

      /** Tells neighbours the multipliers, one for each range. Collective. */
      void exchange(const std::vector<Tensor<1, dim>> &multipliers);

      /** sum_j w / A of range @p r [m/Pa]. */
      double compliance(const unsigned int r) const
      {
        return acts() ? parts[r].compliance : 0.;
      }

      /** sum_j w lambda_j / A of range @p r [m]. */
      Tensor<1, dim> shift(const unsigned int r) const
      {
        return acts() ? parts[r].shift : Tensor<1, dim>();
      }

      /** By how much the last exchange() changed that. */
      Tensor<1, dim> change(const unsigned int r) const
      {
        return parts[r].shift - parts[r].last_shift;
      }

    private:
      struct Neighbor
      {
        unsigned int rank;   // its owner
        unsigned int place;  // a range, or a place in what that rank tells
        double       weight; // w / A
      };

      struct Part
      {
        std::vector<Neighbor> neighbors;
        double                compliance = 0;
        Tensor<1, dim>        shift, last_shift;
      };

      bool              on           = false;
      MPI_Comm          communicator = MPI_COMM_NULL;
      std::vector<Part> parts;                                // per range
      std::map<unsigned int, std::vector<unsigned int>> told; // ranges
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
