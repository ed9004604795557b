// Consistent mass: forces of accelerations that are linear in place are those
// of the points, its matrix is their derivative. Empty cells: no force from
// rigid motions, the elastic energy of a stretch.

#include <impoint/terms/consistent_mass.h>
#include <impoint/terms/empty_cells.h>

#include <iostream>

#include "term_scene.h"

void print_bound(const std::string &what, const double error)
{
  std::cout << what << " below bound: " << (error < 1e-11 ? "yes" : "no, ");
  if (!(error < 1e-11))
    std::cout << error;
  std::cout << std::endl;
}

// The residual is cubic in the displacements: two differences give its
// derivative.
template <int dim>
void test_large_strain(const TermScene<dim> &scene,
                       const Tensor<2, dim> &A,
                       const Tensor<1, dim> &a)
{
  EmptyCells<dim> empty(scene.active, false);
  empty.reinit();
  double moment_error = 0, difference = 0;
  for (unsigned int k = scene.active.n_material_cells();
       k < scene.active.n_cells();
       ++k)
    {
      LinearCell<dim>     cell(scene, k, A, a);
      const unsigned int  n_unknowns = cell.values.size();
      std::vector<double> sum(n_unknowns, 0.);
      for (const double step : {-2., -1., 1., 2.})
        {
          const double    factor = 1. + 0.1 * step;
          LinearCell<dim> other(scene, k, factor * A, factor * a);
          empty.add(k, scene.points->young(), other.system);
          const double weight = (std::abs(step) == 1. ? 8. : -1.) / 1.2;
          for (unsigned int i = 0; i < n_unknowns; ++i)
            sum[i] += (step > 0 ? weight : -weight) * other.residual[i];
        }
      empty.add(k, scene.points->young(), cell.system);
      Tensor<2, dim> moment;
      for (unsigned int i = 0; i < n_unknowns; ++i)
        {
          const auto node =
            scene.active.grid_node(scene.active.nodes(k)[i / dim]);
          for (unsigned int j = 0; j < dim; ++j)
            moment[j][i % dim] +=
              (scene.basis.point(node)[j] + cell.values[i / dim * dim + j]) *
              cell.residual[i];
        }
      moment_error =
        std::max(moment_error, (moment - transpose(moment)).norm());
      cell.residual = sum;
      difference    = std::max(difference, cell.linearity_error(1.));
    }
  print_bound("  large strains, moment about the places at the end",
              moment_error);
  print_bound("  their matrix", difference);
}

template <int dim>
void test(const std::string &cells, const std::string &settings)
{
  const TermScene<dim> scene(cells, settings);
  std::cout << dim << "D, " << cells << ", " << settings << ": "
            << scene.active.n_material_cells() << " cells with material of "
            << scene.active.n_cells() << std::endl;
  Tensor<2, dim> A;
  Tensor<1, dim> a;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      {
        A[i][j] = std::cos(3. * i + j);
        a[i]    = i + 1.;
      }
  const double        alpha = 11;
  ConsistentMass<dim> mass(*scene.points);
  double              force_error = 0, mass_linearity = 0;
  for (unsigned int k = 0; k < scene.active.n_material_cells(); ++k)
    {
      LinearCell<dim> cell(scene, k, A, a);
      mass.add(k, cell.values.data(), alpha, cell.system);
      Tensor<1, dim> force;
      for (unsigned int i = 0; i < cell.residual.size(); ++i)
        force[i % dim] += cell.residual[i];
      const auto &range = scene.points->ranges()[k];
      for (unsigned int p = range.begin; p < range.end; ++p)
        force -= scene.points->data(p)[scene.points->slots().mass] *
                 (A * scene.points->position(p) + a);
      force_error = std::max(force_error, force.norm());
      mass_linearity =
        std::max(mass_linearity, cell.linearity_error(1 / alpha));
    }
  print_bound("  force of mass", force_error);
  print_bound("  its matrix", mass_linearity);

  EmptyCells<dim> empty(scene.active, true);
  empty.reinit();
  const Tensor<2, dim> strain   = 0.5 * (A + transpose(A));
  const Tensor<2, dim> rotation = 0.5 * (A - transpose(A));
  double               rigid = 0, energy_error = 0, empty_linearity = 0;
  for (unsigned int k = scene.active.n_material_cells();
       k < scene.active.n_cells();
       ++k)
    {
      LinearCell<dim> moved(scene, k, rotation, a), strained(scene, k, A, a);
      empty.add(k, scene.points->young(), moved.system);
      empty.add(k, scene.points->young(), strained.system);
      double energy = -0.5 * scene.points->young() * strain.norm_square() *
                      scene.grid.volume(scene.active.cell(k));
      for (unsigned int i = 0; i < moved.residual.size(); ++i)
        {
          rigid = std::max(rigid, std::abs(moved.residual[i]));
          energy += 0.5 * strained.values[i] * strained.residual[i];
        }
      energy_error    = std::max(energy_error, std::abs(energy));
      empty_linearity = std::max(empty_linearity, strained.linearity_error(1));
    }
  print_bound("  empty cells, force of rigid motions", rigid);
  print_bound("  energy of a stretch", energy_error);
  print_bound("  their matrix", empty_linearity);
  test_large_strain(scene, 0.1 * A, a);
}

int main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test<2>("as made", "Grid/Distortion = 0");
  test<2>("as made", "Grid/Rotation = 20");
  test<2>("triangles", "Grid/Distortion = 0.1");
  test<3>("as made", "Grid/Rotation = 20");
  test<3>("tetrahedra", "Grid/Distortion = 0.1");
}
