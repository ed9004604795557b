// Moments of seeded points, and the exact ones of simplices.
#ifndef tests_particles_seeding_moments_h
#define tests_particles_seeding_moments_h

#include <impoint/particles/clipping.h>

#include <array>

#include "seeding_scene.h"

// Volume, first moments, second moments xx, xy, (xz,) yy, ...
using Moments = std::array<double, 10>;

template <int dim>
Moments moments_of(const std::vector<SeededPoint<dim>> &points)
{
  Moments m;
  m[0] = sum_of(points, [](const auto &p) { return p.volume; });
  for (unsigned int i = 0, k = 1 + dim; i < dim; ++i)
    {
      m[1 + i] =
        sum_of(points, [&](const auto &p) { return p.volume * p.x[i]; });
      for (unsigned int j = i; j < dim; ++j, ++k)
        m[k] = sum_of(points, [&](const auto &p) {
          return p.volume * p.x[i] * p.x[j];
        });
    }
  return m;
}

// Of a triangle or tetrahedron: the mean of x y is that of the corners'
// products with themselves and with the sums over all corners.
template <int dim>
void add_exact(const std::array<Point<dim>, dim + 1> &simplex, Moments &m)
{
  const double   volume = std::abs(simplex_volume<dim>(simplex));
  Tensor<1, dim> sum;
  for (const auto &corner : simplex)
    sum += corner;
  m[0] += volume;
  for (unsigned int i = 0, k = 1 + dim; i < dim; ++i)
    {
      m[1 + i] += volume * sum[i] / (dim + 1);
      for (unsigned int j = i; j < dim; ++j, ++k)
        {
          double products = sum[i] * sum[j];
          for (const auto &corner : simplex)
            products += corner[i] * corner[j];
          m[k] += volume * products / ((dim + 1) * (dim + 2));
        }
    }
}

#endif
