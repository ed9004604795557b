#include <impoint/base/parameter_file.h>
#include <impoint/base/words.h>
#include <impoint/particles/seeding.h>
#include <impoint/particles/simplex_rules.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

namespace Impoint
{
  namespace
  {
    template <int dim>
    struct VolumePoint
    {
      Point<dim> x;
      double     volume;
    };



    /** The quadrature points of all cells of the body's own mesh. */
    template <int dim>
    std::vector<VolumePoint<dim>> body_mesh_points(const ParameterFile  &file,
                                                   const BodyParameters &body)
    {
      Triangulation<dim> mesh;
      make_mesh(file, body.mesh, mesh);

      const auto simplex = ReferenceCells::get_simplex<dim>();
      const auto cube    = ReferenceCells::get_hypercube<dim>();
      const auto update  = update_quadrature_points | update_JxW_values;
      const FE_Nothing<dim> no_simplex_values(simplex), no_cube_values(cube);
      const unsigned int    n_simplex =
        body.points_per_simplex > 0 ? body.points_per_simplex : dim + 1;
      FEValues<dim> in_simplex(
        simplex.template get_default_linear_mapping<dim>(),
        no_simplex_values,
        simplex_rule<dim>(n_simplex),
        update);
      FEValues<dim> in_cube(cube.template get_default_linear_mapping<dim>(),
                            no_cube_values,
                            QGauss<dim>(body.rule),
                            update);

      std::vector<VolumePoint<dim>> points;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          if (cell->reference_cell() != simplex &&
              cell->reference_cell() != cube)
            throw file.error(body.mesh.section + "/File",
                             "a cell of the kind " +
                               cell->reference_cell().to_string(),
                             "Use a mesh of tetrahedra and hexahedra.");
          FEValues<dim> &values =
            cell->reference_cell() == simplex ? in_simplex : in_cube;
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            points.push_back({values.quadrature_point(q), values.JxW(q)});
        }
      return points;
    }



    template <int dim>
    std::string text_of(const Point<dim> &x)
    {
      std::string text;
      for (unsigned int d = 0; d < dim; ++d)
        text += (d == 0 ? "(" : ", ") + Words::exact(x[d]);
      return text + ")";
    }



    /** Throws if a point was found by no rank; @p mine are those found here. */
    template <int dim>
    void check_all_found(const ParameterFile                 &file,
                         const BodyParameters                &body,
                         const BackgroundGrid<dim>           &grid,
                         const std::vector<VolumePoint<dim>> &points,
                         const std::vector<SeededPoint<dim>> &mine)
    {
      const std::size_t n_found =
        Utilities::MPI::sum(mine.size(), grid.communicator());
      Assert(n_found <= points.size(), ExcInternalError());
      if (n_found == points.size())
        return;

      std::vector<unsigned int> found(points.size(), 0);
      for (const auto &point : mine)
        found[point.number] = 1;
      Utilities::MPI::sum(found, grid.communicator(), found);
      std::size_t lost = 0;
      while (found[lost] > 0)
        ++lost;
      const auto corners = grid.box().get_boundary_points();
      throw file.error(body.mesh.source_entry(),
                       std::to_string(points.size() - n_found) +
                         " points of the "
                         "body '" +
                         body.name + "' lie outside of the grid, one at " +
                         text_of(points[lost].x),
                       "Enlarge the grid, whose box is " +
                         text_of(corners.first) + " to " +
                         text_of(corners.second) + ", or move the body.");
    }



    template <int dim>
    std::vector<SeededPoint<dim>>
    seed_body_mesh(const ParameterFile       &file,
                   const BodyParameters      &body,
                   const BackgroundGrid<dim> &grid)
    {
      const auto                    points = body_mesh_points<dim>(file, body);
      std::vector<SeededPoint<dim>> mine;
      Point<dim>                    xi;
      for (std::size_t i = 0; i < points.size(); ++i)
        {
          const unsigned int c = grid.find(points[i].x, xi);
          if (c != grid.nowhere && grid.is_owned(c))
            mine.push_back({points[i].x, points[i].volume, c, i});
        }
      check_all_found(file, body, grid, points, mine);
      return mine;
    }
  } // namespace



  template <int dim>
  std::vector<SeededPoint<dim>> seed_body(const ParameterFile       &file,
                                          const BodyParameters      &body,
                                          const BackgroundGrid<dim> &grid)
  {
    if (!body.signed_distance.empty())
      return seed_signed_distance(file, body, grid);
    return body.clipped ? seed_clipped(file, body, grid) :
                          seed_body_mesh(file, body, grid);
  }

  template std::vector<SeededPoint<2>> seed_body(const ParameterFile &,
                                                 const BodyParameters &,
                                                 const BackgroundGrid<2> &);
  template std::vector<SeededPoint<3>> seed_body(const ParameterFile &,
                                                 const BodyParameters &,
                                                 const BackgroundGrid<3> &);
} // namespace Impoint
