#include <impoint/solver/algebraic_multigrid.h>
#include <impoint/solver/band_preconditioner.h>
#include <impoint/solver/slivers.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    constexpr unsigned int left_out = numbers::invalid_unsigned_int;

    /** The outer functions of splines have small stiffnesses by nature. */
    constexpr double spline_sliver_factor = 1e4;

    /** What the V-cycle leaves out: at a surface whose nodes were left out with
     * a stiffness that counts, it would be stiffer than it is (iterations of a
     * slender beam grow from 17 to 43). */
    constexpr double negligible = 1e-6;

    template <int dim>
    bool has_splines(const LinearProblem<dim> &problem)
    {
      return !problem.lines.empty() && problem.lines[0].degree > 1;
    }

    /** Splines have two or three times as many neighbours as linear functions;
     * those next to them on the lattice will do. */
    template <int dim>
    bool next_to(const LinearProblem<dim> &problem,
                 const unsigned int        a,
                 const unsigned int        b)
    {
      if (!has_splines(problem))
        return true;
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(problem.lattice[a][d] - problem.lattice[b][d]) > 1)
          return false;
      return true;
    }

    /** Patterns are symmetric: neighbours of the core have it as a neighbour,
     * ghosts among them. */
    template <int dim>
    std::vector<char> with_neighbours(const LinearProblem<dim> &problem,
                                      const std::vector<char>  &core)
    {
      const BlockPattern &pattern = problem.pattern;
      std::vector<char>   grown   = core;
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        for (std::size_t k = pattern.row_start[row];
             k < pattern.row_start[row + 1];
             ++k)
          if (const unsigned int column = pattern.columns[k];
              core[column] && next_to(problem, row, column))
            grown[row] = true;
      problem.nodes.share(grown);
      return grown;
    }

    /** Those of the first @p n nodes that are (not) marked. */
    std::vector<unsigned int> nodes_where(const std::vector<char> &marks,
                                          const bool               marked,
                                          const std::size_t        n)
    {
      std::vector<unsigned int> nodes;
      for (unsigned int node = 0; node < n; ++node)
        if ((marks[node] != 0) == marked)
          nodes.push_back(node);
      return nodes;
    }

    std::vector<unsigned int>
    positions_in(const std::vector<unsigned int> &nodes,
                 const std::size_t                n_all)
    {
      std::vector<unsigned int> position(n_all, left_out);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        position[nodes[i]] = i;
      return position;
    }

    template <typename T>
    std::vector<T> select_nodes(const std::vector<T>            &all,
                                const std::vector<unsigned int> &nodes)
    {
      std::vector<T> some;
      for (const unsigned int node : nodes)
        some.push_back(all[node]);
      return some;
    }

    template <int dim>
    void gather_nodes(const std::vector<double>       &from,
                      const std::vector<unsigned int> &nodes,
                      std::vector<double>             &to)
    {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        std::copy_n(&from[std::size_t(nodes[i]) * dim], dim, &to[i * dim]);
    }

    template <int dim>
    void scatter_nodes(const std::vector<double>       &from,
                       const std::vector<unsigned int> &nodes,
                       std::vector<double>             &to)
    {
      for (std::size_t i = 0; i < nodes.size(); ++i)
        std::copy_n(&from[i * dim], dim, &to[std::size_t(nodes[i]) * dim]);
    }
  } // namespace

  template <int dim>
  BandPreconditioner<dim>::BandPreconditioner(const double sliver)
    : sliver_threshold(sliver)
  {}

  template <int dim>
  void BandPreconditioner<dim>::new_pattern()
  {
    partitioned = false;
  }

  template <int dim>
  bool BandPreconditioner<dim>::everywhere(const bool here) const
  {
    return Utilities::MPI::min(int(here), nodes.communicator());
  }

  template <int dim>
  bool BandPreconditioner<dim>::serves(const LinearProblem<dim> &problem) const
  {
    return partitioned && everywhere(enforced == problem.enforced);
  }

  template <int dim>
  void BandPreconditioner<dim>::partition(const LinearProblem<dim> &problem)
  {
    const unsigned int n_nodes = problem.pattern.n_rows();
    const std::size_t  n_local = slivers.size();
    std::vector<char>  core    = slivers;
    for (unsigned int node = 0; node < n_local; ++node)
      if (enforced[node])
        core[node] = true;
    const std::vector<char> in_band = with_neighbours(problem, core);

    const std::vector<unsigned int> band_nodes =
      nodes_where(in_band, true, n_nodes);
    band.new_pattern(problem.pattern,
                     band_nodes,
                     positions_in(nodes_where(in_band, true, n_local),
                                  n_local));
    has_band = !everywhere(band_nodes.empty());
    if (has_band)
      band_factor.new_pattern(band.pattern, nodes.select(in_band));

    std::vector<unsigned int> outside(n_local, left_out);
    for (unsigned int node = 0; node < n_local; ++node)
      if (!in_band[node])
        outside[node] = node;
    coupling.new_pattern(problem.pattern, band_nodes, outside);

    v_cycle.reset();
    v_cycle_name.clear();
    if (!everywhere(band_nodes.size() == n_nodes))
      make_v_cycle(problem);
  }

  template <int dim>
  void BandPreconditioner<dim>::make_v_cycle(const LinearProblem<dim> &problem)
  {
    const std::size_t               n_local = slivers.size();
    const std::vector<unsigned int> local = nodes_where(empty, false, n_local);
    outer.new_pattern(problem.pattern,
                      nodes_where(empty, false, problem.pattern.n_rows()),
                      positions_in(local, n_local));
    std::vector<char> kept(n_local);
    for (unsigned int node = 0; node < n_local; ++node)
      kept[node] = !empty[node];
    const NodeExchange outer_nodes = nodes.select(kept);
    v_cycle_name                   = "geometric multigrid";
    if (!problem.lines.empty())
      v_cycle =
        std::make_unique<Multigrid<dim>>(outer.pattern,
                                         outer_nodes,
                                         select_nodes(problem.lattice, local),
                                         problem.lines);
    else
      {
        const std::vector<Point<dim>> points =
          select_nodes(problem.points, local);
        auto multigrid = std::make_unique<Multigrid<dim>>(
          outer.pattern,
          outer_nodes,
          CoveringLattice<dim>(outer.pattern, outer_nodes, points));
        if (multigrid->coarsens())
          v_cycle = std::move(multigrid);
        else
          {
            v_cycle_name = "algebraic multigrid";
            v_cycle = std::make_unique<AlgebraicMultigrid<dim>>(outer.pattern,
                                                                outer_nodes,
                                                                points);
          }
      }
    outer_right.resize(local.size() * dim);
    outer_solution.resize(local.size() * dim);
  }

  template <int dim>
  std::optional<unsigned int>
  BandPreconditioner<dim>::renew(const LinearProblem<dim> &problem)
  {
    const BlockMatrix<dim> &moderate =
      problem.has_moderate ? problem.moderate : problem.matrix;
    nodes = problem.nodes;
    const double threshold =
      (has_splines(problem) ? spline_sliver_factor : 1.) * sliver_threshold;
    const std::vector<char> new_slivers =
      find_slivers(moderate, nodes, threshold);
    const std::vector<char> new_empty =
      find_slivers(moderate, nodes, std::min(threshold, negligible));
    if (!serves(problem) ||
        !everywhere(slivers == new_slivers && empty == new_empty))
      {
        enforced = problem.enforced;
        slivers  = new_slivers;
        empty    = new_empty;
        partition(problem);
        partitioned = true;
      }

    if (has_band)
      {
        band.copy(problem.matrix);
        coupling.copy(problem.matrix);
        const auto failed = band_factor.factorize(band.matrix);
        if (failed)
          return band_factor.owns(*failed) ?
                   band.rows[*failed - band_factor.first_number()] :
                   numbers::invalid_unsigned_int;
      }
    if (v_cycle)
      {
        outer.copy(moderate);
        v_cycle->new_matrix(outer.matrix);
      }
    band_right.resize(band.rows.size() * dim);
    band_solution.resize(band.rows.size() * dim);
    // without O there is nothing to iterate
    condenses = has_band && v_cycle;
    return {};
  }

  template <int dim>
  void BandPreconditioner<dim>::outdate()
  {
    condenses = false;
  }

  template <int dim>
  void BandPreconditioner<dim>::solve_outside(std::vector<double> &z) const
  {
    if (!v_cycle)
      return;
    gather_nodes<dim>(residual, outer.rows, outer_right);
    v_cycle->vmult(outer_right, outer_solution);
    scatter_nodes<dim>(outer_solution, outer.rows, z);
  }

  /** residual = r_O - A_OB A_BB^-1 r_B, and 0 on the band. */
  template <int dim>
  void
  BandPreconditioner<dim>::subtract_band(const std::vector<double> &r) const
  {
    std::fill(residual.end() - std::size_t(nodes.n_ghosts()) * dim,
              residual.end(),
              0.);
    const BlockPattern &pattern = coupling.pattern;
    gather_nodes<dim>(r, band.rows, band_right);
    band_factor.vmult(band_right, band_solution);
    for (std::size_t i = 0; i < band.rows.size(); ++i)
      {
        std::fill_n(&residual[std::size_t(band.rows[i]) * dim], dim, 0.);
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1];
             ++k)
          add_block_transposed_vmult<dim>(
            &coupling.matrix.values[k * dim * dim],
            &band_solution[i * dim],
            -1.,
            &residual[std::size_t(pattern.columns[k]) * dim]);
      }
    nodes.add(residual);
  }

  template <int dim>
  void BandPreconditioner<dim>::solve_band(std::vector<double> &z) const
  {
    const BlockPattern &pattern = coupling.pattern;
    for (std::size_t i = 0; i < band.rows.size(); ++i)
      {
        double sum[dim];
        row_vmult(coupling.matrix,
                  pattern.row_start[i],
                  pattern.row_start[i + 1],
                  z.data(),
                  sum);
        for (unsigned int d = 0; d < dim; ++d)
          band_right[i * dim + d] -= sum[d];
      }
    band_factor.vmult(band_right, band_solution);
    scatter_nodes<dim>(band_solution, band.rows, z);
  }

  template <int dim>
  void BandPreconditioner<dim>::vmult(const std::vector<double> &r,
                                      std::vector<double>       &z) const
  {
    z.assign(r.size(), 0.);
    residual = r;
    if (has_band && !condenses)
      subtract_band(r);
    solve_outside(z);
    if (!has_band)
      return;

    nodes.update(z);
    gather_nodes<dim>(r, band.rows, band_right);
    solve_band(z);
  }

  template <int dim>
  bool BandPreconditioner<dim>::start(const std::vector<double> &b,
                                      std::vector<double>       &x) const
  {
    if (!condenses)
      return false;
    gather_nodes<dim>(b, band.rows, band_right);
    band_factor.vmult(band_right, band_solution);
    scatter_nodes<dim>(band_solution, band.rows, x);
    return true;
  }

  template <int dim>
  void BandPreconditioner<dim>::clear(std::vector<double> &r) const
  {
    for (const unsigned int node : band.rows)
      std::fill_n(&r[std::size_t(node) * dim], dim, 0.);
  }

  template <int dim>
  void BandPreconditioner<dim>::finish(const std::vector<double> &b,
                                       std::vector<double>       &x) const
  {
    gather_nodes<dim>(b, band.rows, band_right);
    solve_band(x);
  }

  template <int dim>
  std::string BandPreconditioner<dim>::description() const
  {
    if (!has_band)
      return v_cycle_name;
    return v_cycle_name.empty() ? "band" : "band + " + v_cycle_name;
  }

  template class BandPreconditioner<2>;
  template class BandPreconditioner<3>;
} // namespace Impoint
