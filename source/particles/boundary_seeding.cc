#include <impoint/base/parameter_file.h>
#include <impoint/particles/facet_cutter.h>
#include <impoint/particles/facets.h>
#include <impoint/particles/numbering.h>
#include <impoint/particles/seeding.h>
#include <impoint/particles/simplex_rules.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    // Particles that are closer to a face of the grid, relative to the cells'
    // size, lie on it. Above the tolerance of BackgroundGrid::find().
    const double particle_on_face = 4e-9;



    Quadrature<1> segment_rule(const BoundaryRule rule, const unsigned int n)
    {
      if (rule == BoundaryRule::equal)
        return QIterated<1>(QMidpoint<1>(), n);
      return QGauss<1>(n);
    }



    /** Rules to put particles on a segment (2D) or polygon (3D). */
    template <int dim>
    class FacetRule
    {
    public:
      using Particles = std::vector<SeededBoundaryParticle<dim>>;

      FacetRule(const BoundaryRule name, const unsigned int n)
        : n(n)
        , cut(name == BoundaryRule::cut)
        , line(segment_rule(name, n))
      {
        const bool gauss = name != BoundaryRule::equal;
        if (dim == 3 && gauss)
          triangle = simplex_rule_of_order<2>(n);
        else if (dim == 3)
          triangle = equal_triangles();
      }

      Particles particles(const Corners<dim> &corners) const
      {
        Particles list;
        if constexpr (dim == 2)
          {
            const Tensor<1, 2> side = corners[1] - corners[0];
            for (unsigned int q = 0; q < line.size(); ++q)
              add(list,
                  corners[0] + line.point(q)[0] * side,
                  line.weight(q) * cross_product_2d(side));
          }
        else if (corners.size() == 4 && (!cut || is_parallelogram(corners)))
          add_quadrilateral(corners, list);
        else
          add_fan(corners, list);
        return list;
      }

    private:
      static void add(Particles            &list,
                      const Point<dim>     &x,
                      const Tensor<1, dim> &area_vector)
      {
        const double area = area_vector.norm();
        if (!(area > 0))
          return;
        list.emplace_back();
        list.back().x      = x;
        list.back().area   = area;
        list.back().normal = area_vector / area;
      }

      /** Centroids of the n^2 equal triangles that make up a triangle. */
      Quadrature<2> equal_triangles() const
      {
        std::vector<Point<2>> points;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = 0; i + k < n; ++k)
            {
              points.emplace_back((i + 1. / 3) / n, (k + 1. / 3) / n);
              if (i + k + 1 < n)
                points.emplace_back((i + 2. / 3) / n, (k + 2. / 3) / n);
            }
        return Quadrature<2>(points,
                             std::vector<double>(points.size(),
                                                 0.5 / points.size()));
      }

      /** Bilinear, corners in order: the normal changes over a warped one. */
      void add_quadrilateral(const Corners<3> &corners, Particles &list) const
      {
        const Tensor<1, 3> right = corners[1] - corners[0];
        const Tensor<1, 3> up    = corners[3] - corners[0];
        const Tensor<1, 3> warp  = corners[2] - corners[1] - up;
        for (unsigned int k = 0; k < line.size(); ++k)
          for (unsigned int i = 0; i < line.size(); ++i)
            {
              const double s = line.point(i)[0], t = line.point(k)[0];
              add(list,
                  corners[0] + s * right + t * up + s * t * warp,
                  line.weight(i) * line.weight(k) *
                    cross_product_3d(right + t * warp, up + s * warp));
            }
      }

      void add_fan(const Corners<3> &corners, Particles &list) const
      {
        const double smallest = 1e-14 * area_vector(corners).norm();
        for (unsigned int i = 1; i + 1 < corners.size(); ++i)
          {
            const Tensor<1, 3> first  = corners[i] - corners[0];
            const Tensor<1, 3> second = corners[i + 1] - corners[0];
            const Tensor<1, 3> normal = cross_product_3d(first, second);
            if (0.5 * normal.norm() > smallest)
              for (unsigned int q = 0; q < triangle.size(); ++q)
                add(list,
                    corners[0] + triangle.point(q)[0] * first +
                      triangle.point(q)[1] * second,
                    triangle.weight(q) * normal);
          }
      }

      /** Whether a rule for squares is as exact on it as one for triangles. */
      static bool is_parallelogram(const Corners<3> &corners)
      {
        const Tensor<1, 3> warp =
          corners[2] - corners[1] - (corners[3] - corners[0]);
        return warp.norm() < 1e-12 * corners[2].distance(corners[0]);
      }

      const unsigned int n;
      const bool         cut;
      Quadrature<1>      line;
      Quadrature<2>      triangle;
    };



    template <int dim>
    std::vector<SeededBoundaryParticle<dim>>
    seed_cut(const std::vector<Corners<dim>> &facets,
             const FacetRule<dim>            &rule,
             const BackgroundGrid<dim>       &grid)
    {
      const FacetCutter<dim>                   cutter(grid);
      std::vector<SeededBoundaryParticle<dim>> mine;
      std::vector<ParticleGroup>               groups;
      for (unsigned int f = 0; f < facets.size(); ++f)
        for (const unsigned int c : cutter.cells_near(facets[f]))
          {
            const auto part = cutter.part_in(c, facets[f]);
            if (part.empty())
              continue;
            const auto particles = rule.particles(part);
            groups.push_back(
              {f, grid.cell(c)->id(), unsigned(particles.size())});
            for (auto particle : particles)
              {
                particle.cell = c;
                mine.push_back(particle);
              }
          }
      number_particles(groups, grid.communicator(), mine);
      return mine;
    }



    /** Corners of a cell's face, whose normal points out of the cell. */
    template <int dim>
    Corners<dim> corners_of(const BackgroundGrid<dim> &grid,
                            const unsigned int         c,
                            const unsigned int         f)
    {
      const auto   cell = grid.cell(c);
      const auto   face = cell->face(f);
      Corners<dim> corners;
      for (const unsigned int v : face->vertex_indices())
        corners.push_back(face->vertex(v));
      if (corners.size() == 4)
        std::swap(corners[2], corners[3]); // of a face line by line
      if (area_vector_of(corners) * (face->center() - cell->center()) < 0)
        std::reverse(corners.begin(), corners.end());
      return corners;
    }



    /** On the grid's sides with the boundary's id. */
    template <int dim>
    std::vector<SeededBoundaryParticle<dim>>
    seed_sides(const types::boundary_id   id,
               const FacetRule<dim>      &rule,
               const BackgroundGrid<dim> &grid)
    {
      std::vector<SeededBoundaryParticle<dim>> mine;
      std::vector<ParticleGroup>               groups;
      for (unsigned int c = 0; c < grid.n_cells(); ++c)
        if (grid.is_owned(c))
          for (const unsigned int f : grid.cell(c)->face_indices())
            if (grid.cell(c)->face(f)->at_boundary() &&
                grid.cell(c)->face(f)->boundary_id() == id)
              {
                const auto particles = rule.particles(corners_of(grid, c, f));
                groups.push_back(
                  {f, grid.cell(c)->id(), unsigned(particles.size())});
                for (auto particle : particles)
                  {
                    particle.cell = c;
                    mine.push_back(particle);
                  }
              }
      number_particles(groups, grid.communicator(), mine);
      return mine;
    }



    /** Those of @p all not yet @p found that lie, moved by @p nudge times their
     * normals, in own cells; notes which ones any rank found. Collective. */
    template <int dim>
    void find_particles(const std::vector<SeededBoundaryParticle<dim>> &all,
                        const double                                    nudge,
                        const BackgroundGrid<dim>                      &grid,
                        std::vector<unsigned int>                      &found,
                        std::vector<SeededBoundaryParticle<dim>>       &mine)
    {
      Point<dim> xi;
      for (std::size_t b = 0; b < all.size(); ++b)
        if (found[b] == 0)
          {
            const unsigned int c =
              grid.find(all[b].x + nudge * all[b].normal, xi);
            if (c == grid.nowhere || !grid.is_owned(c))
              continue;
            found[b] = 1;
            mine.push_back(all[b]);
            mine.back().cell = c;
          }
      Utilities::MPI::max(found, grid.communicator(), found);
    }



    template <int dim>
    std::vector<SeededBoundaryParticle<dim>>
    seed_uncut(const std::vector<Corners<dim>> &facets,
               const FacetRule<dim>            &rule,
               const BackgroundGrid<dim>       &grid)
    {
      std::vector<SeededBoundaryParticle<dim>> all, mine;
      for (const auto &facet : facets)
        for (auto particle : rule.particles(facet))
          {
            particle.number = all.size();
            all.push_back(particle);
          }
      std::vector<unsigned int> found(all.size(), 0);
      const double nudge = -particle_on_face * grid.smallest_size();
      find_particles(all, nudge, grid, found, mine);
      find_particles(all, 0., grid, found, mine); // on the grid's own border
      std::sort(mine.begin(), mine.end(), [](const auto &a, const auto &b) {
        return a.number < b.number;
      });

      // Those outside of the grid leave no gaps in the numbers.
      std::vector<std::size_t> numbers(all.size());
      std::size_t              next = 0;
      for (std::size_t b = 0; b < all.size(); ++b)
        numbers[b] = found[b] == 1 ? next++ : 0;
      for (auto &particle : mine)
        particle.number = numbers[particle.number];
      return mine;
    }
  } // namespace



  template <int dim>
  std::vector<SeededBoundaryParticle<dim>>
  seed_boundary(const ParameterFile       &file,
                const BoundaryParameters  &boundary,
                const BackgroundGrid<dim> &grid)
  {
    const bool           sides = boundary.conforming;
    const FacetRule<dim> rule(sides ? BoundaryRule::gauss : boundary.rule,
                              boundary.particles_per_segment);
    if (sides)
      {
        const auto mine = seed_sides(boundary.boundary_id, rule, grid);
        if (Utilities::MPI::sum(mine.size(), grid.communicator()) == 0)
          throw boundary.no_such_side(file);
        return mine;
      }
    const auto facets = make_facets<dim>(file, boundary);
    const auto mine   = boundary.rule == BoundaryRule::cut ?
                          seed_cut(flat_facets(facets), rule, grid) :
                          seed_uncut(facets, rule, grid);
    if (Utilities::MPI::sum(mine.size(), grid.communicator()) == 0)
      throw file.error(boundary.polyline.empty() ?
                         boundary.mesh.source_entry() :
                         boundary.section + "/Polyline",
                       "the whole boundary '" + boundary.name +
                         "' lies outside of the grid",
                       "Move it into the grid, or enlarge the grid.");
    return mine;
  }

  template std::vector<SeededBoundaryParticle<2>>
  seed_boundary(const ParameterFile &,
                const BoundaryParameters &,
                const BackgroundGrid<2> &);
  template std::vector<SeededBoundaryParticle<3>>
  seed_boundary(const ParameterFile &,
                const BoundaryParameters &,
                const BackgroundGrid<3> &);
} // namespace Impoint
