#ifndef impoint_output_pictures_h
#define impoint_output_pictures_h

#include <impoint/grid/active_nodes.h>
#include <impoint/output/vtu_writer.h>
#include <impoint/particles/boundary_particles.h>
#include <impoint/particles/material_points.h>

#include <deal.II/lac/la_parallel_vector.h>

namespace Impoint
{
  /** What ParaView shows of a run: points.pvd, boundary.pvd, grid.pvd. */
  template <int dim>
  class Pictures
  {
  public:
    explicit Pictures(const OutputFolder &folder);

    /** Collective. @p u is the displacement of the last step on the active
     * nodes, or empty before the first. */
    void write(const double                                       time,
               const MaterialPoints<dim>                         &points,
               const std::vector<const BoundaryParticles<dim> *> &boundaries,
               const ActiveNodes<dim>                            &active,
               const LinearAlgebra::distributed::Vector<double>  &u);

    /** Which pictures there are, for a run that is resumed. */
    void save_or_load(StateArchive &archive)
    {
      points_writer.save_or_load(archive);
      boundary_writer.save_or_load(archive);
      grid_writer.save_or_load(archive);
    }

  private:
    PointFields<dim> material(const MaterialPoints<dim> &points) const;
    PointFields<dim>
    boundary(const std::vector<const BoundaryParticles<dim> *> &boundaries,
             const Basis<dim>                                  &basis) const;
    GridFields<dim>
    grid(const ActiveNodes<dim>                           &active,
         const LinearAlgebra::distributed::Vector<double> &u) const;

    CollectionWriter<dim> points_writer, boundary_writer, grid_writer;
  };
} // namespace Impoint

#endif
