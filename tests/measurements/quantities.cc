// All measurements on prescribed motions: a rotation by more than a turn, and
// an expansion towards a wall; the orders of Newton's iteration.
#include <impoint/measurements/convergence.h>

#include "kinematics.h"

template <int dim>
void rotate(const std::string &cells)
{
  const std::string kinetic = dim == 2 ? "50e3" : "100e3";
  const std::string z = dim == 2 ? "" : "; 0", at = dim == 2 ? "" : ", 0";
  const std::string u = "x * (cos(2*t) - 1) - y * sin(2*t); "
                        "x * sin(2*t) + y * (cos(2*t) - 1)" +
                        z;
  Kinematics<dim> scene(
    square<dim>(cells) +
    Entries{"Measurements/Names = corner, outside, path, u, s, E, early"} +
    measure("corner",
            {"Point = 1, 1" + at,
             "Reference = cos(10)-sin(10)-1; sin(10)+cos(10)-1"}) +
    measure("outside",
            {"Point = 1.3, 0.2" + at,
             "Reference = 1.3*(cos(10)-1)-0.2*sin(10); "
             "1.3*sin(10)+0.2*(cos(10)-1)"}) +
    measure(
      "path",
      {"Quantity = path", "Direction = 1, 1" + at, "Reference = none; 10"}) +
    measure(
      "u",
      {"Quantity = displacement error", "Component = all", "Exact = " + u}) +
    measure("s",
            {"Quantity = stress error",
             "Frame angle = 30",
             "Component = xy",
             "Norm = maximum",
             "Exact = 0.5 * cos(pi/3) - 0.5 * sin(pi/3)"}) +
    measure("E",
            {"Quantity = energy",
             "Reference = " + kinetic + "; 0; " + kinetic}) +
    measure("early",
            {"Quantity = path",
             "Direction = 1, 0" + at,
             "Until = 2",
             "Reference = 0; 4"}));
  scene.stress[0]                          = 2;
  scene.stress[1]                          = 1;
  scene.stress[Voigt<dim>::position(0, 1)] = 0.5;
  Tensor<2, dim> A;
  A[0][0] = A[1][1] = std::cos(2.) - 1;
  A[1][0]           = std::sin(2.);
  A[0][1]           = -A[1][0];
  for (unsigned int i = 0; i < 5; ++i)
    scene.step(A);
  compare("rotation, " + std::to_string(dim) + "D, " + cells, scene);
}

void expand()
{
  const Entries stress = {"Quantity = stress error", "Exact = 2; 0; 0.5; 1"};
  Kinematics<2> scene(
    square<2>("as made") +
    Entries{"Boundaries/Names = wall",
            "Boundaries/wall/Polyline = 1 2; 1 -2",
            "Boundaries/wall/Flip normal = true",
            "Measurements/Names = depth, front, base, push, mean, xx, L2, max, "
            "place, newton"} +
    measure("depth", {"Quantity = penetration", "Boundary = wall"}) +
    measure("front", {"Quantity = run-out", "Direction = 2, 0"}) +
    measure("base",
            {"Quantity = reaction",
             "Boundary = wall",
             "Point = 1, 2",
             "Reference = 3; 4; 7"}) +
    measure("push", {"Quantity = impulse", "Boundary = wall"}) +
    measure("mean", stress + Entries{"Component = all"}) +
    measure("xx", stress + Entries{"Component = xx", "Scale = 10"}) +
    measure("L2", stress + Entries{"Norm = L2"}) +
    measure("max", stress + Entries{"Norm = maximum"}) +
    measure("place",
            {"Quantity = displacement error",
             "Position = current",
             "Exact = x / 6; y / 6",
             "Norm = L2"}) +
    measure("newton", {"Quantity = newton"}));
  Tensor<2, 2> A;
  A[0][0] = A[1][1] = 0.2;
  scene.stress      = {{3 * 1.44, 0.5 * 1.44, 0.5 * 1.44}};
  scene.stress_zz   = 1.44;
  scene.residuals   = {1, 1e-2, 1e-5, 1e-10, 1e-15};
  scene.forces      = {{"wall", Tensor<1, 2>({3, 4}), Tensor<1, 3>({0, 0, 5})}};
  scene.step(A);
  print(scene);
}

void shear()
{
  Kinematics<2> scene(
    square<2>("as made") + Entries{"Measurements/Names = up, right"} +
    measure("up", {"Quantity = slope", "Direction = 1, 0"}) +
    measure("right", {"Quantity = slope", "Direction = 0, -1"}));
  Tensor<2, 2> A;
  A[1][0]      = 0.5;
  scene.stress = {{1, 1, 0}};
  scene.step(A);
  print(scene, "slope ");
}

Entries
wall(const std::string &name, const std::string &x, const std::string &end)
{
  const std::string section = "Boundaries/" + name + " wall/";
  return {section + "Polyline = " + x + " 4; " + x + " " + end,
          section + "Flip normal = true"};
}

// the walls' particles, as a step would leave them: 0.01 further away, or 3 h
// amid the material, of which all or nothing is before their ends
void set_particles()
{
  Kinematics<2> scene(
    square<2>("as made") +
    Entries{"Boundaries/Names = wall, deep wall, beside wall",
            "Boundaries/wall/Polyline = 1 2; 1 -2",
            "Boundaries/wall/Flip normal = true",
            "Measurements/Names = moved, deep, beside"} +
    wall("deep", "1", "0") + wall("beside", "1", "1.6") +
    measure("moved", {"Quantity = penetration", "Boundary = wall"}) +
    measure("deep", {"Quantity = penetration", "Boundary = deep wall"}) +
    measure("beside", {"Quantity = penetration", "Boundary = beside wall"}));
  scene.set_boundary = [](BoundaryParticles<2> &wall) {
    for (unsigned int b = 0; b < wall.n(); ++b)
      wall.data(b)[wall.slots().x] += wall.name() == "wall" ? 0.01 : -1.5;
  };
  Tensor<2, 2> A;
  A[0][0] = A[1][1] = 0.2;
  scene.step(A);
  print(scene);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  rotate<2>("as made");
  rotate<2>("triangles");
  rotate<3>("as made");
  rotate<3>("tetrahedra");
  expand();
  shear();
  set_particles();
}
