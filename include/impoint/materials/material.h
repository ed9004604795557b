#ifndef impoint_materials_material_h
#define impoint_materials_material_h

#include <impoint/base/voigt.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <memory>
#include <string>

namespace Impoint
{
  class ParameterFile;

  /** The constitutive models; they know tensors only. */
  namespace Materials
  {
    using namespace dealii;

    /** What a material answers for one point. */
    template <int dim>
    struct Response
    {
      /** Kirchhoff stress (small strain: Cauchy), Voigt order of base/voigt.h.
       */
      VoigtVector<dim> stress = {};

      /** Out-of-plane stress in plane strain, which respond() sets in 2D. */
      double stress_zz = 0;

      /** Spatial tangent c: Lie derivative of stress = c : sym grad v
       * (engineering shears in the columns). */
      VoigtMatrix<dim> tangent = {};
    };

    /** What a material may ask of one point at the end of a step. */
    template <int dim>
    struct Deformation
    {
      /** Deformation gradient (plane strain: F_zz = 1). */
      Tensor<2, dim> F;

      /** Gradient of the step's displacement at the place at its start; what
       * small-strain models in rate form use (paper I). */
      Tensor<2, dim> grad_increment;

      /** Stress at the start of the step, as the model returned it, and its
       * out-of-plane component. */
      VoigtVector<dim> old_stress    = {};
      double           old_stress_zz = 0;
    };

    /** Doubles that a point may remember. */
    constexpr unsigned int max_history = 64;

    /**
     * A constitutive model. A new one is a header, a source and a row in
     * models.cc.
     */
    template <int dim>
    class Material
    {
    public:
      virtual ~Material() = default;

      /** Whether volumes and gradients stay those of the start of the step, so
       * that no geometric stiffness is needed. */
      virtual bool small_strain() const
      {
        return false;
      }

      /** Whether the tangent is the same for every point and every state. */
      virtual bool constant_tangent() const
      {
        return false;
      }

      /** Whether the tangent has major symmetry; plastic flow that isn't
       * associated has not. */
      virtual bool symmetric_tangent() const
      {
        return true;
      }

      /** Whether respond() starts from the stress of the step before (rate form
       * or history), so that an initial stress is part of its answer. Else
       * MaterialPoints adds it. */
      virtual bool starts_from_stress() const
      {
        return false;
      }

      /** Number of doubles of history a point carries, at most max_history. */
      virtual unsigned int n_history() const
      {
        return 0;
      }

      /** The history of a virgin point under the stress of @p initial. */
      virtual void initialise(const Response<dim> & /*initial*/,
                              double * /*history*/) const
      {}

      /** Equivalent plastic strain of a point: the sum of sqrt(2/3) |dev| of
       * its plastic increments. */
      virtual double plastic_strain(const double * /*history*/) const
      {
        return 0;
      }

      /**
       * Stress and, if @p tangent_wanted, tangent at the end of the step.
       * @p old_history is that at its start; @p history receives that at its
       * end. Throws StepFailed if there is none.
       */
      virtual void respond(const Deformation<dim> &deformation,
                           const double           *old_history,
                           double                 *history,
                           const bool              tangent_wanted,
                           Response<dim>          &response) const = 0;

      /** Tangent of the virgin material at rest, before it yields. By default
       * that of respond() without deformation, from initialise() without
       * stress: a model that yields there overrides it. */
      virtual VoigtMatrix<dim> elastic_tangent() const;

      /** Young's modulus of the virgin material [Pa]: the scale of penalties.
       */
      virtual double young() const = 0;

      /** Strain energy of a point per initial volume, for the energy balance:
       * the elastic part, which follows from deformation and stress. NaN where
       * the model has none. */
      virtual double energy(const Deformation<dim> &deformation,
                            const Response<dim>    &response) const = 0;
    };

    /** Declares the entries of all models in the handler's present section. */
    void declare_parameters(ParameterFile &file, const std::string &section);

    /** The model chosen in @p section ("Bodies/<name>/Material") after
     * ParameterFile::apply(). Throws InputError. */
    template <int dim>
    std::unique_ptr<Material<dim>> create_material(const ParameterFile &file,
                                                   const std::string &section);
  } // namespace Materials
} // namespace Impoint

#endif
