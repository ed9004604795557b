#include <impoint/base/parameter_file.h>
#include <impoint/enforcement/conforming.h>

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
    void
    Conforming<dim>::add_boundary(const ParameterFile &      file,
                                  const ConditionParameters &parameters,
                                  const types::boundary_id   boundary_id)
    {
      Boundary boundary{parameters,
                        PrescribedMotion<dim>(file, parameters),
                        {},
                        basis.boundary_nodes(boundary_id)};
      for (unsigned int d = 0; d < dim; ++d)
        boundary.components[d] =
          parameters.components.find("xyz"[d]) != std::string::npos;
      if (dim == 2 && parameters.components.find('z') != std::string::npos)
        throw file.error(parameters.section + "/Components",
                         "component z does not exist in 2D",
                         "Use x, y, or both.");
      const unsigned int n_nodes = boundary.nodes.size();
      if (Utilities::MPI::max(n_nodes, basis.grid().communicator()) == 0)
        throw file.error(parameters.section + "/Boundary id",
                         "the grid's boundary has no part with id " +
                           std::to_string(boundary_id),
                         "Use an id that the grid's generator or file gives; "
                         "rectangles and boxes have 0 to 2 dim - 1 (left, "
                         "right, bottom, top, back, front).");
      boundaries.push_back(std::move(boundary));
    }



    /** Adds a condition to a node that may already be held by others. */
    template <int dim>
    void Conforming<dim>::hold(const Boundary &      boundary,
                               const Tensor<1, dim> &normal,
                               const Tensor<1, dim> &value,
                               HeldNode<dim> &       node) const
    {
      const std::string &constraint = boundary.parameters.constraint;
      const auto         hold_direction = [&](const Tensor<1, dim> &direction,
                                      const double          amount) {
        // What the rows already held do not say of the direction.
        Tensor<1, dim> rest        = direction;
        double         rest_amount = amount;
        unsigned int   n_held      = 0;
        for (unsigned int k = 0; k < dim; ++k)
          if (node.held[k])
            {
              ++n_held;
              Tensor<1, dim> row;
              for (unsigned int d = 0; d < dim; ++d)
                row[d] = node.Q[k][d];
              const double part = direction * row;
              rest -= part * row;
              rest_amount -= part * node.value[k];
            }
        if (rest.norm() < 1e-6 || n_held == dim)
          return;
        rest_amount /= rest.norm();
        rest /= rest.norm();

        // Held rows first, then the new one, then any orthonormal completion.
        std::vector<Tensor<1, dim>> rows;
        Tensor<1, dim>              values;
        for (unsigned int k = 0; k < dim; ++k)
          if (node.held[k])
            {
              Tensor<1, dim> row;
              for (unsigned int d = 0; d < dim; ++d)
                row[d] = node.Q[k][d];
              values[rows.size()] = node.value[k];
              rows.push_back(row);
            }
        values[rows.size()] = rest_amount;
        rows.push_back(rest);
        const unsigned int n_rows = rows.size();
        for (unsigned int e = 0; e < dim && rows.size() < dim; ++e)
          {
            Tensor<1, dim> row;
            row[e] = 1;
            for (const auto &other : rows)
              row -= (row * other) * other;
            if (row.norm() > 0.5)
              rows.push_back(row / row.norm());
          }
        for (unsigned int k = 0; k < dim; ++k)
          {
            node.held[k]  = k < n_rows;
            node.value[k] = k < n_rows ? values[k] : 0.;
            for (unsigned int d = 0; d < dim; ++d)
              node.Q[k][d] = rows[k][d];
          }
      };

      if (constraint == "slip")
        hold_direction(normal / normal.norm(), value * normal / normal.norm());
      else
        for (unsigned int d = 0; d < dim; ++d)
          if (constraint == "fixed" || boundary.components[d])
            {
              Tensor<1, dim> direction;
              direction[d] = 1;
              hold_direction(direction, value[d]);
            }
    }



    template <int dim>
    std::vector<HeldNode<dim>>
    Conforming<dim>::held_nodes(const ActiveNodes<dim> &active,
                                const double            start,
                                const double            end) const
    {
      std::map<unsigned int, HeldNode<dim>> held;
      for (unsigned int i = 0; i < boundaries.size(); ++i)
        {
          const Boundary &boundary = boundaries[i];
          if (!boundary.parameters.is_active(start, end))
            continue;
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
                  found                  = held.emplace(node, HeldNode<dim>()).first;
                  found->second.node     = node;
                  found->second.boundary = i;
                }
              hold(boundary, entry.second, value, found->second);
            }
        }
      std::vector<HeldNode<dim>> result;
      for (auto &entry : held)
        {
          HeldNode<dim> &node = entry.second;
          for (unsigned int k = 0; k < dim; ++k)
            for (unsigned int d = 0; d < dim; ++d)
              node.rotated |= node.Q[k][d] != double(k == d);
          result.push_back(node);
        }
      return result;
    }

    template class Conforming<2>;
    template class Conforming<3>;
  } // namespace Enforcement
} // namespace Impoint
