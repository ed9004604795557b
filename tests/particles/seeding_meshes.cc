// Meshes: split into simplices, moved before they are refined, from files.
#include <deal.II/distributed/tria.h>

#include <fstream>
#include <map>

#include "seeding_scene.h"

// Triangles and tetrahedra of a refined box all hold its diagonal's direction.
template <int dim>
void test_structured(const std::string &cells)
{
  Triangulation<dim> mesh;
  make<dim>(std::string(
              "Mesh/Generator = hyper_rectangle & Mesh/Arguments = ") +
              (dim == 2 ? "0, 0 : 1, 1" : "0, 0, 0 : 1, 1, 1") +
              " & Mesh/Refinements = 2 & Mesh/Cells = " + cells,
            mesh);
  unsigned int                         along_diagonal = 0;
  std::map<unsigned int, unsigned int> sides;
  for (const auto &cell : mesh.active_cell_iterators())
    {
      for (const unsigned int line : cell->line_indices())
        {
          const Tensor<1, dim> edge =
            cell->line(line)->vertex(1) - cell->line(line)->vertex(0);
          double sum = 0;
          for (unsigned int d = 0; d < dim; ++d)
            sum += edge[d];
          if (std::abs(std::abs(sum) - 0.25 * dim) < 1e-12)
            ++along_diagonal;
        }
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          ++sides[face->boundary_id()];
    }
  std::cout << mesh.n_active_cells() << " " << cells << ", " << along_diagonal
            << " along the diagonal, faces:";
  for (const auto &side : sides)
    std::cout << " " << side.first << ": " << side.second;
  std::cout << std::endl;
}

// A ball moved, a plate with a hole copied, too: refined along their circles.
void test_moved()
{
  const std::string moves =
    "Mesh/Scale = 2 & Mesh/Rotation = 30 & Mesh/Shift = 3, "
    "-1 & Mesh/Refinements = 3 & ";
  Triangulation<2> ball;
  make<2>(moves + "Mesh/Generator = hyper_ball & Mesh/Arguments = 1, 0 : 0.5",
          ball);
  const Point<2> centre(3 + std::sqrt(3.), 0);
  double         error = 0;
  for (const auto &face : ball.active_face_iterators())
    if (face->at_boundary())
      error = std::max(error, std::abs(face->vertex(0).distance(centre) - 1));
  print_bound("moved circle", error, 1e-12);

  const MeshScene  scene(moves +
                          "Mesh/Generator = plate_with_a_hole & Mesh/Arguments "
                           "= 0.5 : 1 : 1 : 1 : 1 : 1 : 0, 0 : 0 : 1 : 1 : 2",
                        2);
  Triangulation<2> plate;
  {
    Triangulation<2> coarse;
    make_coarse_mesh(scene.file, scene.parameters, coarse);
    plate.copy_triangulation(coarse);
  }
  refine_mesh(scene.parameters, plate);
  error = 1;
  for (const auto &vertex : plate.get_vertices())
    error = std::min(error, vertex.distance(Point<2>(3, -1)) - 1);
  print_bound("moved hole", error, 1e-12);

  parallel::distributed::Triangulation<2> distributed(MPI_COMM_WORLD);
  make_coarse_mesh(scene.file, scene.parameters, distributed);
  refine_mesh(scene.parameters, distributed);
  std::cout << "cells of the plate: " << plate.n_active_cells()
            << ", distributed " << distributed.n_global_active_cells()
            << std::endl;
}

void test_file()
{
  std::ofstream("square.msh")
    << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n"
       "3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n3\n1 1 2 7 1 1 2\n"
       "2 2 2 5 1 1 2 3\n3 2 2 5 1 1 3 4\n$EndElements\n";
  Triangulation<2> mesh;
  make<2>("Mesh/File = square.msh & Mesh/Refinements = 2", mesh);
  double bottom = 0;
  for (const auto &face : mesh.active_face_iterators())
    if (face->at_boundary() && face->boundary_id() == 7)
      bottom += face->measure();
  std::cout << "triangles from a file: " << mesh.n_active_cells()
            << ", side with id 7: " << bottom << std::endl;
  for (const std::string entries :
       {"File = no.msh",
        "File = square.mesh",
        "File = square.msh & Mesh/Cells = triangles",
        "File = square.msh & Mesh/Generator = hyper_cube"})
    try
      {
        make<2>("Mesh/" + entries, mesh);
        std::cout << entries << ": accepted" << std::endl;
      }
    catch (const InputError &)
      {
        std::cout << entries << ": refused" << std::endl;
      }
}

void test_distortion()
{
  Triangulation<3>  plain, distorted;
  const std::string cube =
    "Mesh/Generator = subdivided_hyper_cube & "
    "Mesh/Arguments = 3 : 0 : 3 & Mesh/Cells = tetrahedra";
  make<3>(cube, plain);
  make<3>(cube + " & Mesh/Distortion = 0.25", distorted);
  double inside = 0, border = 0;
  for (unsigned int v = 0; v < plain.n_vertices(); ++v)
    {
      const Point<3> x        = plain.get_vertices()[v];
      const double   distance = x.distance(distorted.get_vertices()[v]);
      const Point<3> middle(1.5, 1.5, 1.5);
      const bool     inner   = (x - middle).norm() < 1; // the 8 inner vertices
      double        &largest = inner ? inside : border;
      largest                = std::max(largest, distance);
    }
  print_bound("vertices on the border", border, 1e-15);
  print_bound("inner vertices", inside - 0.25, 1e-12);
  double volume = -27;
  for (const auto &cell : distorted.active_cell_iterators())
    volume += cell->measure();
  print_bound("volume", volume, 1e-11);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_structured<2>("triangles");
  test_structured<3>("tetrahedra");
  test_structured<2>("8 triangles");
  test_structured<3>("24 tetrahedra");
  test_moved();
  test_file();
  test_distortion();
}
