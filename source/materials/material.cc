#include <impoint/materials/material.h>

#include <vector>

namespace Impoint
{
  namespace Materials
  {
    template <int dim>
    VoigtMatrix<dim> Material<dim>::elastic_tangent() const
    {
      std::vector<double> old_history(n_history()), history(n_history());
      initialise(Response<dim>(), old_history.data());
      Deformation<dim> rest;
      for (unsigned int d = 0; d < dim; ++d)
        rest.F[d][d] = 1.;
      Response<dim> response;
      respond(rest, old_history.data(), history.data(), true, response);
      return response.tangent;
    }

    template class Material<2>;
    template class Material<3>;
  } // namespace Materials
} // namespace Impoint
