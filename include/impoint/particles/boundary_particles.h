#ifndef impoint_particles_boundary_particles_h
#define impoint_particles_boundary_particles_h

#include <impoint/particles/point_cloud.h>
#include <impoint/particles/seeding.h>

#include <string>
#include <vector>

namespace Impoint
{
  /** Which parts of a boundary particle's state a scene needs at all. */
  struct CarriedByBoundary
  {
    bool         keeps_grid     = false; // supports are those of the start
    bool         material       = false; // the state of the body it bounds
    bool         initial_stress = false; // of that
    unsigned int n_history      = 0;
  };

  /**
   * The particles of one nonconforming boundary: where it is, which way it
   * faces, and the state of its condition.
   */
  template <int dim>
  class BoundaryParticles : public PointCloud<dim>
  {
  public:
    /** Slots of a particle's state in data(b). */
    struct Slots
    {
      explicit Slots(const CarriedByBoundary &carried);

      PropertyLayout layout;
      unsigned int   x;      // place of the wall [m]
      unsigned int   start;  // place at the start of the run
      unsigned int   normal; // unit, out of the material
      unsigned int   area;   // [m2], in 2D times the thickness
      unsigned int   held;   // the part of the area that has material before it
      unsigned int   gap;    // material minus wall, total; slip: [0] normal
      unsigned int   increment;  // of the wall in this step
      unsigned int   multiplier; // of an augmented condition; slip: [0]
      unsigned int   force;      // on the material [N], end of the last step

      // if the grid is kept: displacement of the material since the start [m]
      unsigned int u;

      // of the material it bounds, if it carries that; as MaterialPoints::Slots
      unsigned int start_normal; // normal at the start of the run
      unsigned int F, stress, body, initial_stress, history;
      unsigned int couple; // on the material beside the force [Nm]; 2D: z
    };

    BoundaryParticles(const Basis<dim>                               &basis,
                      const std::string                              &name,
                      const std::vector<SeededBoundaryParticle<dim>> &seeds,
                      const double                                    thickness,
                      const CarriedByBoundary &carried = {});

    const std::string &name() const
    {
      return boundary_name;
    }
    const Slots &slots() const
    {
      return slot;
    }
    const CarriedByBoundary &carried() const
    {
      return carried_state;
    }

    Tensor<1, dim> vector(const unsigned int b, const unsigned int at) const
    {
      Tensor<1, dim> value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = this->data(b)[at + d];
      return value;
    }

    void set_vector(const unsigned int    b,
                    const unsigned int    at,
                    const Tensor<1, dim> &value)
    {
      for (unsigned int d = 0; d < dim; ++d)
        this->data(b)[at + d] = value[d];
    }

    double area(const unsigned int b) const
    {
      return this->data(b)[slot.area];
    }

    /** What of its area takes part in the boundary's condition: that of a
     * particle with material before it, or none. */
    double held_area(const unsigned int b) const
    {
      return this->data(b)[slot.held];
    }
    double held_area_of_range(const unsigned int r) const;
    void   hold(const unsigned int b, const bool wanted)
    {
      this->data(b)[slot.held] = wanted ? area(b) : 0.;
    }

    /** Of the plane through the particles of range @p r, with their mean
     * normal: shorter than 1 where they face different ways. */
    HalfSpace<dim> material_side(const unsigned int r) const;

    /** Of the bodies in 2D [m]; 1 in 3D. */
    double thickness() const
    {
      return body_thickness;
    }

  private:
    std::string       boundary_name;
    double            body_thickness;
    CarriedByBoundary carried_state;
    Slots             slot;
  };
} // namespace Impoint

#endif
