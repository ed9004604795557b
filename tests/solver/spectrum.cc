// The largest eigenvalue by the Lanczos process: of operators with a known
// spectrum, also where it is next to others, and where the start lies in few
// of the eigenvectors.

#include <impoint/solver/spectrum.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <cmath>
#include <iostream>

using namespace dealii;
using Numbers = LinearAlgebra::distributed::Vector<double>;

// That of the matrix with the eigenvalues @p lambda, as a part of the exact
// one.
void find(const std::string &title,
          const unsigned int n,
          double (*lambda)(double))
{
  Numbers start(n);
  for (unsigned int i = 0; i < n; ++i)
    start(i) = 1.5 + std::sin(1. + i);
  const double found = Impoint::largest_eigenvalue(
    [&](const Numbers &x, Numbers &y) {
      for (unsigned int i = 0; i < n; ++i)
        y(i) = lambda(i / (n - 1.)) * x(i);
    },
    start);
  std::cout << title << ": within 1e-3 of it: "
            << (std::abs(found / lambda(1.) - 1.) < 1e-3 ? "yes" : "no")
            << std::endl;
}

// 2 - 2 cos(k pi / (n + 1)), k = 1 ... n
void second_differences(const unsigned int n)
{
  Numbers start(n);
  for (unsigned int i = 0; i < n; ++i)
    start(i) = 1.5 + std::sin(1. + i);
  const double found = Impoint::largest_eigenvalue(
    [&](const Numbers &x, Numbers &y) {
      for (unsigned int i = 0; i < n; ++i)
        y(i) =
          2. * x(i) - (i > 0 ? x(i - 1) : 0.) - (i + 1 < n ? x(i + 1) : 0.);
    },
    start);
  const double exact = 2. - 2. * std::cos(n * numbers::PI / (n + 1));
  std::cout << "second differences: within 1e-3 of it: "
            << (std::abs(found / exact - 1.) < 1e-3 ? "yes" : "no")
            << std::endl;
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  find("evenly spread", 300, [](double s) { return 1. + s; });
  find("over 20 decades", 300, [](double s) { return std::pow(10., 20. * s); });
  find("one alone", 300, [](double s) { return s < 1. ? 1. : 1e6; });
  find("all the same", 50, [](double) { return 7.; });
  second_differences(200);
}
