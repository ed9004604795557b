// A block pressed on a wall with friction slides one way, then the other:
// what Newton's iteration is told of that, freely and frozen.
#include <impoint/base/parameter_file.h>
#include <impoint/setup.h>

#include <iostream>

using namespace Impoint;

class Block
{
public:
  Block()
    : file("",
           {"Grid/Generator = subdivided_hyper_rectangle",
            "Grid/Arguments = 2, 2 : -1, -1 : 1, 1",
            "Bodies/Names = block",
            "Bodies/block/Mesh/Generator = subdivided_hyper_rectangle",
            "Bodies/block/Mesh/Arguments = 2, 2 : -1, -0.5 : 1, 1",
            "Bodies/block/Density = 1",
            "Bodies/block/Material/Young's modulus = 5",
            "Boundaries/Names = floor",
            "Boundaries/floor/Polyline = -1 -0.5; 1 -0.5",
            "Boundaries/floor/Constraint = slip",
            "Boundaries/floor/Friction coefficient = 0.5",
            "Boundaries/floor/Releasing = true",
            "Boundaries/floor/Enforcement = penalty"})
    , scene(file)
    , grid(file, scene.grid, MPI_COMM_WORLD)
    , basis(grid, file, scene.grid)
    , active(basis)
    , points(place_bodies(file, scene, basis))
    , stiffness(active, *points)
    , methods(place_boundaries(file, scene, basis, *points))
  {
    active.reinit(points->cells(), Enforcement::cells(methods, 0, 1));
    Enforcement::Step<2> step;
    step.end = 1;
    stiffness.reinit();
    step.active    = &active;
    step.points    = points.get();
    step.stiffness = &stiffness;
    floor().begin_step(step);
  }

  Enforcement::Method<2> &floor()
  {
    return *methods[0];
  }

  Enforcement::ContactStates &contact()
  {
    return *floor().contact_states();
  }

  // Displaced down and by @p along.
  void evaluate(const double along)
  {
    Enforcement::for_active_ranges(
      floor(), active, [&](const unsigned int r, const unsigned int k) {
        const unsigned int  n = active.nodes(k).size();
        std::vector<double> u, residual(2 * n);
        for (unsigned int a = 0; a < n; ++a)
          u.insert(u.end(), {along, -0.1});
        CellSystem system = {n, u.data(), residual.data(), nullptr};
        floor().add(r, Enforcement::Strength::exact, system);
      });
  }

private:
  ParameterFile                      file;
  const Scene<2>                     scene;
  BackgroundGrid<2>                  grid;
  Basis<2>                           basis;
  ActiveNodes<2>                     active;
  std::unique_ptr<MaterialPoints<2>> points;
  NearbyStiffness<2>                 stiffness;
  NonlinearSystem<2>::Methods        methods;
};

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  Block                                  block;
  const auto                             tell = [&](const std::string &what) {
    std::cout << what << ": contact "
              << (block.contact().contact_changed() ? "changed" : "as before")
              << ", "
              << (block.contact().contact_settled() ? "settled" : "not settled")
              << std::endl;
  };
  block.evaluate(0.2);
  tell("slides to the right");
  block.contact().begin_correction();
  block.evaluate(0.3);
  tell("further");
  block.evaluate(-0.2);
  tell("to the left, which is overruled");
  block.contact().freeze(true);
  tell("frozen");
  block.evaluate(-0.3);
  tell("further");
  block.contact().freeze(false);
  block.evaluate(-0.3);
  tell("free again");
}
