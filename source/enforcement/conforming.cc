#include <impoint/base/on_all_ranks.h>
#include <impoint/base/parameter_file.h>
#include <impoint/enforcement/conforming.h>

#include <deal.II/base/symmetric_tensor.h>

#include <map>

namespace Impoint
{
  namespace Enforcement
  {
    template <int dim>
    Conforming<dim>::Conforming(const Basis<dim> &basis)
      : basis(basis)
    {}



    template <int dim>
    void Conforming<dim>::add_boundary(const ParameterFile       &file,
                                       const ConditionParameters &parameters,
                                       const BoundaryParameters  &sides)
    {
      Boundary boundary{parameters,
                        PrescribedMotion<dim>(file, parameters),
                        {},
                        basis.boundary_nodes(sides.boundary_id)};
      for (unsigned int d = 0; d < dim; ++d)
        boundary.components[d] =
          parameters.components.find("xyz"[d]) != std::string::npos;
      if (dim == 2 && parameters.components.find('z') != std::string::npos)
        throw file.error(parameters.section + "/Components",
                         "component z does not exist in 2D",
                         "Use x, y, or both.");
      const unsigned int n_nodes = boundary.nodes.size();
      if (Utilities::MPI::max(n_nodes, basis.grid().communicator()) == 0)
        throw sides.no_such_side(file);
      if (!basis.can_hold(sides.boundary_id))
        throw file.error(parameters.section + "/Boundary id",
                         "a '" + basis.name() +
                           "' basis holds only sides of the box around the "
                           "grid, and the part with id " +
                           std::to_string(sides.boundary_id) +
                           " lies inside of it",
                         "Set 'Kind = nonconforming' and give the boundary a "
                         "shape, or set Basis = linear or quadratic in section "
                         "'Grid'.");
      boundaries.push_back(std::move(boundary));
    }



    template <int dim>
    void HeldNode<dim>::hold(const Tensor<1, dim> &wanted,
                             const double          amount,
                             const unsigned int    boundary_number)
    {
      Tensor<1, dim> rest        = wanted / wanted.norm();
      double         rest_amount = amount;
      for (unsigned int k = 0; k < n_held; ++k)
        {
          const double part = rest * direction[k];
          rest -= part * direction[k];
          rest_amount -= part * value[k];
        }
      const double length = rest.norm();
      if (n_held == dim || length < 1e-6)
        return;
      direction[n_held] = rest / length;
      value[n_held]     = rest_amount / length;
      boundary[n_held]  = boundary_number;
      ++n_held;
    }



    template <int dim>
    Tensor<2, dim> HeldNode<dim>::projector() const
    {
      Tensor<2, dim> result(unit_symmetric_tensor<dim>());
      for (unsigned int k = 0; k < n_held; ++k)
        result -= outer_product(direction[k], direction[k]);
      return result;
    }



    template <int dim>
    Tensor<1, dim> HeldNode<dim>::prescribed() const
    {
      Tensor<1, dim> result;
      for (unsigned int k = 0; k < n_held; ++k)
        result += value[k] * direction[k];
      return result;
    }



    /** Adds a condition to a node that may already be held by others. */
    template <int dim>
    void Conforming<dim>::hold(const unsigned int    boundary_number,
                               const Tensor<1, dim> &normal,
                               const Tensor<1, dim> &value,
                               HeldNode<dim>        &node) const
    {
      const Boundary &boundary = boundaries[boundary_number];
      const bool      slip = boundary.parameters.constraint == Constraint::slip;
      const bool fixed = boundary.parameters.constraint == Constraint::fixed;
      if (slip)
        node.hold(normal, value * normal / normal.norm(), boundary_number);
      for (unsigned int d = 0; d < dim && !slip; ++d)
        if (fixed || boundary.components[d])
          {
            Tensor<1, dim> axis;
            axis[d] = 1;
            node.hold(axis, value[d], boundary_number);
          }
    }



    template <int dim>
    std::vector<HeldNode<dim>>
    Conforming<dim>::held_nodes(const ActiveNodes<dim> &active,
                                const double            start,
                                const double            end) const
    {
      std::map<unsigned int, HeldNode<dim>> held;
      const auto hold_nodes = [&](const unsigned int i) {
        const Boundary &boundary = boundaries[i];
        for (const auto &entry : boundary.nodes)
          {
            const unsigned int node = active.compact(entry.first);
            if (node == BackgroundGrid<dim>::nowhere)
              continue;
            Tensor<1, dim> value;
            if (!boundary.motion.is_zero())
              value = boundary.motion.increment(basis.point(entry.first),
                                                basis.point(entry.first),
                                                start,
                                                end);
            auto found = held.find(node);
            if (found == held.end())
              {
                found              = held.emplace(node, HeldNode<dim>()).first;
                found->second.node = node;
              }
            hold(i, entry.second, value, found->second);
          }
      };
      on_all_ranks(basis.grid().communicator(), [&]() {
        for (unsigned int i = 0; i < boundaries.size(); ++i)
          if (boundaries[i].parameters.is_active(start, end))
            hold_nodes(i);
      });
      std::vector<HeldNode<dim>> result;
      for (const auto &entry : held)
        result.push_back(entry.second);
      return result;
    }

    template struct HeldNode<2>;
    template struct HeldNode<3>;
    template class Conforming<2>;
    template class Conforming<3>;
  } // namespace Enforcement
} // namespace Impoint
