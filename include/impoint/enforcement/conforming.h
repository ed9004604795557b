#ifndef impoint_enforcement_conforming_h
#define impoint_enforcement_conforming_h

#include <impoint/enforcement/condition.h>
#include <impoint/grid/active_nodes.h>
#include <impoint/particles/boundary_parameters.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * A node of the grid that boundaries hold: along the first n_held of the
     * orthonormal directions it has the step's displacement `value` (P Eqs.
     * 29-38). Each direction belongs to the boundary that holds it first.
     */
    template <int dim>
    struct HeldNode
    {
      unsigned int                    node   = 0; // compact
      unsigned int                    n_held = 0;
      std::array<Tensor<1, dim>, dim> direction;
      std::array<double, dim>         value    = {};
      std::array<unsigned int, dim>   boundary = {};

      /** Holds it along @p wanted, of any length: what the directions already
       * held say of that stays as it is. */
      void hold(const Tensor<1, dim> &wanted,
                const double          amount, // along the unit vector
                const unsigned int    boundary_number);

      /** Projects onto what the node is free to do. */
      Tensor<2, dim> projector() const;

      Tensor<1, dim> prescribed() const;
    };

    /** All boundaries that coincide with the grid's: fixed, roller, slip. */
    template <int dim>
    class Conforming
    {
    public:
      explicit Conforming(const Basis<dim> &basis);

      /** Adds the @p sides of the grid. Collective;
       * throws InputError if the grid has no such part. */
      void add_boundary(const ParameterFile       &file,
                        const ConditionParameters &parameters,
                        const BoundaryParameters  &sides);

      unsigned int n_boundaries() const
      {
        return boundaries.size();
      }
      const std::string &name(const unsigned int i) const
      {
        return boundaries[i].parameters.name;
      }

      /** Held nodes among the active ones with the values of a step.
       * Collective. */
      std::vector<HeldNode<dim>> held_nodes(const ActiveNodes<dim> &active,
                                            const double            start,
                                            const double            end) const;

    private:
      struct Boundary
      {
        ConditionParameters   parameters;
        PrescribedMotion<dim> motion;
        std::array<bool, dim> components; // of a roller
        // nodes of the basis with area-weighted normals
        std::vector<std::pair<unsigned int, Tensor<1, dim>>> nodes;
      };

      void hold(const unsigned int    boundary_number,
                const Tensor<1, dim> &normal,
                const Tensor<1, dim> &value,
                HeldNode<dim>        &node) const;

      const Basis<dim>     &basis;
      std::vector<Boundary> boundaries;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
