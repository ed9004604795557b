// The strain energy of a prescribed initial stress S0: more by S0 : E times the
// volume than that of the same motion without it.

#include "kinematics.h"

template <int dim>
double strain_energy(const Tensor<2, dim> &A, const std::string &stress)
{
  Kinematics<dim> scene(square<dim>("as made") +
                        Entries{"Bodies/block/Initial stress = " + stress,
                                "Measurements/Names = E",
                                "Measurements/E/Quantity = energy"});
  scene.step(A);
  for (const auto &result : scene.results())
    if (result.name == "E strain")
      return result.value;
  return 0;
}

template <int dim>
void test(const std::string &stress, const SymmetricTensor<2, dim> &S0)
{
  Tensor<2, dim> A;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      A[i][j] = 0.1 * std::cos(3. * i + j);
  Tensor<2, dim> F = A;
  for (unsigned int d = 0; d < dim; ++d)
    F[d][d] += 1;
  const SymmetricTensor<2, dim> E =
    0.5 * (symmetrize(transpose(F) * F) - unit_symmetric_tensor<dim>());
  const double volume = std::pow(2., dim);
  const double more   = strain_energy(A, stress) - strain_energy(A, "");
  const double error  = more / (volume * (S0 * E)) - 1;
  std::cout << dim << "D, relative error below bound: "
            << (std::abs(error) < 1e-9 ? "yes" : "no ") << std::endl;
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  SymmetricTensor<2, 2>                  plane;
  plane[0][0] = 5;
  plane[1][1] = 3;
  plane[0][1] = 2;
  test<2>("5; 3; 2", plane);
  SymmetricTensor<2, 3> space;
  space[0][0] = 5;
  space[1][1] = 3;
  space[2][2] = 1;
  space[0][1] = 2;
  space[0][2] = -4;
  space[1][2] = 6;
  test<3>("5; 3; 1; 2; -4; 6", space);
}
