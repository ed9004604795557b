// What the user is told of a measurement that makes no sense.
#include "kinematics.h"

template <int dim>
void expect_message(const Entries &entries)
{
  try
    {
      const Kinematics<dim> scene(
        square<dim>("as made") +
        Entries{"Boundaries/Names = wall, side",
                "Boundaries/wall/Polyline = 1 -2; 1 2",
                "Boundaries/side/Kind = conforming",
                "Measurements/Names = one"} +
        measure("one", entries));
      std::cout << "no message" << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string error = "Quantity = displacement error";
  expect_message<2>({"Point = 1"});
  expect_message<2>({"Point = 3, 3"});
  expect_message<2>({"Point = 1, 1", "Reference = 1; 2; 3"});
  expect_message<2>({"Point = 1, 1", "Direction = 1, 0"});
  expect_message<2>({"Quantity = reaction", "Boundary = wal"});
  expect_message<2>({"Quantity = penetration", "Boundary = side"});
  expect_message<2>({"Quantity = path", "Direction = 0, 0"});
  expect_message<2>({error});
  expect_message<2>({error, "Exact = x; y; 0"});
  expect_message<2>({error, "Exact = x; y", "Component = z"});
  expect_message<2>({error, "Exact = x; y", "Body = blok"});
}
