#ifndef impoint_enforcement_nodal_normals_h
#define impoint_enforcement_nodal_normals_h

#include <impoint/enforcement/enforcement.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /** Whether all normals of all ranks are alike: a flat wall. */
    template <int dim>
    bool one_normal(const BoundaryParticles<dim> &boundary,
                    const MPI_Comm                communicator);



    /**
     * The directions in which a slip boundary holds the nodes: the particles'
     * own normals, or averages at the nodes (P Eq. 54), without which two
     * normals in a cell of a curved boundary hold it altogether.
     */
    template <int dim>
    class NodalNormals
    {
    public:
      /** Automatic: averages unless all normals are alike. Collective. */
      void reinit(const Normals           choice,
                  const Method<dim>      &method,
                  const ActiveNodes<dim> &active);

      /** Direction at compact node @p node, seen from particle @p b. */
      Tensor<1, dim> direction(const BoundaryParticles<dim> &boundary,
                               const unsigned int            b,
                               const unsigned int            node) const
      {
        return averaged ? averages[node] :
                          boundary.vector(b, boundary.slots().normal);
      }

    private:
      bool                        averaged = false;
      std::vector<Tensor<1, dim>> averages; // per active node
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
