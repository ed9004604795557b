#ifndef impoint_setup_checks_h
#define impoint_setup_checks_h

#include <impoint/scene.h>
#include <impoint/solver/nonlinear_system.h>

#include <string>
#include <vector>

namespace Impoint
{
  /**
   * What is doubtful about the shape of a boundary, for a person to judge:
   * parts outside of the grid, fewer particles than cells that it cuts; and
   * normals that point into the material where only they differ. Throws
   * InputError if more than half of its area within 2 h of material has normals
   * that point into it, unless the condition is the same either way.
   * Collective.
   */
  template <int dim>
  std::vector<std::string>
  doubts_about_boundary(const ParameterFile          &file,
                        const BoundaryParameters     &parameters,
                        const ConditionParameters    &condition,
                        const BoundaryParticles<dim> &particles,
                        const MaterialPoints<dim>    &points,
                        const BackgroundGrid<dim>    &grid);

  /** What is doubtful about the number of points: cells between them that have
   * none, and, in the cells of a quadratic basis, fewer strains than functions,
   * so that the matrix may be singular. Collective. */
  template <int dim>
  std::vector<std::string>
  doubts_about_points(const GridParameters      &parameters,
                      const MaterialPoints<dim> &points,
                      const Basis<dim>          &basis);

  /** Share of a boundary's area whose particles are in no active cell.
   * Collective. */
  template <int dim>
  double inactive_share(const BoundaryParticles<dim> &particles,
                        const ActiveNodes<dim>       &active);

  /** Whether nothing that a quasi-static scene applies depends on time, so
   * that a smaller step is no smaller task. Throws InputError. */
  template <int dim>
  bool load_is_constant(const ParameterFile &file, const Scene<dim> &scene);
} // namespace Impoint

#endif
