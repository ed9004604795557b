#include <impoint/solver/algebraic_multigrid.h>
#include <impoint/solver/band_preconditioner.h>

#include <deal.II/base/types.h>

#include <algorithm>
#include <cmath>

namespace Impoint
{
  namespace
  {
    constexpr unsigned int left_out = numbers::invalid_unsigned_int;

    /** The outer functions of splines have small stiffnesses by nature. */
    constexpr double spline_sliver_factor = 10.;

    /** The largest diagonal entry of a node among its free unknowns (conforming
     * conditions leave rows with nothing but a diagonal of any size); negative
     * if none is free. */
    template <int dim>
    double free_diagonal(const BlockMatrix<dim> &matrix, const unsigned int row)
    {
      double diagonal[dim] = {};
      bool   coupled[dim]  = {};
      for (std::size_t k = matrix.pattern->row_start[row];
           k < matrix.pattern->row_start[row + 1];
           ++k)
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            {
              const double entry = matrix.values[(k * dim + r) * dim + c];
              if (matrix.pattern->columns[k] == row && r == c)
                diagonal[r] = entry;
              else if (entry != 0)
                coupled[r] = true;
            }
      double largest = -1;
      for (unsigned int d = 0; d < dim; ++d)
        if (coupled[d])
          largest = std::max(largest, diagonal[d]);
      return largest;
    }

    std::vector<char> with_neighbours(const BlockPattern      &pattern,
                                      const std::vector<char> &core)
    {
      std::vector<char> grown = core;
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        if (core[row])
          for (std::size_t k = pattern.row_start[row];
               k < pattern.row_start[row + 1];
               ++k)
            grown[pattern.columns[k]] = true;
      return grown;
    }

    /** The nodes that are (not) marked. */
    std::vector<unsigned int> nodes_where(const std::vector<char> &marks,
                                          const bool               marked)
    {
      std::vector<unsigned int> nodes;
      for (unsigned int node = 0; node < marks.size(); ++node)
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
  bool BandPreconditioner<dim>::serves(const LinearProblem<dim> &problem) const
  {
    return partitioned && enforced == problem.enforced;
  }

  template <int dim>
  void BandPreconditioner<dim>::find_slivers(const BlockMatrix<dim> &matrix,
                                             const bool              splines)
  {
    std::vector<double> diagonal(matrix.pattern->n_rows());
    for (unsigned int node = 0; node < diagonal.size(); ++node)
      diagonal[node] = free_diagonal(matrix, node);

    std::vector<double> free;
    std::copy_if(diagonal.begin(),
                 diagonal.end(),
                 std::back_inserter(free),
                 [](const double entry) { return entry >= 0; });
    double threshold = 0;
    if (!free.empty())
      {
        const auto median = free.begin() + free.size() / 2;
        std::nth_element(free.begin(), median, free.end());
        threshold =
          (splines ? spline_sliver_factor : 1.) * sliver_threshold * *median;
      }
    slivers.resize(diagonal.size());
    for (unsigned int node = 0; node < diagonal.size(); ++node)
      slivers[node] = diagonal[node] >= 0 && diagonal[node] < threshold;
  }

  template <int dim>
  void BandPreconditioner<dim>::partition(const LinearProblem<dim> &problem)
  {
    const unsigned int n_nodes = problem.pattern.n_rows();
    std::vector<char>  core    = slivers;
    for (unsigned int node = 0; node < n_nodes; ++node)
      if (enforced[node] ||
          (!problem.regularisation.empty() && problem.regularisation[node] > 0))
        core[node] = true;
    const std::vector<char> in_band = with_neighbours(problem.pattern, core);

    const std::vector<unsigned int> band_nodes = nodes_where(in_band, true);
    band.new_pattern(problem.pattern,
                     band_nodes,
                     positions_in(band_nodes, n_nodes));
    if (!band_nodes.empty())
      band_factor.new_pattern(band.pattern);

    std::vector<unsigned int> outside(n_nodes, left_out);
    for (unsigned int node = 0; node < n_nodes; ++node)
      if (!in_band[node])
        outside[node] = node;
    coupling.new_pattern(problem.pattern, band_nodes, outside);

    v_cycle.reset();
    v_cycle_name.clear();
    const std::vector<unsigned int> outer_nodes = nodes_where(slivers, false);
    if (band_nodes.size() == n_nodes)
      return;
    outer.new_pattern(problem.pattern,
                      outer_nodes,
                      positions_in(outer_nodes, n_nodes));
    if (problem.lattice.empty())
      {
        v_cycle_name = "algebraic multigrid";
        v_cycle      = std::make_unique<AlgebraicMultigrid<dim>>(
          outer.pattern, select_nodes(problem.points, outer_nodes));
      }
    else
      {
        v_cycle_name = "geometric multigrid";
        v_cycle      = std::make_unique<Multigrid<dim>>(outer.pattern,
                                                   select_nodes(problem.lattice,
                                                                outer_nodes),
                                                   problem.lines);
      }
  }

  template <int dim>
  std::optional<unsigned int>
  BandPreconditioner<dim>::renew(const LinearProblem<dim> &problem)
  {
    const BlockMatrix<dim> &moderate =
      problem.has_moderate ? problem.moderate : problem.matrix;
    const std::vector<char> old_slivers = slivers;
    find_slivers(moderate,
                 !problem.lines.empty() && problem.lines[0].degree > 1);
    if (!serves(problem) || slivers != old_slivers)
      {
        enforced = problem.enforced;
        partition(problem);
        partitioned = true;
      }

    if (!band.rows.empty())
      {
        band.copy(problem.matrix);
        coupling.copy(problem.matrix);
        const std::optional<unsigned int> failed =
          band_factor.factorize(band.matrix,
                                problem.regularisation.empty() ?
                                  std::vector<double>() :
                                  select_nodes(problem.regularisation,
                                               band.rows));
        if (failed)
          return band.rows[*failed];
      }
    if (v_cycle)
      {
        outer.copy(moderate);
        if (!problem.regularisation.empty())
          add_to_diagonal(select_nodes(problem.regularisation, outer.rows),
                          outer.matrix);
        v_cycle->new_matrix(outer.matrix);
      }

    residual.resize(problem.pattern.n_rows() * dim);
    band_right.resize(band.rows.size() * dim);
    band_solution.resize(band.rows.size() * dim);
    outer_right.resize(outer.rows.size() * dim);
    outer_solution.resize(outer.rows.size() * dim);
    return {};
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

  template <int dim>
  void BandPreconditioner<dim>::vmult(const std::vector<double> &r,
                                      std::vector<double>       &z) const
  {
    residual = r;
    z.assign(r.size(), 0.);
    if (band.rows.empty())
      {
        solve_outside(z);
        return;
      }

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

    solve_outside(z);

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
  std::string BandPreconditioner<dim>::description() const
  {
    if (band.rows.empty())
      return v_cycle_name;
    return v_cycle_name.empty() ? "band" : "band + " + v_cycle_name;
  }

  template class BandPreconditioner<2>;
  template class BandPreconditioner<3>;
} // namespace Impoint
