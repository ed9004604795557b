#ifndef impoint_solver_band_preconditioner_h
#define impoint_solver_band_preconditioner_h

#include <impoint/solver/gathered_factor.h>
#include <impoint/solver/linear_solver.h>
#include <impoint/solver/multigrid.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Impoint
{
  /**
   * Multiplicative Schwarz for matrices that are spoilt for multigrid near
   * surfaces only: by an enforcement of any stiffness, by slivers, by starved
   * nodes. These nodes are the core; the band is the core and one layer of
   * neighbours.
   *
   * One application solves exactly on the band, does a V-cycle for the
   * moderate matrix on all nodes but slivers that are next to empty, and solves
   * on the band again.
   * With B the band and O the other nodes, that is
   *   z_O = V (r_O - A_OB A_BB^-1 r_B),  z_B = A_BB^-1 (r_B - A_BO z_O):
   * what the V-cycle says of the band itself is superseded by the last solve.
   * For the very matrix it was made for, an iteration that starts from the
   * band's part of the solution keeps r_B zero and is spared the first of the
   * two solves: conjugate gradients on the Schur complement of O.
   *
   * On several ranks the V-cycle is spread over them, while the factor of the
   * band, which is a surface, is on one. All is collective.
   */
  template <int dim>
  class BandPreconditioner : public Preconditioner
  {
  public:
    /** A node is a sliver below @p sliver times the median diagonal; with
     * splines below 1e4 times that. */
    BandPreconditioner(const double sliver);

    /** Tells that the pattern changed: the next renew() partitions anew. */
    void new_pattern();

    /** Whether what is kept was made for the same enforced nodes. */
    bool serves(const LinearProblem<dim> &problem) const;

    /** Factorises and makes the hierarchy. Returns the node with a pivot that
     * is not positive, if any; if another rank owns it, an invalid number. */
    std::optional<unsigned int> renew(const LinearProblem<dim> &problem);

    /** Tells that the matrix is not the one of renew() any more. */
    void outdate();

    void vmult(const std::vector<double> &r,
               std::vector<double>       &z) const override;
    bool start(const std::vector<double> &b,
               std::vector<double>       &x) const override;
    void clear(std::vector<double> &r) const override;
    void finish(const std::vector<double> &b,
                std::vector<double>       &x) const override;

    /** "band + geometric multigrid" or the like. */
    std::string description() const;

  private:
    void partition(const LinearProblem<dim> &problem);
    void make_v_cycle(const LinearProblem<dim> &problem);
    void solve_outside(std::vector<double> &residual) const;

    void subtract_band(const std::vector<double> &r) const;

    /** z_B = A_BB^-1 (band_right - A_BO z_O), with the ghosts of O. */
    void solve_band(std::vector<double> &z) const;

    /** Whether it holds on all ranks. */
    bool everywhere(const bool here) const;

    const double      sliver_threshold;
    NodeExchange      nodes;
    bool              partitioned = false, has_band = false;
    bool              condenses = false; // keeps r_B zero
    std::vector<char> enforced, slivers;
    std::vector<char> empty; // slivers of next to no stiffness

    BlockSubmatrix<dim> band;     // A_BB
    BlockSubmatrix<dim> coupling; // A_BO, columns numbered as in A
    BlockSubmatrix<dim> outer;    // the moderate matrix without what is empty

    GatheredFactor<dim>          band_factor;
    std::unique_ptr<VCycle<dim>> v_cycle; // none if the band is everything
    std::string                  v_cycle_name;

    mutable std::vector<double> residual, band_right, band_solution;
    mutable std::vector<double> outer_right, outer_solution;
  };
} // namespace Impoint

#endif
