#include <impoint/base/parameter_file.h>
#include <impoint/materials/material.h>
#include <impoint/scene.h>

namespace Impoint
{
  void OutputParameters::declare(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.enter_subsection("Output");
    prm.add_parameter("Folder",
                      folder,
                      "Where the results go; relative to this file.",
                      Patterns::Anything());
    prm.add_parameter("Verbosity",
                      verbosity,
                      "What the terminal shows: nothing, the table of results, "
                      "also the steps, or also where the time went.",
                      Patterns::Selection("silent|results|normal|talkative"));
    prm.add_parameter("Pictures every",
                      every,
                      "Steps between two pictures for ParaView (the first and "
                      "last state are always pictured); 0: no pictures at all.",
                      Patterns::Integer(0));
    prm.add_parameter("Checkpoint every",
                      checkpoint_every,
                      "Steps between two checkpoints, from which 'impoint "
                      "--resume FOLDER' goes on; 0: none by steps. A run that "
                      "was resumed ends with the same digits.",
                      Patterns::Integer(0));
    prm.add_parameter("Checkpoint minutes",
                      checkpoint_minutes,
                      "Minutes between two checkpoints, which wait for a step "
                      "where the solver starts anew (every hundred residuals); "
                      "0: none by time. A run that was resumed ends with the "
                      "same digits.",
                      Patterns::Double(0));
    prm.leave_subsection();
    file.declare_as_path("Output/Folder");
  }



  template <int dim>
  Scene<dim>::Scene(ParameterFile &file)
  {
    declare_entries(file);
    file.apply();
    for (auto &body : bodies)
      body.complete(grid.degree());
    for (auto &boundary : boundaries)
      boundary.complete(grid.degree());
    time.complete(grid.is_positive());
    check(file);
  }



  template <int dim>
  void Scene<dim>::declare(ParameterFile &file)
  {
    // The handler keeps addresses of the members: they live as long as it.
    static Scene<dim> scene;
    scene.declare_entries(file);
  }



  template <int dim>
  void Scene<dim>::declare_entries(ParameterFile &file)
  {
    auto &prm = file.handler();
    prm.add_parameter("Title", title, "What the scene shows, in a line.");
    prm.declare_entry("Dimension",
                      "2",
                      Patterns::Selection("2|3"),
                      "Dimension of space; 2 is plane strain.");
    grid.declare(file);

    prm.enter_subsection("Bodies");
    prm.declare_entry("Names",
                      "",
                      Patterns::Anything(),
                      "Names of the bodies, separated by commas; each has a "
                      "section of its name.");
    prm.leave_subsection();
    for (const std::string &name : file.names("Bodies/Names"))
      {
        bodies.emplace_back().declare(file, name);
        Materials::declare_parameters(file, "Bodies/" + name + "/Material");
      }

    prm.enter_subsection("Boundaries");
    prm.declare_entry(
      "Names",
      "",
      Patterns::Anything(),
      "Names of the boundaries, separated by commas; each has a "
      "section of its name.");
    prm.leave_subsection();
    for (const std::string &name : file.names("Boundaries/Names"))
      {
        boundaries.emplace_back().declare(file, name);
        conditions.emplace_back().declare(file, name);
      }

    time.declare(file);
    newton.declare(file);
    linear_solver.declare(file);

    prm.enter_subsection("Measurements");
    prm.declare_entry(
      "Names",
      "",
      Patterns::Anything(),
      "Names of what is measured, separated by commas; each has "
      "a section of its name.");
    prm.leave_subsection();
    for (const std::string &name : file.names("Measurements/Names"))
      measurements.emplace_back().declare(file, name);
    output.declare(file);
  }



  template <int dim>
  void Scene<dim>::check(const ParameterFile &file) const
  {
    grid.check(file, dim);
    if (bodies.empty())
      throw file.error("Bodies/Names",
                       "the scene has no body",
                       "Name one, e.g. Names = block, and describe it in a "
                       "section of that name.");
    for (const auto &body : bodies)
      {
        body.check(file, dim);
        for (const std::string entry :
             {"Initial velocity", "Initial acceleration"})
          if (file.is_set(body.section + "/" + entry) &&
              (!time.is_dynamic() ||
               (entry == "Initial acceleration" &&
                time.initial != InitialAcceleration::expression)))
            throw file.error(body.section + "/" + entry,
                             "'" + entry +
                               "' is set though section 'Time' has "
                               "no use for it",
                             "Remove it, or set Kind = dynamic (and Initial "
                             "acceleration = expression) in section 'Time'.");
        if (!boundaries.empty() && body.thickness != bodies.front().thickness)
          throw file.error(body.section + "/Thickness",
                           "body '" + body.name +
                             "' has another thickness than "
                             "body '" +
                             bodies.front().name + "'",
                           "Boundaries act on one thickness: give all bodies "
                           "the same.");
        if (!(body.density > 0))
          throw file.error(body.section + "/Density",
                           "the density of body '" + body.name + "' is " +
                             file.value(body.section + "/Density"),
                           "Set the mass per volume in kg/m3, above 0.");
      }
    for (unsigned int i = 0; i < boundaries.size(); ++i)
      {
        boundaries[i].check(file, dim);
        conditions[i].check(file, dim, boundaries[i].conforming);
        check_effect(file, conditions[i]);
      }
    time.check(file);
    check_reset(file);
    if (time.mass == MassMatrix::lumped && !grid.is_positive())
      throw file.error("Time/Mass",
                       "lumped masses of a 'quadratic' basis need not be "
                       "positive",
                       "Set Mass = consistent, Basis = quadratic spline on a "
                       "Cartesian grid, or Basis = linear.");
    // The vortex would gain up to four times its energy, the vibrating bar lose
    // two thirds.
    if (time.is_dynamic() && !grid.is_positive() && !grid.is_kept())
      throw file.error("Grid/Basis",
                       "a 'quadratic' basis in motion on a grid that is reset: "
                       "where points leave the cells they were placed in, its "
                       "masses need not be positive",
                       "Set Reset = never, Basis = quadratic spline on a "
                       "Cartesian grid, or Basis = linear.");
    for (const auto &measurement : measurements)
      measurement.check(file, dim);
    check_support(file);
  }



