// What reaches beyond a cell: the links of Assembly.

#include <impoint/solver/assembly.h>

namespace Impoint
{
  template <int dim>
  Links Assembly<dim>::find_links(const double start, const double end)
  {
    Links links;
    ghost_penalty.find_links(links);
    for (const auto &method : methods)
      method->find_links(start, end, active, links);
    return links;
  }



  template <int dim>
  void Assembly<dim>::assemble_ghost_penalty(const Vector &u,
                                             const bool    tangent_wanted,
                                             const Part    part)
  {
    const bool with_mass = has_mass_matrix(part);
    CellSystem system;
    for (unsigned int l = 0; l < ghost_penalty.n_links(); ++l)
      {
        const bool holds =
          part != Part::constraints || ghost_penalty.at_empty(l);
        if (!holds && !with_mass)
          continue;
        const unsigned int k = ghost_penalty.group(l);
        gather(k, u, cell_u);
        begin_cell(k, tangent_wanted, system);
        if (holds)
          {
            CellSystem whole = since_start(k, system);
            ghost_penalty.add(l, whole);
          }
        if (inertia != nullptr && inertia->consistent())
          {
            accelerations_of(k);
            ghost_penalty.add_mass(l,
                                   cell_accelerations.data(),
                                   inertia->alpha(),
                                   system);
          }
        scatter_residual(k);
        if (tangent_wanted)
          scatter(k, problem->matrix);
      }
  }

  template class Assembly<2>;
  template class Assembly<3>;
} // namespace Impoint
