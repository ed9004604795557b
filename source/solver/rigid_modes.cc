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
  } // namespace



  template <int dim>
  void check_rigid_modes(const LinearProblem<dim> &problem)
  {
    constexpr unsigned int    n_modes = dim * (dim + 1) / 2;
    std::vector<unsigned int> part;
    const unsigned int        n_parts = connected_parts(problem.pattern, part);
    const unsigned int        n       = problem.pattern.n_rows();

    std::vector<Point<dim>> centre(n_parts);
    std::vector<double>     count(n_parts, 0.), extent(n_parts, 0.);
    for (unsigned int i = 0; i < n; ++i)
      {
        centre[part[i]] += problem.points[i];
        count[part[i]] += 1;
      }
    for (unsigned int c = 0; c < n_parts; ++c)
      centre[c] /= count[c];
    for (unsigned int i = 0; i < n; ++i)
      extent[part[i]] =
        std::max(extent[part[i]], centre[part[i]].distance(problem.points[i]));

    // A held unknown has nothing but its diagonal in its row; modes vanish
    // there, and the mode's energy is that of what is left.
    std::vector<std::vector<double>> modes(n_modes), products(n_modes);
    std::vector<double>              diagonal(n * dim), row_sum(n * dim, 0.);
    for (unsigned int i = 0; i < n; ++i)
      for (std::size_t q = problem.pattern.row_start[i];
           q < problem.pattern.row_start[i + 1];
           ++q)
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int s = 0; s < dim; ++s)
            {
              const double value =
                problem.matrix.values[(q * dim + r) * dim + s];
              if (problem.pattern.columns[q] == i && r == s)
                diagonal[i * dim + r] = value;
              else
                row_sum[i * dim + r] += std::abs(value);
            }
    for (unsigned int m = 0; m < n_modes; ++m)
      {
        modes[m].resize(n * dim);
        products[m].resize(n * dim);
        for (unsigned int i = 0; i < n; ++i)
          {
            const Point<dim> place(
              (problem.points[i] - centre[part[i]]) /
              std::max(extent[part[i]], std::numeric_limits<double>::min()));
            const Tensor<1, dim> value = rigid_mode<dim>(m, place);
            for (unsigned int d = 0; d < dim; ++d)
              modes[m][i * dim + d] = row_sum[i * dim + d] > 0 ? value[d] : 0.;
          }
        problem.matrix.vmult(modes[m].data(), products[m].data());
      }

    for (unsigned int c = 0; c < n_parts; ++c)
      {
        LAPACKFullMatrix<double> energy(n_modes), scale(n_modes);
        energy = 0;
        scale  = 0;
        for (unsigned int i = 0; i < n; ++i)
          if (part[i] == c)
            for (unsigned int r = 0; r < n_modes; ++r)
              for (unsigned int s = 0; s < n_modes; ++s)
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    const unsigned int at = i * dim + d;
                    energy(r, s) += modes[r][at] * products[s][at];
                    scale(r, s) += modes[r][at] * diagonal[at] * modes[s][at];
                  }
        // a mode that is held everywhere has no scale of its own
        for (unsigned int r = 0; r < n_modes; ++r)
          if (scale(r, r) <= 0)
            {
              energy(r, r) = 1;
              scale(r, r)  = 1;
            }
        std::vector<Vector<double>> vectors(n_modes, Vector<double>(n_modes));
        energy.compute_generalized_eigenvalues_symmetric(scale, vectors);
        for (unsigned int m = 0; m < n_modes; ++m)
          if (energy.eigenvalue(m).real() < smallest_stiffness)
            {
              std::ostringstream text;
              text
                << "the material around (" << centre[c] << ") "
                << name_of_mode<dim>({vectors[m].begin(), vectors[m].end()})
                << ": no boundary holds it, and statics has no answer. Add a "
                   "boundary, or set 'Kind = dynamic' in section 'Time'";
              throw RunFailed(text.str());
            }
      }
  }

  template void check_rigid_modes(const LinearProblem<2> &);
  template void check_rigid_modes(const LinearProblem<3> &);
} // namespace Impoint
