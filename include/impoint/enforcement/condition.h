#ifndef impoint_enforcement_condition_h
#define impoint_enforcement_condition_h

#include <impoint/base/expression.h>

#include <deal.II/base/tensor.h>

#include <limits>
#include <string>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  class EntryHandler;
  class ParameterFile;

  enum class Constraint
  {
    fixed,
    slip,
    roller,
    traction
  };

  /** What becomes of multipliers that are too many. */
  enum class Superfluous
  {
    automatic,
    keep,
    remove,
    share,
    stabilise
  };

  enum class NitscheForm
  {
    automatic,
    symmetric,
    non_symmetric,
    incomplete
  };

  /** Of a slip boundary: see NodalNormals. */
  enum class Normals
  {
    automatic,
    particle,
    nodal
  };

  enum class Moves
  {
    automatic,
    with_value,
    with_material,
    never
  };

  /** What a boundary prescribes, and how it is enforced: the entries of
   * "Boundaries/<name>" that are not its shape. */
  struct ConditionParameters
  {
    void declare(ParameterFile &file, const std::string &name);
    void check(const ParameterFile &file,
               const unsigned int   dim,
               const bool           conforming) const;

    bool is_active(const double start, const double end) const
    {
      const double middle = 0.5 * (start + end);
      return middle >= from && middle < until;
    }

    bool has_multipliers() const;

    /** Whether the particles carry the state of the material. */
    bool carries_material() const;

    /** Whether it is the same with the opposite normal. */
    bool is_two_sided() const;

    std::string name, section;

    Constraint          constraint = Constraint::fixed;
    std::string         components; // of a roller
    std::string         enforcement        = "projected penalty";
    double              factor             = 1e4;
    bool                factor_is_absolute = false; // [Pa/m], else [E/h]
    Superfluous         superfluous        = Superfluous::automatic;
    double              jump_penalty       = 0.3;  // [h^dim/E]
    double              band_width         = 1e-6; // [h]
    double              nitsche_factor     = 0;    // [n.C.n/h]; 0: by degree
    NitscheForm         nitsche_form       = NitscheForm::automatic;
    bool                small_cut_rule     = false;
    bool                releasing          = false;
    double              friction           = 0; // of a slip boundary
    Normals             normals            = Normals::automatic;
    bool                value_is_velocity  = false; // else a displacement
    Moves               motion             = Moves::automatic;
    std::vector<double> rotation_centre, rotation_axis;
    double              from  = std::numeric_limits<double>::lowest();
    double              until = std::numeric_limits<double>::max();

  private:
    void declare_factors(EntryHandler &prm);
    void declare_motion(EntryHandler &prm);
    void check_unused(const ParameterFile &file, const bool conforming) const;
  };

  /**
   * The motion that a boundary prescribes: a displacement or velocity given
   * as expression of place and time, and a rotation about a fixed axis.
   */
  template <int dim>
  class PrescribedMotion
  {
  public:
    PrescribedMotion(const ParameterFile       &file,
                     const ConditionParameters &parameters);

    bool is_zero() const
    {
      return value.is_zero() && angle.is_zero();
    }
    bool rotates() const
    {
      return !angle.is_zero();
    }

    /** Displacement from time @p start to @p end of what is at @p x at the
     * start, and was at @p first when the run began. */
    Tensor<1, dim> increment(const Point<dim> &x,
                             const Point<dim> &first,
                             const double      start,
                             const double      end) const;

    /** Rotation from @p start to @p end. */
    Tensor<2, dim> rotation(const double start, const double end) const;

  private:
    Expression<dim> value, angle;
    bool            is_velocity;
    Point<dim>      centre;
    Tensor<1, 3>    axis;
  };
} // namespace Impoint

#endif
