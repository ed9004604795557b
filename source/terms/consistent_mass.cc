#include <impoint/terms/consistent_mass.h>

namespace Impoint
{
  template <int dim>
  void ConsistentMass<dim>::add(const unsigned int k,
                                const double      *accelerations,
                                const double       alpha,
                                CellSystem        &system) const
  {
    const auto        &range = points.ranges()[k];
    const unsigned int n     = system.n;
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        const double *N    = points.support(p);
        const double  mass = points.data(p)[points.slots().mass];
        for (unsigned int a = 0; a < n; ++a)
          for (unsigned int b = 0; b < n; ++b)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const double entry = mass * N[a] * N[b];
                system.residual[a * dim + d] +=
                  entry * accelerations[b * dim + d];
                if (system.matrix)
                  system.matrix[(a * n + b) * dim * dim + d * dim + d] +=
                    alpha * entry;
              }
      }
  }

  template class ConsistentMass<2>;
  template class ConsistentMass<3>;
} // namespace Impoint
