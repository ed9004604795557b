#ifndef impoint_particles_material_points_h
#define impoint_particles_material_points_h

#include <impoint/materials/material.h>
#include <impoint/particles/point_cloud.h>

#include <memory>
#include <vector>

namespace Impoint
{
  /** Which parts of a material point's state a scene needs at all. */
  struct CarriedState
  {
    bool         dynamic        = false; // velocity, acceleration
    bool         initial_stress = false;
    unsigned int n_history      = 0;
    double       thickness      = 1;     // of the bodies in 2D [m]
    bool         keeps_grid     = false; // supports are those of the start
  };

  /** What a piece of material is and remembers, whoever carries it. */
  struct MaterialState
  {
    unsigned int  body           = 0;
    const double *F              = nullptr; // as in MaterialPoints::Slots
    const double *stress         = nullptr;
    const double *initial_stress = nullptr; // null: none
    const double *history        = nullptr; // null: none
  };

  /**
   * The material points: where each part of their state lies in data(), and
   * which material each is made of.
   */
  template <int dim>
  class MaterialPoints : public PointCloud<dim>
  {
  public:
    using Material = Materials::Material<dim>;

    /** Slots of a point's state in data(p). */
    struct Slots
    {
      explicit Slots(const CarriedState &carried);

      PropertyLayout layout; // filled by the next members, in this order
      unsigned int   x;      // place [m]
      unsigned int   u;      // displacement since the start [m]
      unsigned int   F;      // deformation gradient, row-major dim x dim
      unsigned int   stress; // Kirchhoff stress, Voigt; then its zz in 2D [Pa]
      unsigned int   mass;   // [kg]
      unsigned int   volume; // at the start [m3]
      unsigned int   body;   // number
      unsigned int   v, a;   // velocity, acceleration; dynamic scenes only
      unsigned int   start;  // place at the start; if the grid is kept
      unsigned int   initial_stress; // second Piola-Kirchhoff, as stress
      unsigned int   history;
    };

    MaterialPoints(const Basis<dim>                      &basis,
                   const CarriedState                    &carried,
                   std::vector<std::shared_ptr<Material>> materials);

    const Slots &slots() const
    {
      return slot;
    }
    const CarriedState &carried() const
    {
      return carried_state;
    }

    unsigned int body(const unsigned int p) const
    {
      return static_cast<unsigned int>(this->data(p)[slot.body]);
    }
    const Material &material(const unsigned int p) const
    {
      return *materials[body(p)];
    }
    unsigned int n_bodies() const
    {
      return materials.size();
    }
    const Material &material_of_body(const unsigned int number) const
    {
      return *materials[number];
    }

    /** The one with the largest Young's modulus: the scale of penalties. */
    const Material &stiffest_material() const;

    Tensor<1, dim> vector(const unsigned int p, const unsigned int at) const
    {
      Tensor<1, dim> value;
      for (unsigned int d = 0; d < dim; ++d)
        value[d] = this->data(p)[at + d];
      return value;
    }

    Tensor<2, dim> deformation_gradient(const unsigned int p) const
    {
      Tensor<2, dim> F;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          F[i][j] = this->data(p)[slot.F + i * dim + j];
      return F;
    }

    /** Stress at the end of a step with displacement gradient @p grad_u (at
     * the places of the supports); with the prescribed initial stress. F is
     * that at the end. @p new_history may be null. */
    void respond(const unsigned int           p,
                 const Tensor<2, dim>        &grad_u,
                 const bool                   tangent_wanted,
                 Materials::Deformation<dim> &deformation,
                 Materials::Response<dim>    &response,
                 double                      *new_history) const;

    /** The same of material that @p old describes at the start of the step;
     * F and grad_increment are given. */
    void respond(const MaterialState         &old,
                 const bool                   tangent_wanted,
                 Materials::Deformation<dim> &deformation,
                 Materials::Response<dim>    &response,
                 double                      *new_history) const;

    /** Gradient of the places at the end of the step by those of the supports.
     */
    Tensor<2, dim>
    map_of_supports(const Materials::Deformation<dim> &deformation) const
    {
      if (carried_state.keeps_grid)
        return deformation.F;
      Tensor<2, dim> f = deformation.grad_increment;
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1.;
      return f;
    }

    double young() const
    {
      return stiffest_material().young();
    }
    /** Whether all materials have this modulus. */
    bool equally_stiff() const
    {
      return all_equally_stiff;
    }

    bool small_strain() const
    {
      return all_small_strain;
    }
    bool constant_tangent() const
    {
      return all_constant;
    }
    bool symmetric_tangent() const
    {
      return all_symmetric;
    }

    /** Sets what a step makes of point @p p but for its place and motion. */
    void set_end_state(const unsigned int p, const double *end_state);

  private:
    Slots                                  slot;
    CarriedState                           carried_state;
    std::vector<std::shared_ptr<Material>> materials;
    bool                                   all_small_strain  = true;
    bool                                   all_constant      = true;
    bool                                   all_symmetric     = true;
    bool                                   all_equally_stiff = true;
  };

  /**
   * What the last evaluation of the residual found of each material point at
   * the end of the step: its place, F, stress and history. If that was the
   * solution's, the points take it over, and no material is asked once more.
   */
  template <int dim>
  class EndStates
  {
  public:
    /** Doubles of F and of the stress; the history follows. */
    static constexpr unsigned int n_fixed =
      dim * dim + Voigt<dim>::n + (dim == 2 ? 1 : 0);

    /** F and stress of a point. */
    static void store(const Materials::Deformation<dim> &deformation,
                      const Materials::Response<dim>    &response,
                      double                            *end_state)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          *end_state++ = deformation.F[i][j];
      for (unsigned int k = 0; k < Voigt<dim>::n; ++k)
        *end_state++ = response.stress[k];
      if constexpr (dim == 2)
        *end_state = response.stress_zz;
    }

    /** Makes room for the points; for nothing but their places if the rest is
     * not @p kept. */
    void reinit(const MaterialPoints<dim> &points, const bool kept)
    {
      places.resize(points.n());
      size = n_fixed + points.carried().n_history;
      values.resize(kept ? std::size_t(points.n()) * size : 0);
    }

    /** Of point @p p; null if none are kept. */
    double *data(const unsigned int p)
    {
      return values.empty() ? nullptr : values.data() + std::size_t(p) * size;
    }
    const double *data(const unsigned int p) const
    {
      return values.empty() ? nullptr : values.data() + std::size_t(p) * size;
    }

    bool are_kept() const
    {
      return !values.empty();
    }

    std::vector<Point<dim>> places;

  private:
    unsigned int        size = 0;
    std::vector<double> values;
  };
} // namespace Impoint

#endif
