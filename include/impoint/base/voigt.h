#ifndef impoint_base_voigt_h
#define impoint_base_voigt_h

#include <array>

namespace Impoint
{
  /**
   * Order of the components of symmetric tensors in flat arrays: 00, 11, 01 in
   * 2D; 00, 11, 22, 01, 02, 12 in 3D. Strains hold engineering shears.
   */
  template <int dim>
  struct Voigt
  {
    static constexpr int n = dim * (dim + 1) / 2;

    static constexpr int row(const int k)
    {
      if constexpr (dim == 2)
        return k == 2 ? 0 : k;
      else
        return k < 3 ? k : (k == 5 ? 1 : 0);
    }

    static constexpr int column(const int k)
    {
      if constexpr (dim == 2)
        return k == 0 ? 0 : 1;
      else
        return k < 3 ? k : (k == 3 ? 1 : 2);
    }

    /** Where component ij stands. */
    static constexpr int position(const int i, const int j)
    {
      return i == j ? i : i + j + dim - 1;
    }
  };

  template <int dim>
  using VoigtVector = std::array<double, Voigt<dim>::n>;

  /** Row-major n x n matrix. */
  template <int dim>
  using VoigtMatrix = std::array<double, Voigt<dim>::n * Voigt<dim>::n>;
} // namespace Impoint

#endif
