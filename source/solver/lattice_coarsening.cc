#include <impoint/solver/lattice_coarsening.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/types.h>

#include <algorithm>
#include <limits>

namespace Impoint
{
  using namespace dealii;

  template <int dim>
  LatticeCoarsening<dim>::LatticeCoarsening(
    const BlockPattern            &pattern,
    const Lattice                 &lattice,
    const std::vector<SplineLine> &lines)
  {
    for (const SplineLine &line : lines)
      coarse_lines.emplace_back(line.degree, (line.n_cells + 1) / 2);
    find_parents(lattice, lines);
    find_half_products(pattern);
    const Children children = find_children();
    build_pattern(children);
    find_targets(children);
  }

  template <int dim>
  void
  LatticeCoarsening<dim>::find_parents(const Lattice                 &lattice,
                                       const std::vector<SplineLine> &lines)
  {
    // Parents first as places, then numbered in lexicographic order.
    Lattice places;
    parent_start.assign(1, 0);
    for (const std::array<int, dim> &node : lattice)
      {
        int          first[dim], n[dim];
        double       factors[dim][SplineLine::max_degree + 1];
        unsigned int n_parents = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            n[d] =
              lines[d].refine(coarse_lines[d], node[d], first[d], factors[d]);
            n_parents *= n[d];
          }
        for (unsigned int i = 0; i < n_parents; ++i)
          {
            std::array<int, dim> place;
            double               weight = 1;
            for (unsigned int d = 0, rest = i; d < dim; rest /= n[d], ++d)
              {
                place[d] = first[d] + rest % n[d];
                weight *= factors[d][rest % n[d]];
              }
            places.push_back(place);
            weights.push_back(weight);
          }
        parent_start.push_back(places.size());
      }

