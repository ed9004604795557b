// Time of a tangent assembly (shape values, material, kernel, scatter) beside
// that of the bare kernel: the sum of V B^T D B over the points of each cell,
// written for speed, with the gradients given and nothing else. Not a test; run
// by hand:
//   assembly [repetitions]
// Exits with 1 if a ratio misses its goal or the kernels disagree. As 'assembly
// --small' it shows that it still works, whatever the time.

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "box.h"

// The bare kernel with all it needs next to each other in memory: also D, one
// for each point (as of any material but a linear one), if @p own_D.
template <int dim>
class BareKernel
{
public:
  static constexpr int n = 1 << dim, n_v = Voigt<dim>::n;
  using Matrix = std::array<double, n * n * dim * dim>; // blocks (a, b >= a)

  explicit BareKernel(const Box<dim> &box, const bool own_D)
    : points(*box.points)
    , stride(own_D)
  {
    for (unsigned int p = 0; p < points.n(); ++p)
      {
        gradients.insert(gradients.end(),
                         points.support(p) + n,
                         points.support(p) + n * (dim + 1));
        volumes.push_back(points.data(p)[points.slots().volume]);
      }
    Materials::Deformation<dim> none;
    Materials::Response<dim>    response;
    for (unsigned int d = 0; d < dim; ++d)
      none.F[d][d] = 1;
    points.material(0).respond(none, nullptr, nullptr, true, response);
    tangents.assign(own_D ? points.n() : 1, response.tangent);
  }

  // Adds up the matrices' entries so that none can be left out.
  double run() const
  {
    double sum = 0;
    for (const auto &range : points.ranges())
      {
        Matrix K;
        integrate(range.begin, range.end, K);
        sum += K[0] + K[dim] + K[(n - 1) * (n + 1) * dim * dim];
      }
    return sum;
  }

  void
  integrate(const unsigned int begin, const unsigned int end, Matrix &K) const
  {
    K.fill(0.);
    for (unsigned int p = begin; p < end; ++p)
      {
        const double          *G = gradients.data() + std::size_t(p) * n * dim;
        const VoigtMatrix<dim> D = tangents[p * stride]; // copied: not aliased
        for (int b = 0; b < n; ++b)
          {
            double DB[n_v][dim]; // V D B_b
            for (int k = 0; k < n_v; ++k)
              for (int j = 0; j < dim; ++j)
                {
                  DB[k][j] = 0;
                  for (int l = 0; l < dim; ++l)
                    DB[k][j] +=
                      D[k * n_v + Voigt<dim>::position(j, l)] * G[b * dim + l];
                  DB[k][j] *= volumes[p];
                }
            for (int a = 0; a <= b; ++a)
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  {
                    double sum = 0;
                    for (int l = 0; l < dim; ++l)
                      sum += G[a * dim + l] * DB[Voigt<dim>::position(i, l)][j];
                    K[((a * n + b) * dim + i) * dim + j] += sum;
                  }
          }
      }
  }

private:
  const MaterialPoints<dim>    &points;
  std::size_t                   stride; // from a point's D to the next
  std::vector<double>           gradients, volumes;
  std::vector<VoigtMatrix<dim>> tangents;
};

// Largest difference between the cells' matrices of ours and the bare kernel.
template <int dim>
double difference(const Box<dim> &box, const BareKernel<dim> &bare)
{
  const InternalForce<dim>         term(*box.points);
  typename BareKernel<dim>::Matrix K, full;
  constexpr unsigned int           n     = BareKernel<dim>::n;
  std::array<double, n *dim>       u     = {}, residual;
  double                           worst = 0, largest = 0;
  for (unsigned int k = 0; k < box.active.n_cells(); ++k)
    {
      full.fill(0.);
      residual.fill(0.);
      CellSystem system{n, u.data(), residual.data(), full.data()};
      term.add(k, system);
      const auto &range = box.points->ranges()[k];
      bare.integrate(range.begin, range.end, K);
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int e = 0; e < dim * dim; ++e)
            {
              const unsigned int turned   = e % dim * dim + e / dim;
              const double       expected = a <= b ?
                                              K[(a * n + b) * dim * dim + e] :
                                              K[(b * n + a) * dim * dim + turned];
              largest = std::max(largest, std::abs(expected));
              worst   = std::max(worst,
                               std::abs(expected -
                                        full[(a * n + b) * dim * dim + e]));
            }
    }
  return worst / largest;
}

