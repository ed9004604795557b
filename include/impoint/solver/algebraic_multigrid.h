#ifndef impoint_solver_algebraic_multigrid_h
#define impoint_solver_algebraic_multigrid_h

#include <impoint/solver/multigrid.h>

#include <deal.II/base/point.h>

#include <memory>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  /**
   * Smoothed aggregation (Trilinos ML) with the rigid-body modes of the nodes,
   * for grids without a lattice.
   */
  template <int dim>
  class AlgebraicMultigrid : public VCycle<dim>
  {
  public:
    /** The nodes of @p pattern stand at @p points [m]. */
    AlgebraicMultigrid(const BlockPattern            &pattern,
                       const NodeExchange            &nodes,
                       const std::vector<Point<dim>> &points);
    ~AlgebraicMultigrid() override;

    void new_matrix(const BlockMatrix<dim> &matrix) override;

    void vmult(const std::vector<double> &r,
               std::vector<double>       &z) const override;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace Impoint

#endif
