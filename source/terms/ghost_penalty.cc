#include <impoint/terms/ghost_penalty.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <map>

namespace Impoint
{
  namespace
  {
    // A cell filled by less than this part is held by its neighbours. Measured
    // on cut cantilevers: 0.3 keeps the worst cut as near to the others as 1
    // does, and disturbs less.
    constexpr double enough = 0.3;

    // Of a cell without material, where the scene asks for nothing else: as
    // stiff as the material that it continues.
    constexpr double factor_of_empty = 1.;

    // Where contact has no material before it yet: enough to give nodes a place
    // and too little to throw what is on its way to the wall.
    constexpr double part_of_unreached = 1e-3;

    // Where a boundary of a kept grid rests.
    constexpr double part_of_resting = 1e-9;

    /** The softer one holds enough; a cell without material has no say. */
    double lower(const double a, const double b)
    {
      return a > 0 && b > 0 ? std::min(a, b) : std::max(a, b);
    }
  } // namespace



  template <int dim>
  GhostPenalty<dim>::GhostPenalty(const ActiveNodes<dim>    &active,
                                  const MaterialPoints<dim> &points)
    : active(active)
    , points(points)
  {}



  template <int dim>
  typename GhostPenalty<dim>::Content
  GhostPenalty<dim>::content(const unsigned int k) const
  {
    Content result;
    if (k >= active.n_material_cells())
      return result;
    const auto &range = points.ranges()[k];
    for (unsigned int p = range.begin; p < range.end; ++p)
      result.young = std::max(result.young, points.material(p).young());
    if (factor == 0.) // only whether there is material
      {
        result.filled = 1;
        return result;
      }
    double volume = 0, initial = 0, mass = 0;
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        const double *state = points.data(p);
        initial += state[points.slots().volume];
        volume += state[points.slots().volume] *
                  (points.carried().keeps_grid ?
                     1. :
                     determinant(points.deformation_gradient(p)));
        mass += state[points.slots().mass];
      }
    result.filled  = volume / (points.carried().thickness *
                              active.basis().grid().volume(active.cell(k)));
    result.density = mass / initial;
    return result;
  }



  template <int dim>
  void GhostPenalty<dim>::set_content(const unsigned int c,
                                      const Content     &value)
  {
    contents[c] = value;
    known.push_back(c);
  }



  /** Of active cells and their neighbours; filled < 0: the cell is not active.
   */
  template <int dim>
  void GhostPenalty<dim>::find_contents()
  {
    const auto &grid = active.basis().grid();
    Content     nothing;
    nothing.filled = -1;
    contents.resize(grid.n_cells(), nothing);
    for (const unsigned int c : known)
      contents[c] = nothing;
    known.clear();
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      set_content(active.cell(k), content(k));
    share_contents();
    for (unsigned int sweep = 0; sweep < dim; ++sweep)
      continue_material();
  }



  /** Cells without material continue that of their neighbours; those that
   * share but an edge or a vertex with it, by cells between. */
  template <int dim>
  void GhostPenalty<dim>::continue_material()
  {
    std::vector<std::pair<unsigned int, double>> found;
    for (unsigned int k = active.n_material_cells(); k < active.n_cells(); ++k)
      {
        const unsigned int c = active.cell(k);
        if (contents[c].young > 0)
          continue;
        double young = 0;
        for_neighbors(c, [&](const unsigned int, const unsigned int n) {
          young = std::max(young, contents[n].young);
        });
        if (young > 0)
          found.emplace_back(c, young);
      }
    for (const auto &cell : found)
      contents[cell.first].young = cell.second;
    share_contents();
  }



  /** Calls function(face, neighbour) for the cells of the grid that share a
   * face, or a part of one, with cell @p c. */
  template <int dim>
  template <typename Function>
  void GhostPenalty<dim>::for_neighbors(const unsigned int c,
                                        const Function    &function) const
  {
    const auto &cell = active.basis().grid().cell(c);
    for (const unsigned int f : cell->face_indices())
      {
        if (cell->at_boundary(f))
          continue;
        if (cell->neighbor(f)->is_active())
          function(f, cell->neighbor(f)->active_cell_index());
        else
          for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
            function(
              f, cell->neighbor_child_on_subface(f, s)->active_cell_index());
      }
  }



  /** Asks other ranks for their cells at faces of active ones. */
  template <int dim>
  void GhostPenalty<dim>::share_contents()
  {
    const auto &grid = active.basis().grid();
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
      return;
    std::map<unsigned int, std::vector<CellId::binary_type>> questions;
    std::map<unsigned int, std::vector<unsigned int>>        asked;
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      for_neighbors(active.cell(k),
                    [&](const unsigned int, const unsigned int n) {
                      const auto &neighbor = grid.cell(n);
                      if (!neighbor->is_ghost())
                        return;
                      questions[neighbor->subdomain_id()].push_back(
                        neighbor->id().template to_binary<dim>());
                      asked[neighbor->subdomain_id()].push_back(n);
                    });
    std::map<unsigned int, std::vector<Content>> answers;
    for (const auto &question :
         Utilities::MPI::some_to_some(grid.communicator(), questions))
      for (const auto &cell : question.second)
        answers[question.first].push_back(
          contents[grid.triangulation()
                     .create_cell_iterator(CellId(cell))
                     ->active_cell_index()]);
    for (const auto &answer :
         Utilities::MPI::some_to_some(grid.communicator(), answers))
      for (unsigned int i = 0; i < answer.second.size(); ++i)
        set_content(asked.at(answer.first)[i], answer.second[i]);
  }



  /** Whether this rank links the own active cell @p c with its neighbour at
   * @p n: each face once. Of faces with hanging nodes the finer cells do. */
  template <int dim>
  bool GhostPenalty<dim>::is_link(const unsigned int c,
                                  const unsigned int n) const
  {
    const auto &cell     = active.basis().grid().cell(c);
    const auto &neighbor = active.basis().grid().cell(n);
    if (neighbor->level() > cell->level() ||
        (neighbor->level() == cell->level() &&
         std::make_pair(cell->subdomain_id(), c) >
           std::make_pair(neighbor->subdomain_id(), n)))
      return false;
    return contents[n].filled >= 0 &&
           std::min(contents[c].filled, contents[n].filled) < enough &&
           lower(contents[c].young, contents[n].young) > 0;
  }



  /** Points of a kept grid fill what they filled at the start, and without a
   * factor it counts only where they are. */
  template <int dim>
  bool GhostPenalty<dim>::contents_stay()
  {
    if (!points.carried().keeps_grid &&
        !(factor == 0. && points.equally_stiff()))
      return false;
    std::vector<unsigned int> cells = {active.n_material_cells()};
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      cells.push_back(active.cell(k));
    last_cells.swap(cells);
    return Utilities::MPI::min(int(last_cells == cells),
                               active.basis().grid().communicator()) != 0;
  }



  template <int dim>
  void GhostPenalty<dim>::find_links(Links &links)
  {
    if (!contents_stay())
      {
        find_contents();
        find_faces();
      }
    first_link = links.size();
    for (const Face &face : faces)
      links.add({face.first, face.second});
  }



  template <int dim>
  void GhostPenalty<dim>::find_faces()
  {
    std::vector<Face> before;
    before.swap(faces);
    for (unsigned int k = 0; k < active.n_cells(); ++k)
      {
        const unsigned int c = active.cell(k);
        for_neighbors(c, [&](const unsigned int f, const unsigned int n) {
          if (!is_link(c, n))
            return;
          faces.push_back(make_face(c, f, n));
          // those of the same links stay, if no other link changes
          const std::size_t l = faces.size() - 1;
          if (l < before.size() && before[l].first == c &&
              before[l].second == n)
            faces.back().matrix.swap(before[l].matrix);
        });
      }
  }



  template <int dim>
  typename GhostPenalty<dim>::Face
  GhostPenalty<dim>::make_face(const unsigned int c,
                               const unsigned int f,
                               const unsigned int n) const
  {
    const auto    &grid = active.basis().grid();
    const Content &one = contents[c], &other = contents[n];
    const double   h = 0.5 * (grid.volume(c) + grid.volume(n)) /
                     grid.cell(c)->face(f)->measure();
    Face face;
    face.first    = c;
    face.second   = n;
    face.at_empty = std::min(one.filled, other.filled) == 0;
    face.stiffness =
      (face.at_empty ? std::max(factor, factor_of_empty) : factor) *
      lower(one.young, other.young) / (h * h);
    face.density = factor * lower(one.density, other.density);
    return face;
  }



  template <int dim>
  void GhostPenalty<dim>::set_reached(const std::vector<unsigned int> &reached)
  {
    for (unsigned int k = active.n_material_cells(); k < active.n_cells(); ++k)
      contents[active.cell(k)].reached =
        std::binary_search(reached.begin(), reached.end(), active.cell(k));
    share_contents();
    for (Face &face : faces)
      face.part = !face.at_empty || contents[face.first].reached ||
                      contents[face.second].reached ?
                    1. :
                  points.carried().keeps_grid ? part_of_resting :
                                                part_of_unreached;
  }



  template <int dim>
  void GhostPenalty<dim>::new_active_set()
  {
    for (unsigned int l = 0; l < faces.size(); ++l)
      integrate(l);
  }



  template <int dim>
  void GhostPenalty<dim>::integrate(const unsigned int l)
  {
    const auto           &basis = active.basis();
    const auto           &grid  = basis.grid();
    Face                 &face  = faces[l];
    const Quadrature<dim> rule =
      grid.simplicial() ?
        static_cast<Quadrature<dim>>(QGaussSimplex<dim>(basis.degree() + 1)) :
        static_cast<Quadrature<dim>>(QGauss<dim>(basis.degree() + 1));
    double rule_volume = 0;
    for (const double weight : rule.get_weights())
      rule_volume += weight;

    const unsigned int  n = active.nodes(group(l)).size();
    std::vector<double> support, difference(n);
    face.matrix.assign(n * n, 0.);
    const auto subtract =
      [&](const unsigned int c, const double sign, const Point<dim> &x) {
        support.resize(basis.support_size(c));
        basis.evaluate(c, grid.to_reference(c, x), support.data());
        const auto places = active.places(group(l), c);
        for (unsigned int a = 0; a < places.size(); ++a)
          difference[places[a]] += sign * support[a];
      };
    for (const unsigned int c : {face.first, face.second})
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<dim> x =
            grid.mapping().transform_unit_to_real_cell(grid.cell(c),
                                                       rule.point(q));
          std::fill(difference.begin(), difference.end(), 0.);
          subtract(face.first, 1., x);
          subtract(face.second, -1., x);
          const double weight = points.carried().thickness * rule.weight(q) /
                                rule_volume * grid.volume(c);
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              face.matrix[a * n + b] += weight * difference[a] * difference[b];
        }
  }



  template <int dim>
  void GhostPenalty<dim>::add(const unsigned int l, CellSystem &system) const
  {
    add_for_components<dim>(faces[l].matrix,
                            faces[l].part * faces[l].stiffness,
                            system.u,
                            1.,
                            system);
  }



  template <int dim>
  void GhostPenalty<dim>::add_mass(const unsigned int l,
                                   const double      *accelerations,
                                   const double       alpha,
                                   CellSystem        &system) const
  {
    add_for_components<dim>(
      faces[l].matrix, faces[l].density, accelerations, alpha, system);
  }

  template class GhostPenalty<2>;
  template class GhostPenalty<3>;
} // namespace Impoint