template <int dim>
bool compare(const unsigned int cells,
             const unsigned int repetitions,
             const bool         time_counts)
{
  Box<dim>              linear(cells, "linear elastic");
  Box<dim>              neo_hookean(cells, "neo-Hookean");
  const BareKernel<dim> bare(linear, false), bare_own_D(linear, true);
  const auto           &points = *linear.points;
  double                sink   = 0;
  // as PointCloud holds them
  std::vector<Point<dim>> places(points.n());
  std::vector<double>     supports(linear.basis.support_size(0) * points.n());

  Least kernel, kernel_own_D, shapes, linear_tangent, linear_residual,
    neo_hookean_tangent, neo_hookean_residual;
  const auto evaluate = [](Least &least, Box<dim> &box, const bool tangent) {
    least.time([&] { box.system.evaluate(box.u, tangent); });
  };
  for (unsigned int i = 0; i < repetitions; ++i)
    {
      kernel.time([&] { sink += bare.run(); });
      kernel_own_D.time([&] { sink += bare_own_D.run(); });
      shapes.time([&] {
        for (const auto &range : points.ranges())
          {
            for (unsigned int p = range.begin; p < range.end; ++p)
              places[p] =
                linear.grid.to_reference(range.cell, points.position(p));
            linear.basis.evaluate(
              range.cell,
              ArrayView<const Point<dim>>(places.data() + range.begin,
                                          range.end - range.begin),
              supports.data() +
                range.begin * linear.basis.support_size(range.cell));
          }
        sink += supports[0];
      });
      evaluate(linear_tangent, linear, true);
      evaluate(neo_hookean_tangent, neo_hookean, true);
      evaluate(linear_residual, linear, false);
      evaluate(neo_hookean_residual, neo_hookean, false);
    }

  const double unlike =
    std::max(difference(linear, bare), difference(neo_hookean, bare));
  const auto print = [&](const char *what, const double seconds) {
    std::printf("  %-30s %8.2f ms %7.0f ns/point %6.2f %6.2f\n",
                what,
                1e3 * seconds,
                1e9 * seconds / points.n(),
                seconds / kernel.seconds,
                seconds / kernel_own_D.seconds);
    return seconds / kernel.seconds;
  };
  std::printf("%dD, %u cells, %u points (checksum %.3g)\n",
              dim,
              linear.active.n_cells(),
              points.n(),
              sink);
  print("bare kernel", kernel.seconds);
  print("bare kernel, a D a point", kernel_own_D.seconds);
  print("shape values", shapes.seconds);
  print("linear elastic, residual", linear_residual.seconds);
  print("neo-Hookean, residual", neo_hookean_residual.seconds);
  const bool fast   = print("linear elastic, tangent",
                          shapes.seconds + linear_tangent.seconds) <= 2.5;
  const bool faster = print("neo-Hookean, tangent",
                            shapes.seconds + neo_hookean_tangent.seconds) <= 4;
  std::printf("  goals 2.5 and 4: %s; largest difference of cell matrices "
              "%.1e\n",
              fast && faster ? "met" : "missed",
              unlike);
  return ((fast && faster) || !time_counts) && unlike < 1e-13;
}

int main(int argc, char *argv[])
{
  int                              no_arguments = 1;
  Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  if (argc > 1 && std::string(argv[1]) == "--small")
    return compare<2>(8, 1, false) && compare<3>(4, 1, false) ? 0 : 1;
  const unsigned int repetitions = argc > 1 ? std::atoi(argv[1]) : 20;
  const bool         plane       = compare<2>(200, repetitions, true);
  const bool         space       = compare<3>(31, repetitions, true);
  return plane && space ? 0 : 1;
}
