#ifndef impoint_enforcement_conforming_h
#define impoint_enforcement_conforming_h

#include <impoint/enforcement/condition.h>
#include <impoint/grid/active_nodes.h>

#include <vector>

namespace Impoint
{
  namespace Enforcement
  {
    /**
     * A node of the grid that boundaries hold: in the frame of the rows of
     * Q, the components in `held` have the step's displacement `value` (P Eqs.
     * 29-38). `reaction` is what the boundary gives to each boundary.
     */
    template <int dim>
    struct HeldNode
    {
      unsigned int                 node = 0; // compact
      Tensor<2, dim>               Q;
      std::array<bool, dim>        held = {};
      Tensor<1, dim>               value;
      unsigned int                 boundary = 0; // the first that holds it
      bool                         rotated  = false;
    };

    /** All boundaries that coincide with the grid's: fixed, roller, slip. */
    template <int dim>
    class Conforming
    {
    public:
      explicit Conforming(const Basis<dim> &basis);

      /** Adds the part of the grid's boundary with @p boundary_id. Collective;
       * throws InputError if the grid has no such part. */
      void add_boundary(const ParameterFile &      file,
                        const ConditionParameters &parameters,
                        const types::boundary_id   boundary_id);

      unsigned int n_boundaries() const { return boundaries.size(); }
      const std::string &name(const unsigned int i) const
      {
        return boundaries[i].parameters.name;
      }
      const std::string &constraint(const unsigned int i) const
      {
        return boundaries[i].parameters.constraint;
      }

      /** Held nodes among the active ones with the values of a step. */
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

      void hold(const Boundary &      boundary,
                const Tensor<1, dim> &normal,
                const Tensor<1, dim> &value,
                HeldNode<dim> &       node) const;

      const Basis<dim> &    basis;
      std::vector<Boundary> boundaries;
    };
  } // namespace Enforcement
} // namespace Impoint

#endif