  /** Refuses what needs places where a kept grid has none. */
  template <int dim>
  void Scene<dim>::check_reset(const ParameterFile &file) const
  {
    if (!grid.is_kept())
      return;
    const auto refuse = [&](const std::string &path, const std::string &wrong) {
      throw file.error(path,
                       wrong + ", and the grid is never reset",
                       "Take the entry away, or set 'Reset = every step' in "
                       "section 'Grid'.");
    };
    for (const auto &condition : conditions)
      {
        if (condition.releasing)
          refuse(condition.section + "/Releasing",
                 "boundary '" + condition.name +
                   "' may touch the material anywhere");
        if (condition.friction > 0)
          refuse(condition.section + "/Friction coefficient",
                 "the material slides along boundary '" + condition.name + "'");
      }
    if (time.filter > 0)
      refuse("Time/Velocity filter", "the grid sees all velocities");
  }



  /** Refuses boundaries that would do nothing in the run. */
  template <int dim>
  void Scene<dim>::check_effect(const ParameterFile       &file,
                                const ConditionParameters &condition) const
  {
    const std::string traction = condition.section + "/Traction";
    if (condition.constraint == Constraint::traction &&
        file.value(traction).empty())
      throw file.error(traction,
                       "boundary '" + condition.name + "' has no traction",
                       "Set the load per area, e.g. Traction = " +
                         std::string(dim == 2 ? "0; -1e3" : "0; 0; -1e3") +
                         " [Pa].");
    const std::string run =
      ", and the run goes from 0 to " + file.value("Time/End time") + " s";
    if (condition.from >= time.end)
      throw file.error(condition.section + "/Active from",
                       "boundary '" + condition.name + "' acts from " +
                         file.value(condition.section + "/Active from") +
                         " s on" + run,
                       "Set an earlier time, or a later 'End time'.");
    if (condition.until <= 0)
      throw file.error(condition.section + "/Active until",
                       "boundary '" + condition.name + "' acts until " +
                         file.value(condition.section + "/Active until") +
                         " s" + run,
                       "Set a later time, or take the boundary away.");
  }



  template <int dim>
  void Scene<dim>::check_support(const ParameterFile &file) const
  {
    bool held = time.moves_after(0);
    for (const auto &condition : conditions)
      held |= condition.constraint != Constraint::traction;
    if (!held)
      throw file.error("Boundaries/Names",
                       "nothing holds the bodies of a quasi-static scene",
                       "Add a boundary that is fixed, a roller or slip, or set "
                       "Kind = dynamic in section 'Time'.");
  }

  /** Numbers of the user's that are too small for the basis: functions are
   * free between the places where particles see them. */
  template <int dim>
  std::vector<std::string> Scene<dim>::doubts() const
  {
    std::vector<std::string> doubts;
    const unsigned int       wanted = grid.degree() + 1;
    const auto               doubt  = [&](const std::string &what,
                           const std::string &entry,
                           const unsigned int number,
                           const unsigned int least) {
      if (grid.degree() > 1 && number < least)
        doubts.push_back(what + " has '" + entry + " = " +
                         std::to_string(number) + "', few for a basis '" +
                         grid.basis + "'. Set " + std::to_string(wanted) +
                         ", or take the entry away.");
    };
    for (const auto &body : bodies)
      if (body.clipped)
        doubt("Body '" + body.name + "'",
              "Points per direction",
              body.rule,
              grid.basis == "quadratic" ? wanted : grid.degree());
    for (const auto &boundary : boundaries)
      if (!boundary.conforming && boundary.rule == BoundaryRule::cut)
        doubt("Boundary '" + boundary.name + "'",
              "Particles per segment",
              boundary.particles_per_segment,
              wanted);
    for (const auto &[entry, consistent] :
         {std::pair<std::string, bool>("Mass",
                                       time.mass == MassMatrix::consistent),
          {"Projection", time.consistent_projection}})
      if (time.is_dynamic() && consistent && !grid.is_kept())
        doubts.push_back(
          "'" + entry +
          " = consistent' on a grid that is reset: where points "
          "leave the cells they were placed in, this mass is no "
          "longer positive for some motions, and steps may fail. "
          "Set '" +
          entry + " = lumped', or 'Reset = never' in section 'Grid'.");
    return doubts;
  }

  template struct Scene<2>;
  template struct Scene<3>;
} // namespace Impoint