    coarse_lattice = places;
    std::sort(coarse_lattice.begin(), coarse_lattice.end());
    coarse_lattice.erase(std::unique(coarse_lattice.begin(),
                                     coarse_lattice.end()),
                         coarse_lattice.end());
    for (const std::array<int, dim> &place : places)
      parents.push_back(
        std::lower_bound(coarse_lattice.begin(), coarse_lattice.end(), place) -
        coarse_lattice.begin());
  }

  template <int dim>
  void LatticeCoarsening<dim>::find_half_products(const BlockPattern &fine)
  {
    std::vector<unsigned int> place(coarse_lattice.size(),
                                    numbers::invalid_unsigned_int);
    half_product.row_start.assign(1, 0);
    for (unsigned int node = 0; node < fine.n_rows(); ++node)
      {
        const std::size_t begin = half_product.columns.size();
        for (std::size_t k = fine.row_start[node]; k < fine.row_start[node + 1];
             ++k)
          for (std::size_t parent = parent_start[fine.columns[k]];
               parent < parent_start[fine.columns[k] + 1];
               ++parent)
            {
              unsigned int &column = place[parents[parent]];
              if (column == numbers::invalid_unsigned_int)
                {
                  column = half_product.columns.size() - begin;
                  half_product.columns.push_back(parents[parent]);
                }
              Assert(column <= std::numeric_limits<unsigned short>::max(),
                     ExcInternalError());
              half_target.push_back(column);
            }
        for (std::size_t k = begin; k < half_product.columns.size(); ++k)
          place[half_product.columns[k]] = numbers::invalid_unsigned_int;
        half_product.row_start.push_back(half_product.columns.size());
      }
  }

  template <int dim>
  typename LatticeCoarsening<dim>::Children
  LatticeCoarsening<dim>::find_children() const
  {
    Children children;
    children.start.assign(coarse_lattice.size() + 1, 0);
    children.nodes.resize(parents.size());
    children.links.resize(parents.size());
    for (const unsigned int parent : parents)
      ++children.start[parent + 1];
    for (std::size_t node = 0; node < coarse_lattice.size(); ++node)
      children.start[node + 1] += children.start[node];

    std::vector<std::size_t> next(children.start.begin(),
                                  children.start.end() - 1);
    for (unsigned int node = 0; node + 1 < parent_start.size(); ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        {
          const std::size_t position = next[parents[link]]++;
          children.nodes[position]   = node;
          children.links[position]   = link;
        }
    return children;
  }

  template <int dim>
  void LatticeCoarsening<dim>::build_pattern(const Children &children)
  {
    std::vector<unsigned int> last_row(coarse_lattice.size(),
                                       numbers::invalid_unsigned_int);
    coarse_pattern.row_start.assign(1, 0);
    for (unsigned int row = 0; row < coarse_lattice.size(); ++row)
      {
        for (std::size_t c = children.start[row]; c < children.start[row + 1];
             ++c)
          for (std::size_t k = half_product.row_start[children.nodes[c]];
               k < half_product.row_start[children.nodes[c] + 1];
               ++k)
            if (const unsigned int column = half_product.columns[k];
                last_row[column] != row)
              {
                last_row[column] = row;
                coarse_pattern.columns.push_back(column);
              }
        std::sort(coarse_pattern.columns.begin() +
                    coarse_pattern.row_start.back(),
                  coarse_pattern.columns.end());
        coarse_pattern.row_start.push_back(coarse_pattern.columns.size());
      }
  }

  template <int dim>
  void LatticeCoarsening<dim>::find_targets(const Children &children)
  {
    // Laid out child by child, parent by parent; filled by coarse rows, so
    // that one array tells where each column of the row stands.
    std::vector<std::size_t> start(parents.size() + 1, 0);
    for (unsigned int node = 0; node + 1 < parent_start.size(); ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        start[link + 1] = start[link] + half_product.row_start[node + 1] -
                          half_product.row_start[node];
    target.resize(start.back());

    std::vector<unsigned int> place(coarse_lattice.size());
    for (unsigned int row = 0; row < coarse_lattice.size(); ++row)
      {
        for (std::size_t k = coarse_pattern.row_start[row];
             k < coarse_pattern.row_start[row + 1];
             ++k)
          place[coarse_pattern.columns[k]] = k;
        for (std::size_t c = children.start[row]; c < children.start[row + 1];
             ++c)
          {
            std::size_t position = start[children.links[c]];
            for (std::size_t k = half_product.row_start[children.nodes[c]];
                 k < half_product.row_start[children.nodes[c] + 1];
                 ++k)
              target[position++] = place[half_product.columns[k]];
          }
      }
  }

  template <int dim>
  void LatticeCoarsening<dim>::galerkin(const BlockMatrix<dim> &fine,
                                        BlockMatrix<dim>       &coarse) const
  {
    constexpr std::size_t block = dim * dim;
    coarse.reinit(coarse_pattern);

    const unsigned short *half_position = half_target.data();
    const unsigned int   *position      = target.data();
    std::vector<double>   row; // of A P
    for (unsigned int node = 0; node + 1 < parent_start.size(); ++node)
      {
        const std::size_t n_columns =
          half_product.row_start[node + 1] - half_product.row_start[node];
        row.assign(n_columns * block, 0.);
        for (std::size_t k = fine.pattern->row_start[node];
             k < fine.pattern->row_start[node + 1];
             ++k)
          {
            const double      *a      = &fine.values[k * block];
            const unsigned int column = fine.pattern->columns[k];
            for (std::size_t link = parent_start[column];
                 link < parent_start[column + 1];
                 ++link)
              {
                double      *sum    = &row[*half_position++ * block];
                const double weight = weights[link];
                for (unsigned int i = 0; i < block; ++i)
                  sum[i] += weight * a[i];
              }
          }
        for (std::size_t link = parent_start[node];
             link < parent_start[node + 1];
             ++link)
          for (std::size_t column = 0; column < n_columns; ++column)
            {
              double       *sum = &coarse.values[*position++ * block];
              const double *a   = &row[column * block];
              for (unsigned int i = 0; i < block; ++i)
                sum[i] += weights[link] * a[i];
            }
      }
  }

  template <int dim>
  void LatticeCoarsening<dim>::restrict(const std::vector<double> &fine,
                                        std::vector<double>       &coarse) const
  {
    coarse.assign(coarse_lattice.size() * dim, 0.);
    for (std::size_t node = 0; node + 1 < parent_start.size(); ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        for (unsigned int d = 0; d < dim; ++d)
          coarse[static_cast<std::size_t>(parents[link]) * dim + d] +=
            weights[link] * fine[node * dim + d];
  }

  template <int dim>
  void LatticeCoarsening<dim>::prolongate(const std::vector<double> &coarse,
                                          std::vector<double>       &fine) const
  {
    for (std::size_t node = 0; node + 1 < parent_start.size(); ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        for (unsigned int d = 0; d < dim; ++d)
          fine[node * dim + d] +=
            weights[link] *
            coarse[static_cast<std::size_t>(parents[link]) * dim + d];
  }

  template <int dim>
  const BlockPattern &LatticeCoarsening<dim>::pattern() const
  {
    return coarse_pattern;
  }

  template <int dim>
  const typename LatticeCoarsening<dim>::Lattice &
  LatticeCoarsening<dim>::lattice() const
  {
    return coarse_lattice;
  }

  template <int dim>
  const std::vector<SplineLine> &LatticeCoarsening<dim>::lines() const
  {
    return coarse_lines;
  }

  template class LatticeCoarsening<2>;
  template class LatticeCoarsening<3>;
} // namespace Impoint
