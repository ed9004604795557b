#include <impoint/base/parameter_file.h>
#include <impoint/solver/time_parameters.h>

namespace Impoint
{
  void TimeParameters::declare(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.enter_subsection("Time");
    prm.add_choice("Kind",
                   dynamic,
                   "quasi-static: load steps without inertia; dynamic: "
                   "Newmark's method.",
                   {{"quasi-static", false}, {"dynamic", true}});
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
      "Dynamic from",
      dynamic_from,
      "Time [s] at which the motion of a dynamic scene starts, from the state "
      "that load steps without inertia have brought about until then, e.g. "
      "stresses by weight.",
      Patterns::Double(0));
    prm.add_parameter("Smallest step",
                      smallest,
                      "Part of 'Step' to which steps are halved at most.",
                      Patterns::Double(1e-12, 1));
    prm.add_parameter("Newmark beta",
                      beta,
                      "Newmark's parameter beta.",
                      Patterns::Double(1e-3, 1));
    prm.add_parameter("Newmark gamma",
                      gamma,
                      "Newmark's parameter gamma; above 0.5 it damps.",
                      Patterns::Double(0.5, 1));
    prm.add_parameter(
      "Spectral radius",
      spectral_radius,
      "Bossak's variant: what a step leaves of the highest frequencies; 1: no "
      "damping, 0.8 little, 0 most. It sets Newmark's beta and gamma.",
      Patterns::Double(0, 1));
    prm.add_parameter(
      "Velocity filter",
      filter,
      "Time [s] in which fades what the grid doesn't see of the points' "
      "velocities. It moves no point, but piles up where points flow through "
      "cells and stays for ever; 0: no filter.",
      Patterns::Double(0));
    prm.add_parameter(
      "Filter at rest",
      filter_at_rest,
      "Time [s] of the velocity filter while the kinetic energy is below 1e-4 of "
      "its largest before, such as a time step: what flowed comes to rest, and the "
      "grid gives points in sparse cells unseen velocities for ever; 0: as "
      "'Velocity filter'.",
      Patterns::Double(0));
    declare_masses(file);
    prm.leave_subsection();
  }



  void TimeParameters::declare_masses(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.add_choice(
      "Mass",
      mass,
      "Mass matrix of the nodes. automatic: lumped, but consistent "
      "with a 'quadratic' basis, whose lumped masses need not be "
      "positive.",
      {{"automatic", MassMatrix::automatic},
       {"lumped", MassMatrix::lumped},
       {"consistent", MassMatrix::consistent}});
    prm.add_choice(
      "Projection",
      consistent_projection,
      "Velocities of the nodes at the start of a step; of the run where the "
      "grid is never reset. lumped: means of what the points have, with "
      "positive weights (P Eqs. 18-19), which smooth it; consistent: the least "
      "squares' fit.",
      {{"lumped", false}, {"consistent", true}});
    prm.add_choice("Initial acceleration",
                   initial,
                   "equilibrium: M a = f at the start; zero; expression: "
                   "'Initial acceleration' of each body.",
                   {{"equilibrium", InitialAcceleration::equilibrium},
                    {"zero", InitialAcceleration::zero},
                    {"expression", InitialAcceleration::expression}});
  }



  void TimeParameters::complete(const bool positive)
  {
    if (mass == MassMatrix::automatic)
      mass = positive ? MassMatrix::lumped : MassMatrix::consistent;
  }



  void TimeParameters::check(const ParameterFile &file) const
  {
    if (step > end)
      throw file.error("Time/Step",
                       "the step of " + file.value("Time/Step") +
                         " s is longer than the run of " +
                         file.value("Time/End time") + " s",
                       "Set Step to at most 'End time'.");
    const double most_steps = 1e9;
    if (step * most_steps < end)
      throw file.error("Time/Step",
                       "steps of " + file.value("Time/Step") +
                         " s in a run of " + file.value("Time/End time") +
                         " s are more than 1e9",
                       "Set a longer step.");
    if (dynamic_from >= end)
      throw file.error("Time/Dynamic from",
                       "the motion starts at " +
                         file.value("Time/Dynamic from") +
                         " s and the run ends at " +
                         file.value("Time/End time") + " s",
                       "Set an earlier time, or Kind = quasi-static.");
    if (!is_dynamic())
      for (const std::string entry : {"Dynamic from",
                                      "Newmark beta",
                                      "Newmark gamma",
                                      "Spectral radius",
                                      "Velocity filter",
                                      "Filter at rest",
                                      "Mass",
                                      "Projection",
                                      "Initial acceleration"})
        if (file.is_set("Time/" + entry))
          throw file.error("Time/" + entry,
                           "'" + entry + "' is set in a quasi-static scene",
                           "Set Kind = dynamic, or remove the entry.");
    if (filter_at_rest > 0 && filter == 0)
      throw file.error("Time/Filter at rest",
                       "'Filter at rest' is set, but there is no filter",
                       "Set 'Velocity filter', too, or take the entry away.");
    for (const std::string entry : {"Newmark beta", "Newmark gamma"})
      if (spectral_radius < 1 && file.is_set("Time/" + entry))
        throw file.error("Time/" + entry,
                         "'" + entry + "' is set, and 'Spectral radius', too",
                         "Take one of them away: the latter sets beta and "
                         "gamma.");
    if (beta < 0.25 * (0.5 + gamma) * (0.5 + gamma) - 1e-12)
      throw file.error("Time/Newmark beta",
                       "Newmark's method is not stable with beta = " +
                         file.value("Time/Newmark beta"),
                       "Set beta to at least (1/2 + gamma)^2 / 4.");
  }
} // namespace Impoint
