#include <impoint/base/parameter_file.h>
#include <impoint/grid/support_size.h>
#include <impoint/solver/inertia.h>

#include <algorithm>

namespace Impoint
{
  void TimeParameters::declare(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.enter_subsection("Time");
    prm.add_parameter("Kind",
                      kind,
                      "quasi-static: load steps without inertia; dynamic: "
                      "Newmark's method.",
                      Patterns::Selection("quasi-static|dynamic"));
    prm.add_parameter("End time",
                      end,
                      "Time at which the run ends [s].",
                      Patterns::Double(1e-300));
    prm.add_parameter("Step",
                      step,
                      "Size of a step [s]; halved and grown again where a step "
                      "fails.",
                      Patterns::Double(1e-300));
    prm.add_parameter(
      "Smallest step",
      smallest,
      "Part of 'Step' below which steps are not halved: the run "
      "fails instead.",
      Patterns::Double(0, 1));
    prm.add_parameter("Newmark beta",
                      beta,
                      "Newmark's parameter beta.",
                      Patterns::Double(1e-3, 1));
    prm.add_parameter("Newmark gamma",
                      gamma,
                      "Newmark's parameter gamma; above 0.5 it damps.",
                      Patterns::Double(0.5, 1));
    prm.add_parameter("Mass",
                      mass,
                      "Mass matrix of the nodes.",
                      Patterns::Selection("lumped|consistent"));
    prm.add_parameter("Initial acceleration",
                      initial,
                      "equilibrium: M a = f at the start; zero; expression: "
                      "'Initial acceleration' of each body.",
                      Patterns::Selection("equilibrium|zero|expression"));
    prm.leave_subsection();
  }



  void TimeParameters::check(const ParameterFile &file) const
  {
    if (step > end)
      throw file.error("Time/Step",
                       "the step of " + file.value("Time/Step") +
                         " s is longer than the run of " +
                         file.value("Time/End time") + " s",
                       "Set Step to at most 'End time'.");
    if (!is_dynamic())
      for (const std::string entry :
           {"Newmark beta", "Newmark gamma", "Mass", "Initial acceleration"})
        if (file.is_set("Time/" + entry))
          throw file.error("Time/" + entry,
                           "'" + entry + "' is set in a quasi-static scene",
                           "Set Kind = dynamic, or remove the entry.");
    if (beta < 0.25 * (0.5 + gamma) * (0.5 + gamma) - 1e-12)
      throw file.error("Time/Newmark beta",
                       "Newmark's method is not stable with beta = " +
                         file.value("Time/Newmark beta"),
                       "Set beta to at least (1/2 + gamma)^2 / 4.");
  }



  template <int dim>
  Inertia<dim>::Inertia(const TimeParameters &parameters)
    : beta(parameters.beta)
    , gamma(parameters.gamma)
    , is_consistent(parameters.mass == "consistent")
  {}



  /** Sums of one cell's points: mass, then momentum, then inertia force. */
  template <int dim>
  template <int n_static>
  void Inertia<dim>::project_cell(const MaterialPoints<dim>             &points,
                                  const typename PointCloud<dim>::Range &range,
                                  const ArrayView<const unsigned int>    nodes)
  {
    const unsigned int n     = n_static > 0 ? n_static : nodes.size();
    const auto        &slots = points.slots();
    double             sums[array_size<n_static> * (2 * dim + 1)];
    std::fill(sums, sums + n * (2 * dim + 1), 0.);
    for (unsigned int p = range.begin; p < range.end; ++p)
      {
        const double *N     = points.support(p);
        const double *state = points.data(p);
        double        moving[2 * dim];
        for (unsigned int d = 0; d < dim; ++d)
          {
            moving[d]       = state[slots.v + d];
            moving[dim + d] = state[slots.a + d];
          }
        for (unsigned int a = 0; a < n; ++a)
          {
            const double part = N[a] * state[slots.mass];
            double      *sum  = sums + a * (2 * dim + 1);
            sum[0] += part;
            for (unsigned int d = 0; d < 2 * dim; ++d)
              sum[d + 1] += part * moving[d];
          }
      }
    for (unsigned int a = 0; a < n; ++a)
      {
        const double      *sum = sums + a * (2 * dim + 1);
        const unsigned int i   = nodes[a];
        masses.local_element(i) += sum[0];
        for (unsigned int d = 0; d < dim; ++d)
          {
            velocities.local_element(i * dim + d) += sum[d + 1];
            accelerations.local_element(i * dim + d) += sum[dim + d + 1];
          }
      }
  }



  template <int dim>
  void Inertia<dim>::project(const ActiveNodes<dim>    &active,
                             const MaterialPoints<dim> &points,
                             const double               time_step)
  {
    // A node whose mass is round-off gets no velocity rather than a quotient.
    constexpr double smallest_mass = 1e-12;

    dt = time_step;
    masses.reinit(active.scalars());
    velocities.reinit(active.unknowns());
    accelerations.reinit(active.unknowns());
    for (unsigned int k = 0; k < active.n_material_cells(); ++k)
      with_support_size<dim>(active.nodes(k).size(), [&](const auto n_static) {
        project_cell<n_static>(points, points.ranges()[k], active.nodes(k));
      });
    for (Vector *vector : {&masses, &velocities, &accelerations})
      vector->compress(VectorOperation::add);
    const double threshold = smallest_mass * masses.linfty_norm();
    for (Vector *vector : {&masses, &velocities, &accelerations})
      vector->update_ghost_values();
    for (unsigned int i = 0; i < active.n_nodes(); ++i)
      {
        const double mass    = masses.local_element(i);
        const double inverse = mass > threshold ? 1. / mass : 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            velocities.local_element(i * dim + d) *= inverse;
            accelerations.local_element(i * dim + d) *= inverse;
          }
      }
  }

  template class Inertia<2>;
  template class Inertia<3>;
} // namespace Impoint
