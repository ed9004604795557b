// Which cell holds a place: the searches of BackgroundGrid.

#include <impoint/grid/background_grid_tree.h>

#include <algorithm>

namespace Impoint
{
  template <int dim>
  Point<dim>
  BackgroundGrid<dim>::to_reference_curved(const unsigned int c,
                                           const Point<dim>  &x,
                                           const Point<dim>  &linear) const
  {
    try
      {
        return map->transform_real_to_unit_cell(iterators[c], x);
      }
    catch (const typename Mapping<dim>::ExcTransformationFailed &)
      {
        // Far from the cell the bilinear map has no inverse; the map of its
        // first corner still tells which face to leave through.
        return linear;
      }
  }



  template <int dim>
  void BackgroundGrid<dim>::order_faces(const Point<dim>            &xi,
                                        std::array<unsigned int, 6> &faces,
                                        unsigned int &n_violated) const
  {
    // Insertion keeps the worst violation first.
    std::array<double, 6> violations;
    n_violated     = 0;
    const auto add = [&](const double violation, const unsigned int face) {
      if (violation <= 0)
        return;
      unsigned int place = n_violated++;
      for (; place > 0 && violations[place - 1] < violation; --place)
        {
          violations[place] = violations[place - 1];
          faces[place]      = faces[place - 1];
        }
      violations[place] = violation;
      faces[place]      = face;
    };
    double sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        add(-xi[d], is_simplicial ? opposite_face[d + 1] : 2 * d);
        if (!is_simplicial)
          add(xi[d] - 1, 2 * d + 1);
        sum += xi[d];
      }
    if (is_simplicial)
      add(sum - 1, opposite_face[0]);
  }



  template <int dim>
  unsigned int BackgroundGrid<dim>::next_cell(const unsigned int c,
                                              const unsigned int face,
                                              const Point<dim>  &x) const
  {
    const unsigned int neighbor = neighbors[c * n_faces + face];
    if (neighbor != refined)
      return neighbor;
    unsigned int best     = nowhere;
    double       smallest = std::numeric_limits<double>::max();
    const auto  &cell     = iterators[c];
    for (unsigned int s = 0; s < cell->face(face)->n_children(); ++s)
      {
        const auto child = cell->neighbor_child_on_subface(face, s);
        if (!child->is_active() || child->is_artificial())
          continue;
        const unsigned int candidate = child->active_cell_index();
        const double       distance  = outside_by(to_reference(candidate, x));
        if (distance < smallest)
          {
            smallest = distance;
            best     = candidate;
          }
      }
    return best;
  }



  template <int dim>
  void BackgroundGrid<dim>::Tree::list_lattice(const BackgroundGrid &grid)
  {
    constexpr std::size_t most_places = 4; // a cell: else mostly holes
    std::size_t           n           = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n *= grid.frame.n_cells[d];
    if (!grid.frame.exists || n > most_places * grid.n_cells())
      return;
    lattice.assign(n, nowhere);
    for (unsigned int c = 0; c < grid.n_cells(); ++c)
      if (grid.is_known(c))
        {
          const auto  place = grid.lattice_place(c);
          std::size_t index = 0;
          for (unsigned int d = 0; d < dim; ++d)
            index = index * grid.frame.n_cells[d] + place[d];
          lattice[index] = c;
        }
  }



  template <int dim>
  Tensor<1, dim> BackgroundGrid<dim>::Tree::nudge(const BackgroundGrid &grid)
  {
    Tensor<1, dim>   result;
    constexpr double direction[3] = {0.7315, 0.5231, 0.4379};
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = 1e-9 * grid.h_min * direction[d];
    return result;
  }



  template <int dim>
  unsigned int
  BackgroundGrid<dim>::Tree::cell_on_lattice(const BackgroundGrid &grid,
                                             const Point<dim>     &x) const
  {
    if (lattice.empty())
      return nowhere;
    const Tensor<1, dim> place = grid.frame.coordinates(x + nudge(grid));
    std::size_t          index = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const int n = grid.frame.n_cells[d];
        if (!(place[d] >= 0 && place[d] < n))
          return nowhere;
        index = index * n + static_cast<std::size_t>(place[d]);
      }
    return lattice[index];
  }



  template <int dim>
  unsigned int BackgroundGrid<dim>::walk(const Point<dim>  &x,
                                         const unsigned int start,
                                         Point<dim>        &xi) const
  {
    const unsigned int direct = tree->cell_on_lattice(*this, x);
    if (direct != nowhere)
      {
        xi = to_reference(direct, x);
        if (is_inside(xi))
          return direct;
      }
    unsigned int                c = start, previous = nowhere;
    std::array<unsigned int, 6> faces;
    for (unsigned int step = 0; step < 1000; ++step)
      {
        xi = to_reference(c, x);
        if (is_inside(xi))
          return c;
        unsigned int n_violated = 0, next = nowhere;
        order_faces(xi, faces, n_violated);
        for (unsigned int i = 0; i < n_violated && next == nowhere; ++i)
          {
            next = next_cell(c, faces[i], x);
            if (next == previous) // a point within round-off of a face
              next = nowhere;
          }
        if (next == nowhere)
          break;
        previous = c;
        c        = next;
      }
    return find(x, xi);
  }



  template <int dim>
  unsigned int BackgroundGrid<dim>::find(const Point<dim> &x,
                                         Point<dim>       &xi) const
  {
    const unsigned int direct = tree->cell_on_lattice(*this, x);
    if (direct != nowhere)
      {
        xi = to_reference(direct, x);
        return direct;
      }
    const Tensor<1, dim> nudge = Tree::nudge(*this);
    const auto candidates      = cells_near(x - 2. * nudge, x + 2. * nudge);
    for (const double sign : {1., -1., 0.})
      for (const unsigned int c : candidates)
        if (is_inside(to_reference(c, x + sign * nudge),
                      sign == 0. ? 1e-9 : 1e-14))
          {
            xi = to_reference(c, x);
            return c;
          }
    return nowhere;
  }

  template void
  BackgroundGrid<2>::Tree::list_lattice(const BackgroundGrid<2> &);
  template void
  BackgroundGrid<3>::Tree::list_lattice(const BackgroundGrid<3> &);
  template Point<2>
  BackgroundGrid<2>::to_reference_curved(const unsigned int,
                                         const Point<2> &,
                                         const Point<2> &) const;
  template Point<3>
  BackgroundGrid<3>::to_reference_curved(const unsigned int,
                                         const Point<3> &,
                                         const Point<3> &) const;
  template unsigned int BackgroundGrid<2>::walk(const Point<2> &,
                                                const unsigned int,
                                                Point<2> &) const;
  template unsigned int BackgroundGrid<3>::walk(const Point<3> &,
                                                const unsigned int,
                                                Point<3> &) const;
  template unsigned int BackgroundGrid<2>::find(const Point<2> &,
                                                Point<2> &) const;
  template unsigned int BackgroundGrid<3>::find(const Point<3> &,
                                                Point<3> &) const;
} // namespace Impoint
