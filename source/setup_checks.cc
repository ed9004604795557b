#include <impoint/base/parameter_file.h>
#include <impoint/particles/facet_cutter.h>
#include <impoint/particles/facets.h>
#include <impoint/setup_checks.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    /** A boundary particle as numbers that ranks exchange: place, normal,
     * area. */
    template <int dim>
    using ParticleNumbers = std::array<double, 2 * dim + 1>;

    /** How much of a boundary has material near, and on the outer side. */
    struct JudgedArea
    {
      double all = 0, wrong = 0;
    };



    template <int dim>
    std::vector<ParticleNumbers<dim>>
    as_numbers(const BoundaryParticles<dim> &boundary)
    {
      std::vector<ParticleNumbers<dim>> own(boundary.n());
      for (unsigned int b = 0; b < boundary.n(); ++b)
        {
          for (unsigned int d = 0; d < dim; ++d)
            {
              own[b][d]       = boundary.position(b)[d];
              own[b][dim + d] = boundary.vector(b, boundary.slots().normal)[d];
            }
          own[b][2 * dim] = boundary.area(b);
        }
      return own;
    }



    /** Of this rank's points within @p reach of a particle: sum of volume
     * times distance on the outer side, and of volume. */
    template <int dim>
    std::array<double, 2>
    material_at(const ParticleNumbers<dim>      &particle,
                const MaterialPoints<dim>       &points,
                const BackgroundGrid<dim>       &grid,
                const std::vector<unsigned int> &range_of_cell,
                const double                     reach)
    {
      Point<dim>     x, lower, upper;
      Tensor<1, dim> normal;
      for (unsigned int d = 0; d < dim; ++d)
        {
          x[d]      = particle[d];
          normal[d] = particle[dim + d];
          lower[d]  = x[d] - reach;
          upper[d]  = x[d] + reach;
        }
      std::array<double, 2> sums = {};
      for (const unsigned int c : grid.cells_near(lower, upper))
        {
          if (range_of_cell[c] == BackgroundGrid<dim>::nowhere)
            continue;
          const auto &range = points.ranges()[range_of_cell[c]];
          for (unsigned int p = range.begin; p < range.end; ++p)
            {
              const Tensor<1, dim> away = points.position(p) - x;
              if (away.norm() > reach)
                continue;
              const double volume = points.data(p)[points.slots().volume];
              sums[0] += volume * (away * normal);
              sums[1] += volume;
            }
        }
      return sums;
    }



    template <int dim>
    JudgedArea judge_normals(const BoundaryParticles<dim> &boundary,
                             const MaterialPoints<dim>    &points,
                             const BackgroundGrid<dim>    &grid)
    {
      std::vector<unsigned int> range_of_cell(grid.n_cells(),
                                              BackgroundGrid<dim>::nowhere);
      for (unsigned int r = 0; r < points.ranges().size(); ++r)
        range_of_cell[points.ranges()[r].cell] = r;

      JudgedArea   area;
      const double reach = 2. * grid.smallest_size();
      for (const auto &part : Utilities::MPI::all_gather(grid.communicator(),
                                                         as_numbers(boundary)))
        {
          std::vector<double> sides;
          for (const auto &particle : part)
            for (const double sum :
                 material_at(particle, points, grid, range_of_cell, reach))
              sides.push_back(sum);
          sides.push_back(0.); // of a rank without particles
          Utilities::MPI::sum(sides, grid.communicator(), sides);
          for (unsigned int i = 0; i < part.size(); ++i)
            if (sides[2 * i + 1] > 0)
              {
                area.all += part[i][2 * dim];
                if (sides[2 * i] > 0)
                  area.wrong += part[i][2 * dim];
              }
        }
      return area;
    }



    template <int dim>
    std::string doubt_about_normals(const ParameterFile       &file,
                                    const BoundaryParameters  &parameters,
                                    const ConditionParameters &condition,
                                    const JudgedArea          &area)
    {
      if (area.all == 0)
        return "No material is within 2 h of boundary '" + parameters.name +
               "': it holds nothing until some comes there, and whether its "
               "normals point out of the material cannot be checked.";
      if (area.wrong <= 0.5 * area.all)
        return "";
      const std::string wrong = "the normals of boundary '" + parameters.name +
                                "' point into the material";
      const std::string advice = std::string("Set Flip normal = ") +
                                 (parameters.flip_normal ? "false" : "true") +
                                 ", or list its corners in the opposite order.";
      if (!condition.is_two_sided())
        throw file.error(parameters.section + "/Flip normal", wrong, advice);
      return "T" + wrong.substr(1) +
             ". Forces don't depend on that here, pictures do. " + advice;
    }



    /** The area of the shape, that of its part in the grid, the cells that
     * this part cuts. */
    struct ShapeInGrid
    {
      double       all = 0, inside = 0;
      unsigned int n_cells = 0;
    };



    template <int dim>
    ShapeInGrid shape_in_grid(const ParameterFile       &file,
                              const BoundaryParameters  &parameters,
                              const BackgroundGrid<dim> &grid)
    {
      ShapeInGrid               shape;
      const FacetCutter<dim>    cutter(grid);
      std::vector<unsigned int> cut;
      for (const auto &facet : flat_facets(make_facets<dim>(file, parameters)))
        {
          shape.all += area_vector_of(facet).norm();
          for (const unsigned int c : cutter.cells_near(facet))
            {
              const auto part = cutter.part_in(c, facet);
              if (part.empty())
                continue;
              shape.inside += area_vector_of(part).norm();
              cut.push_back(c);
            }
        }
      std::sort(cut.begin(), cut.end());
      shape.n_cells = std::unique(cut.begin(), cut.end()) - cut.begin();
      shape.inside  = Utilities::MPI::sum(shape.inside, grid.communicator());
      shape.n_cells = Utilities::MPI::sum(shape.n_cells, grid.communicator());
      return shape;
    }



    std::string percent(const double share)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.2g %%", 100 * share);
      return text;
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  doubts_about_boundary(const ParameterFile          &file,
                        const BoundaryParameters     &parameters,
                        const ConditionParameters    &condition,
                        const BoundaryParticles<dim> &particles,
                        const MaterialPoints<dim>    &points,
                        const BackgroundGrid<dim>    &grid)
  {
    std::vector<std::string> doubts;
    const auto               normals = doubt_about_normals<dim>(
      file, parameters, condition, judge_normals(particles, points, grid));
    if (!normals.empty())
      doubts.push_back(normals);
    if (parameters.conforming)
      return doubts;

    // Below this a boundary merely ends on the grid's own border.
    constexpr double smallest_share = 1e-6;
    const auto       shape          = shape_in_grid(file, parameters, grid);
    const double     outside        = 1. - shape.inside / shape.all;
    if (outside > smallest_share)
      doubts.push_back(percent(outside) + " of boundary '" + parameters.name +
                       "' lie outside of the grid and have no particles.");
    if (particles.n_global() < shape.n_cells)
      doubts.push_back(
        "Boundary '" + parameters.name + "' has " +
        std::to_string(particles.n_global()) + " particles but cuts " +
        std::to_string(shape.n_cells) +
        " cells of the grid: it has holes. Set 'Rule = cut', or more "
        "'Particles per segment'.");
    return doubts;
  }



  namespace
  {
    /** Cells that hold points are never smaller than what these stand for,
     * unless there are empty ones between. */
    template <int dim>
    std::vector<std::string>
    doubts_about_holes(const MaterialPoints<dim> &points,
                       const BackgroundGrid<dim> &grid)
    {
      constexpr double harmless = 0.1;
      double           cells = 0, material = 0;
      for (const auto &range : points.ranges())
        {
          cells += grid.volume(range.cell);
          for (unsigned int p = range.begin; p < range.end; ++p)
            material += points.data(p)[points.slots().volume];
        }
      material /= points.carried().thickness;
      cells              = Utilities::MPI::sum(cells, grid.communicator());
      material           = Utilities::MPI::sum(material, grid.communicator());
      const double share = 1 - cells / material;
      if (!(share > harmless))
        return {};
      std::ostringstream text;
      text
        << std::setprecision(2)
        << "the grid's cells are finer than the points are apart: "
        << 100 * share
        << " % of the bodies or more lie in cells without points, which resist "
           "nothing. Set more 'Points per direction', a finer mesh of the "
           "body, or a coarser grid.";
      return {text.str()};
    }
  } // namespace



  template <int dim>
  std::vector<std::string>
  doubts_about_points(const GridParameters      &parameters,
                      const MaterialPoints<dim> &points,
                      const Basis<dim>          &basis)
  {
    std::vector<std::string> doubts = doubts_about_holes(points, basis.grid());
    // Emptier cells are the ghost penalty's.
    constexpr double       filled  = 0.3;
    constexpr unsigned int n_rigid = dim * (dim + 1) / 2;
    // Linear functions have hourglasses for this. Of splines there is about one
    // a cell: what one point of the cell does not see, others do, unless they
    // are all at the same place of theirs.
    const bool spline = basis.is_spline();
    if (parameters.basis == "linear")
      return doubts;
    const double harmless = spline ? 0.5 : 0.;
    std::size_t  n_cells = 0, n_starved = 0, wanted = 0;
    for (const auto &range : points.ranges())
      {
        double volume = 0;
        for (unsigned int p = range.begin; p < range.end; ++p)
          volume += points.data(p)[points.slots().volume];
        if (volume < filled * points.carried().thickness *
                       basis.grid().volume(range.cell))
          continue;
        const unsigned int modes = basis.n_nodes_of(range.cell) * dim - n_rigid;
        const unsigned int least =
          spline ? dim + 1 : (modes + Voigt<dim>::n - 1) / Voigt<dim>::n;
        ++n_cells;
        n_starved += range.end - range.begin < least ? 1 : 0;
        wanted = std::max<std::size_t>(wanted, least);
      }
    const MPI_Comm comm = basis.grid().communicator();
    n_cells             = Utilities::MPI::sum(n_cells, comm);
    n_starved           = Utilities::MPI::sum(n_starved, comm);
    wanted              = Utilities::MPI::max(wanted, comm);
    if (n_starved <= harmless * n_cells)
      return doubts;
    doubts.push_back(
      std::to_string(n_starved) + " of " + std::to_string(n_cells) +
      " cells that bodies fill have fewer points than a '" + parameters.basis +
      "' basis needs (" + std::to_string(wanted) +
      "): some of its functions resist nothing, and steps may fail or their "
      "results be wrong. Set more 'Points per direction', a finer mesh of the body, 'Points = "
      "clipped', or 'Basis = linear'.");
    return doubts;
  }



  template <int dim>
  double inactive_share(const BoundaryParticles<dim> &particles,
                        const ActiveNodes<dim>       &active)
  {
    double all = 0, inactive = 0;
    for (const auto &range : particles.ranges())
      for (unsigned int b = range.begin; b < range.end; ++b)
        {
          all += particles.area(b);
          if (active.position(range.cell) == BackgroundGrid<dim>::nowhere)
            inactive += particles.area(b);
        }
    const MPI_Comm comm = active.basis().grid().communicator();
    return Utilities::MPI::sum(inactive, comm) / Utilities::MPI::sum(all, comm);
  }



  template <int dim>
  bool load_is_constant(const ParameterFile &file, const Scene<dim> &scene)
  {
    bool constant = !scene.time.is_dynamic();
    for (const auto &body : scene.bodies)
      constant &=
        Expression<dim>(file, body.section + "/Body force", dim).is_steady();
    for (const auto &condition : scene.conditions)
      constant &= PrescribedMotion<dim>(file, condition).is_zero() &&
                  Expression<dim>(file, condition.section + "/Traction", dim)
                    .is_steady() &&
                  condition.from <= 0 && condition.until >= scene.time.end;
    return constant;
  }

#define IMPOINT_INSTANTIATE(dim)                                              \
  template std::vector<std::string> doubts_about_boundary(                    \
    const ParameterFile &,                                                    \
    const BoundaryParameters &,                                               \
    const ConditionParameters &,                                              \
    const BoundaryParticles<dim> &,                                           \
    const MaterialPoints<dim> &,                                              \
    const BackgroundGrid<dim> &);                                             \
  template std::vector<std::string> doubts_about_points(                      \
    const GridParameters &, const MaterialPoints<dim> &, const Basis<dim> &); \
  template double inactive_share(const BoundaryParticles<dim> &,              \
                                 const ActiveNodes<dim> &);                   \
  template bool   load_is_constant(const ParameterFile &, const Scene<dim> &);

  IMPOINT_INSTANTIATE(2)
  IMPOINT_INSTANTIATE(3)
#undef IMPOINT_INSTANTIATE
} // namespace Impoint
