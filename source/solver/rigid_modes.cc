#include <impoint/base/exceptions.h>
#include <impoint/solver/rigid_modes.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>
#include <sstream>

namespace Impoint
{
  namespace
  {
    constexpr double smallest_stiffness = 1e-13; // of a mode, relative

    /** Connected parts: for each node the number of its part. */
    unsigned int connected_parts(const BlockPattern        &pattern,
                                 std::vector<unsigned int> &part)
    {
      const unsigned int        none = numbers::invalid_unsigned_int;
      std::vector<unsigned int> front;
      unsigned int              n_parts = 0;
      part.assign(pattern.n_rows(), none);
      for (unsigned int seed = 0; seed < pattern.n_rows(); ++seed)
        {
          if (part[seed] != none)
            continue;
          part[seed] = n_parts;
          front.assign(1, seed);
          while (!front.empty())
            {
              const unsigned int i = front.back();
              front.pop_back();
              for (std::size_t q = pattern.row_start[i];
                   q < pattern.row_start[i + 1];
                   ++q)
                if (part[pattern.columns[q]] == none)
                  {
                    part[pattern.columns[q]] = n_parts;
                    front.push_back(pattern.columns[q]);
                  }
            }
          ++n_parts;
        }
      return n_parts;
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
      double                   n_nodes = 0, extent = 0;
      LAPACKFullMatrix<double> energy, scale; // of the modes

      Part()
        : energy(n_modes)
        , scale(n_modes)
      {
        energy = 0;
        scale  = 0;
      }

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
                      "a boundary, or set 'Kind = dynamic' in section 'Time'";
              throw RunFailed(text.str());
            }
      }
    };

    template <int dim>
    std::vector<Part<dim>> place_parts(const LinearProblem<dim>        &problem,
                                       const std::vector<unsigned int> &part,
                                       const unsigned int               n_parts)
    {
      std::vector<Part<dim>> parts(n_parts);
      for (unsigned int i = 0; i < part.size(); ++i)
        {
          parts[part[i]].centre += problem.points[i];
          parts[part[i]].n_nodes += 1;
        }
      for (auto &it : parts)
        it.centre /= it.n_nodes;
      for (unsigned int i = 0; i < part.size(); ++i)
        parts[part[i]].extent =
          std::max(parts[part[i]].extent,
                   parts[part[i]].centre.distance(problem.points[i]));
      return parts;
    }
  } // namespace



  template <int dim>
  void check_rigid_modes(const LinearProblem<dim> &problem)
  {
    constexpr unsigned int    n_modes = Part<dim>::n_modes;
    const unsigned int        n       = problem.pattern.n_rows();
    std::vector<unsigned int> part;
    const unsigned int        n_parts = connected_parts(problem.pattern, part);
    std::vector<Part<dim>>    parts   = place_parts(problem, part, n_parts);

    std::vector<std::vector<double>> modes(n_modes), products(n_modes);
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        modes[m].resize(n * dim);
        products[m].resize(n * dim);
        for (unsigned int i = 0; i < n; ++i)
          {
            const Part<dim>     &it    = parts[part[i]];
            const Tensor<1, dim> value = rigid_mode<dim>(
              m, Point<dim>((problem.points[i] - it.centre) / it.extent));
            for (unsigned int d = 0; d < dim; ++d)
              modes[m][i * dim + d] = value[d];
          }
        problem.matrix.vmult(modes[m].data(), products[m].data());
      }

    const auto diagonal = diagonal_blocks(problem.pattern);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const unsigned int at = i * dim + d;
          const double       stiffness =
            problem.matrix.values[(diagonal[i] * dim + d) * dim + d];
          for (unsigned int r = 0; r < n_modes; ++r)
            for (unsigned int s = 0; s < n_modes; ++s)
              {
                parts[part[i]].energy(r, s) += modes[r][at] * products[s][at];
                parts[part[i]].scale(r, s) +=
                  modes[r][at] * stiffness * modes[s][at];
              }
        }
    for (auto &it : parts)
      it.check();
  }

  template void check_rigid_modes(const LinearProblem<2> &);
  template void check_rigid_modes(const LinearProblem<3> &);
} // namespace Impoint
