// Which cell holds a place: the searches of BackgroundGrid.

#include <impoint/grid/background_grid.h>

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
  unsigned int BackgroundGrid<dim>::walk(const Point<dim>  &x,
                                         const unsigned int start,
                                         Point<dim>        &xi) const
  {
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
    // On a face several cells hold x. A nudge in a direction that is parallel
    // to no face chooses the same one of them on every rank.
    Tensor<1, dim> nudge;
    const double   direction[3] = {0.7315, 0.5231, 0.4379};
    for (unsigned int d = 0; d < dim; ++d)
      nudge[d] = 1e-9 * h_min * direction[d];

    const auto candidates = cells_near(x - 2. * nudge, x + 2. * nudge);
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
