#include <impoint/base/exceptions.h>
#include <impoint/solver/rigid_modes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace Impoint
{
  namespace
  {
    constexpr double smallest_stiffness = 1e-13; // of a mode, relative

    /** Parts that are connected by the rows of this rank: for each node, ghosts
     * included, the first node of its part. */
    std::vector<unsigned int> connected_here(const BlockPattern &pattern,
                                             const unsigned int  n_nodes)
    {
      std::vector<unsigned int> before(n_nodes);
      std::iota(before.begin(), before.end(), 0);
      const auto first = [&before](unsigned int i) {
        while (before[i] != i)
          i = before[i] = before[before[i]];
        return i;
      };
      for (unsigned int row = 0; row < pattern.n_rows(); ++row)
        for (std::size_t q = pattern.row_start[row];
             q < pattern.row_start[row + 1];
             ++q)
          {
            const unsigned int i = first(row), j = first(pattern.columns[q]);
            before[std::max(i, j)] = std::min(i, j);
          }
      for (unsigned int i = 0; i < n_nodes; ++i)
        before[i] = first(i);
      return before;
    }

    /**
     * Connected parts over all ranks: for each node the number of its part, in
     * the order of their lowest nodes. Returns how many there are. A part on a
     * rank learns from its ghosts the lowest node that they are connected to,
     * until all agree.
     */
    template <int dim>
    unsigned int connected_parts(const LinearProblem<dim>  &problem,
                                 std::vector<unsigned int> &part)
    {
      const NodeExchange &nodes   = problem.nodes;
      const unsigned int  n_owned = problem.pattern.n_rows();
      const unsigned int  n       = n_owned + nodes.n_ghosts();
      const auto          here    = connected_here(problem.pattern, n);

      std::vector<double> lowest(n), of_part(n);
      for (unsigned int i = 0; i < n; ++i)
        lowest[i] = nodes.global_number(i);
      bool changes = true;
      while (changes)
        {
          of_part = lowest;
          for (unsigned int i = 0; i < n; ++i)
            of_part[here[i]] = std::min(of_part[here[i]], lowest[i]);
          changes = false;
          for (unsigned int i = 0; i < n_owned; ++i)
            {
              changes |= lowest[i] != of_part[here[i]];
              lowest[i] = of_part[here[i]];
            }
          nodes.update(lowest);
          changes = Utilities::MPI::max(int(changes), nodes.communicator());
        }

      std::vector<double> own(lowest.begin(), lowest.begin() + n_owned);
      std::sort(own.begin(), own.end());
      own.erase(std::unique(own.begin(), own.end()), own.end());
      std::vector<double> all;
      for (const auto &of_rank :
           Utilities::MPI::all_gather(nodes.communicator(), own))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      part.resize(n);
      for (unsigned int i = 0; i < n; ++i)
        part[i] =
          std::lower_bound(all.begin(), all.end(), lowest[i]) - all.begin();
      return all.size();
    }

    /** Value of rigid mode @p m (translations, then rotations) at @p x. */
    template <int dim>
    Tensor<1, dim> rigid_mode(const unsigned int m, const Point<dim> &x)
    {
      Tensor<1, dim> value;
      if (m < dim)
        value[m] = 1;
      else
        {
          const unsigned int i = dim == 2 ? 0 : (m - dim + 1) % dim;
          const unsigned int j = dim == 2 ? 1 : (m - dim + 2) % dim;
          value[i]             = -x[j];
          value[j]             = x[i];
        }
      return value;
    }

    template <int dim>
    std::string name_of_mode(const std::vector<double> &coefficients)
    {
      unsigned int largest = 0;
      for (unsigned int m = 1; m < coefficients.size(); ++m)
        if (std::abs(coefficients[m]) > std::abs(coefficients[largest]))
          largest = m;
      if (largest < dim)
        return std::string("moves freely along ") + "xyz"[largest];
      return dim == 2 ?
               "turns freely" :
               std::string("turns freely about ") + "xyz"[largest - dim];
    }

    /** Connected nodes that move together. */
    template <int dim>
    struct Part
    {
      static constexpr unsigned int n_modes = dim * (dim + 1) / 2;

      Point<dim>               centre;
      double                   extent = 0;
      LAPACKFullMatrix<double> energy, scale; // of the modes

      Part()
        : energy(n_modes)
        , scale(n_modes)
      {}

      /** Throws if a mode costs nothing. */
      void check()
      {
        std::vector<Vector<double>> vectors(n_modes, Vector<double>(n_modes));
        energy.compute_generalized_eigenvalues_symmetric(scale, vectors);
        for (unsigned int m = 0; m < n_modes; ++m)
          if (energy.eigenvalue(m).real() < smallest_stiffness)
            {
              std::ostringstream text;
              text << "the material around (" << centre << ") "
                   << name_of_mode<dim>({vectors[m].begin(), vectors[m].end()})
                   << ": no boundary holds it, and statics has no answer. Add "
                      "a boundary, or set 'Kind = dynamic' in section 'Time'. "
                      "Where cells are finer than the points of a body are "
                      "apart, it falls into parts: set more points, or coarser "
                      "cells";
              throw RunFailed(text.str());
            }
      }
    };

    template <int dim>
    std::vector<Part<dim>> place_parts(const LinearProblem<dim>        &problem,
                                       const std::vector<unsigned int> &part,
                                       const unsigned int               n_parts)
    {
      const unsigned int     n_owned = problem.pattern.n_rows();
      const MPI_Comm         comm    = problem.nodes.communicator();
      std::vector<double>    sums(n_parts * (dim + 1)), extents(n_parts);
      std::vector<Part<dim>> parts(n_parts);
      for (unsigned int i = 0; i < n_owned; ++i)
        {
          for (unsigned int d = 0; d < dim; ++d)
            sums[part[i] * (dim + 1) + d] += problem.points[i][d];
          sums[part[i] * (dim + 1) + dim] += 1;
        }
      Utilities::MPI::sum(sums, comm, sums);
      for (unsigned int k = 0; k < n_parts; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          parts[k].centre[d] =
            sums[k * (dim + 1) + d] / sums[k * (dim + 1) + dim];
      for (unsigned int i = 0; i < n_owned; ++i)
        extents[part[i]] =
          std::max(extents[part[i]],
                   parts[part[i]].centre.distance(problem.points[i]));
      Utilities::MPI::max(extents, comm, extents);
      for (unsigned int k = 0; k < n_parts; ++k)
        parts[k].extent = extents[k];
      return parts;
    }

    /** Energies of the modes and of their scale, a row for each part. */
    template <int dim>
    void measure_modes(const LinearProblem<dim>        &problem,
                       const std::vector<unsigned int> &part,
                       std::vector<Part<dim>>          &parts)
    {
      constexpr unsigned int n_modes  = Part<dim>::n_modes;
      constexpr unsigned int width    = n_modes * n_modes;
      const unsigned int     n_owned  = problem.pattern.n_rows();
      const auto             diagonal = diagonal_blocks(problem.pattern);
      std::vector<double>    sums(parts.size() * 2 * width);

      std::vector<std::vector<double>> modes(n_modes), products(n_modes);
      for (unsigned int m = 0; m < n_modes; ++m)
        {
          modes[m].resize(part.size() * dim);
          products[m].resize(n_owned * dim);
          for (unsigned int i = 0; i < part.size(); ++i)
            {
              const Part<dim>     &it    = parts[part[i]];
              const Tensor<1, dim> value = rigid_mode<dim>(
                m, Point<dim>((problem.points[i] - it.centre) / it.extent));
              for (unsigned int d = 0; d < dim; ++d)
                modes[m][i * dim + d] = value[d];
            }
          problem.matrix.vmult(modes[m].data(), products[m].data());
        }
      for (unsigned int at = 0; at < n_owned * dim; ++at)
        {
          const unsigned int i = at / dim, d = at % dim;
          const double       stiffness =
            problem.matrix.values[(diagonal[i] * dim + d) * dim + d];
          double *sum = &sums[part[i] * 2 * width];
          for (unsigned int r = 0; r < n_modes; ++r)
            for (unsigned int s = 0; s < n_modes; ++s)
              {
                sum[r * n_modes + s] += modes[r][at] * products[s][at];
                sum[width + r * n_modes + s] +=
                  modes[r][at] * stiffness * modes[s][at];
              }
        }
      Utilities::MPI::sum(sums, problem.nodes.communicator(), sums);
      for (unsigned int k = 0; k < parts.size(); ++k)
        for (unsigned int e = 0; e < width; ++e)
          {
            parts[k].energy(e / n_modes, e % n_modes) = sums[k * 2 * width + e];
            parts[k].scale(e / n_modes, e % n_modes) =
              sums[k * 2 * width + width + e];
          }
    }
  } // namespace



  template <int dim>
  void check_rigid_modes(const LinearProblem<dim> &problem)
  {
    std::vector<unsigned int> part;
    const unsigned int        n_parts = connected_parts(problem, part);
    std::vector<Part<dim>>    parts   = place_parts(problem, part, n_parts);
    measure_modes(problem, part, parts);
    for (auto &it : parts)
      it.check();
  }

  template void check_rigid_modes(const LinearProblem<2> &);
  template void check_rigid_modes(const LinearProblem<3> &);
} // namespace Impoint
