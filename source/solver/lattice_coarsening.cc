#include <impoint/solver/lattice_coarsening.h>
#include <impoint/solver/shared_places.h>

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
    const NodeExchange            &nodes,
    const Lattice                 &lattice,
    const std::vector<SplineLine> &lines)
  {
    for (const SplineLine &line : lines)
      coarse_lines.emplace_back(line.degree, (line.n_cells + 1) / 2);
    build(pattern, nodes, [&](const unsigned int node, const unsigned int d) {
      Parents parents;
      parents.n = lines[d].refine(coarse_lines[d],
                                  lattice[node][d],
                                  parents.first,
                                  parents.factors);
      return parents;
    });
  }

  template <int dim>
  LatticeCoarsening<dim>::LatticeCoarsening(const BlockPattern         &pattern,
                                            const NodeExchange         &nodes,
                                            const CoveringLattice<dim> &lattice)
    : coarse_lines(lattice.lines)
  {
    build(pattern, nodes, [&](const unsigned int node, const unsigned int d) {
      const double place = lattice.places[node][d];
      Parents      parents;
      parents.first      = static_cast<int>(place);
      parents.factors[1] = place - parents.first;
      parents.factors[0] = 1 - parents.factors[1];
      parents.n          = parents.factors[1] > 0 ? 2 : 1;
      return parents;
    });
  }

  template <int dim>
  template <typename ParentsOf>
  void LatticeCoarsening<dim>::build(const BlockPattern &pattern,
                                     const NodeExchange &nodes,
                                     const ParentsOf    &parents_of)
  {
    find_parents(pattern.n_rows() + nodes.n_ghosts(), parents_of);
    if (!nodes.alone())
      share_parents(nodes.communicator(), pattern.n_rows());
    find_half_products(pattern);
    const Children children = find_children();
    build_pattern(children);
    find_targets(children);
    if (!nodes.alone())
      own_rows();
  }

  template <int dim>
  template <typename ParentsOf>
  void LatticeCoarsening<dim>::find_parents(const std::size_t n_nodes,
                                            const ParentsOf  &parents_of)
  {
    // Parents first as places, then numbered in lexicographic order.
    Lattice places;
    parent_start.assign(1, 0);
    for (unsigned int node = 0; node < n_nodes; ++node)
      {
        Parents      found[dim];
        unsigned int n_parents = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            found[d] = parents_of(node, d);
            n_parents *= found[d].n;
          }
        for (unsigned int i = 0; i < n_parents; ++i)
          {
            std::array<int, dim> place;
            double               weight = 1;
            for (unsigned int d = 0, rest = i; d < dim; rest /= found[d].n, ++d)
              {
                place[d] = found[d].first + rest % found[d].n;
                weight *= found[d].factors[rest % found[d].n];
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

  /** Numbers what this rank owns of the coarse nodes first, then ghosts. */
  template <int dim>
  void LatticeCoarsening<dim>::share_parents(const MPI_Comm     comm,
                                             const unsigned int n_owned)
  {
    std::vector<char> claimed(coarse_lattice.size(), false);
    for (std::size_t link = 0; link < parent_start[n_owned]; ++link)
      claimed[parents[link]] = true;
    const SharedPlaces<dim> shared(comm, coarse_lattice, claimed);
    part_nodes = NodeExchange(comm, shared.n_owned, shared.ghosts);

    Lattice                   sorted;
    std::vector<unsigned int> position(coarse_lattice.size());
    for (const unsigned int place : shared.order)
      {
        position[place] = sorted.size();
        sorted.push_back(coarse_lattice[place]);
      }
    coarse_lattice = sorted;
    for (unsigned int &parent : parents)
      parent = position[parent];
  }

  /** From the nodes of the part to those of the rows. */
  template <int dim>
  void LatticeCoarsening<dim>::own_rows()
  {
    rows.new_pattern(part_pattern, part_nodes);
    const unsigned int  n_owned = rows.pattern().n_rows();
    std::vector<double> places;
    for (unsigned int node = 0; node < n_owned; ++node)
      places.insert(places.end(),
                    coarse_lattice[node].begin(),
                    coarse_lattice[node].end());
    coarse_lattice.resize(n_owned + rows.nodes().n_ghosts());
    places.resize(coarse_lattice.size() * dim);
    rows.nodes().update(places);
    for (std::size_t i = 0; i < places.size(); ++i)
      coarse_lattice[i / dim][i % dim] = static_cast<int>(places[i]);
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
    Children          children;
    const std::size_t n_links = parent_start[half_product.n_rows()];
    children.start.assign(coarse_lattice.size() + 1, 0);
    children.nodes.resize(n_links);
    children.links.resize(n_links);
    for (std::size_t link = 0; link < n_links; ++link)
      ++children.start[parents[link] + 1];
    for (std::size_t node = 0; node < coarse_lattice.size(); ++node)
      children.start[node + 1] += children.start[node];

    std::vector<std::size_t> next(children.start.begin(),
                                  children.start.end() - 1);
    for (unsigned int node = 0; node < half_product.n_rows(); ++node)
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
    part_pattern.row_start.assign(1, 0);
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
                part_pattern.columns.push_back(column);
              }
        std::sort(part_pattern.columns.begin() + part_pattern.row_start.back(),
                  part_pattern.columns.end());
        part_pattern.row_start.push_back(part_pattern.columns.size());
      }
  }

  template <int dim>
  void LatticeCoarsening<dim>::find_targets(const Children &children)
  {
    // Laid out child by child, parent by parent; filled by coarse rows, so
    // that one array tells where each column of the row stands.
    const unsigned int       n_fine = half_product.n_rows();
    std::vector<std::size_t> start(parent_start[n_fine] + 1, 0);
    for (unsigned int node = 0; node < n_fine; ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        start[link + 1] = start[link] + half_product.row_start[node + 1] -
                          half_product.row_start[node];
    target.resize(start.back());

    std::vector<unsigned int> place(coarse_lattice.size());
    for (unsigned int row = 0; row < coarse_lattice.size(); ++row)
      {
        for (std::size_t k = part_pattern.row_start[row];
             k < part_pattern.row_start[row + 1];
             ++k)
          place[part_pattern.columns[k]] = k;
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
    BlockMatrix<dim> part;
    multiply(fine, rows.nodes().alone() ? coarse : part);
    if (!rows.nodes().alone())
      rows.add_up(part, coarse);
  }

  /** This rank's part of the product. */
  template <int dim>
  void LatticeCoarsening<dim>::multiply(const BlockMatrix<dim> &fine,
                                        BlockMatrix<dim>       &part) const
  {
    constexpr std::size_t block = dim * dim;
    part.reinit(part_pattern);

    const unsigned short *half_position = half_target.data();
    const unsigned int   *position      = target.data();
    std::vector<double>   row; // of A P
    for (unsigned int node = 0; node < half_product.n_rows(); ++node)
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
              double       *sum = &part.values[*position++ * block];
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
    coarse.assign(std::size_t(part_pattern.n_rows()) * dim, 0.);
    for (std::size_t node = 0; node < half_product.n_rows(); ++node)
      for (std::size_t link = parent_start[node]; link < parent_start[node + 1];
           ++link)
        for (unsigned int d = 0; d < dim; ++d)
          coarse[static_cast<std::size_t>(parents[link]) * dim + d] +=
            weights[link] * fine[node * dim + d];
    part_nodes.add(coarse);
  }

  template <int dim>
  void LatticeCoarsening<dim>::prolongate(std::vector<double> &coarse,
                                          std::vector<double> &fine) const
  {
    coarse.resize(std::size_t(part_pattern.n_rows()) * dim);
    part_nodes.update(coarse);
    for (std::size_t node = 0; node < half_product.n_rows(); ++node)
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
    return rows.nodes().alone() ? part_pattern : rows.pattern();
  }

  template <int dim>
  const NodeExchange &LatticeCoarsening<dim>::nodes() const
  {
    return rows.nodes();
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
