#ifndef impoint_solver_multigrid_h
#define impoint_solver_multigrid_h

#include <impoint/solver/gathered_factor.h>
#include <impoint/solver/lattice_coarsening.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** A multigrid cycle made for a pattern, with values to be renewed. */
  template <int dim>
  class VCycle : public Preconditioner
  {
  public:
    /** Makes smoothers and coarse matrices. The matrix has the pattern given
     * to the constructor and must live as long as the cycle is used. Throws
     * StepFailed if it turns out not to be positive definite. */
    virtual void new_matrix(const BlockMatrix<dim> &matrix) = 0;
  };

  /**
   * Block Gauss-Seidel sweeps with inverted diagonal blocks; each rank's sweep
   * takes its ghosts as they are. Where the diagonal does not outweigh the
   * entries of ghost columns, half of what is missing is added to it: sweeps
   * then reduce the energy of errors whatever the ranks (Baker, Falgout, Kolev,
   * Yang 2011).
   */
  template <int dim>
  class GaussSeidel
  {
  public:
    void reinit(const BlockMatrix<dim> &matrix);

    /** x = (D + L)^-1 b: a forward sweep from x = 0. */
    void forward(const std::vector<double> &b, std::vector<double> &x) const;

    /** r = b - A x after forward(b, x) and an update of ghosts: - U x but for
     * the ghosts. */
    void residual(const std::vector<double> &x, std::vector<double> &r) const;

    /** x += (D + U)^-1 (b - A x), row by row. */
    void backward(const std::vector<double> &b, std::vector<double> &x) const;

  private:
    void find_added();
    void solve_diagonal(const unsigned int row, double *x) const;

    const BlockMatrix<dim>  *matrix = nullptr;
    std::vector<std::size_t> diagonal; // positions of the diagonal blocks
    std::vector<double>      inverse;  // of the diagonal blocks
    std::vector<double>      added;    // to the diagonal
  };

  /**
   * Geometric multigrid on a Cartesian lattice, that of the nodes or one that
   * covers them: Galerkin products, W-cycles with one forward and one
   * backward sweep of Gauss-Seidel a level, a factor at the bottom.
   */
  template <int dim>
  class Multigrid : public VCycle<dim>
  {
  public:
    using Lattice = typename LatticeCoarsening<dim>::Lattice;

    /** The nodes of @p pattern have the places @p lattice on @p lines. */
    Multigrid(const BlockPattern            &pattern,
              const NodeExchange            &nodes,
              const Lattice                 &lattice,
              const std::vector<SplineLine> &lines);

    /** The nodes of @p pattern are covered by @p lattice. */
    Multigrid(const BlockPattern         &pattern,
              const NodeExchange         &nodes,
              const CoveringLattice<dim> &lattice);

    /** Whether each level is a part of the one above that is worth its sweeps;
     * otherwise the last has a factor whatever its size. A lattice does not
     * cover grids well whose cells differ much in size. */
    bool coarsens() const;

    void new_matrix(const BlockMatrix<dim> &matrix) override;

    void vmult(const std::vector<double> &r,
               std::vector<double>       &z) const override;

  private:
    struct Level
    {
      template <typename... LatticeOf>
      Level(const BlockPattern &pattern,
            const NodeExchange &nodes,
            const LatticeOf &...lattice)
        : nodes(nodes)
        , coarsening(pattern, nodes, lattice...)
      {}

      const NodeExchange     nodes;
      GaussSeidel<dim>       smoother;
      LatticeCoarsening<dim> coarsening;
      BlockMatrix<dim>       coarse_matrix;

      mutable std::vector<double> residual, coarse_right, coarse_solution,
        coarse_product, coarse_change;
    };

    template <typename... LatticeOf>
    void make_levels(const BlockPattern &pattern,
                     const NodeExchange &nodes,
                     const LatticeOf &...lattice);

    void cycle(const unsigned int         level,
               const std::vector<double> &b,
               std::vector<double>       &x) const;

    void solve_coarse(const unsigned int level_index, const Level &level) const;

    std::vector<std::unique_ptr<Level>> levels; // finest first
    GatheredFactor<dim>                 bottom;
    bool                                coarsens_well = true;
  };
} // namespace Impoint

#endif
