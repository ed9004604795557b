// Momentum of a block whose points keep the velocity (3, 4) they begin with.
#include "kinematics.h"

template <int dim>
void fly(const std::string &point, const std::string &reference)
{
  Kinematics<dim> scene(square<dim>("as made") +
                        Entries{"Measurements/Names = p"} +
                        measure("p",
                                {"Quantity = momentum",
                                 "Point = " + point,
                                 "Reference = " + reference}));
  scene.step(Tensor<2, dim>());
  compare("momentum, " + std::to_string(dim) + "D", scene);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  fly<2>("1, 1", "12e3; 16e3; -4e3");
  fly<3>("1, 1, 1", "24e3; 32e3; 0; 32e3; -24e3; -8e3");
}
