#include <impoint/output/summary.h>

#include <nlohmann/json.hpp>

namespace Impoint
{
  namespace
  {
    using SummaryJson = nlohmann::ordered_json;

    SummaryJson summary_of_method(const RunRecord &record)
    {
      SummaryJson boundaries = SummaryJson::object();
      for (const auto &[name, method] : record.boundaries)
        boundaries[name] = method;
      return {{"basis", record.basis},
              {"solver", record.solver},
              {"boundaries", boundaries}};
    }

    SummaryJson summary_of_results(const RunRecord &record)
    {
      SummaryJson results = SummaryJson::object();
      for (const Result &result : record.results)
        {
          SummaryJson &entry = results[result.name];
          entry["value"]     = result.value;
          if (!std::isnan(result.reference))
            {
              entry["reference"] = result.reference;
              entry["error"]     = result.error();
            }
        }
      return results;
    }

    SummaryJson summary_of_counts(const RunRecord &record)
    {
      const Counters &counters = record.counters;
      return {{"steps", counters.steps},
              {"halved steps", counters.halved_steps},
              {"points", record.points},
              {"boundary particles", record.boundary_particles},
              {"unknowns", record.unknowns},
              {"sorts", counters.sorts},
              {"searches", counters.searches},
              {"shape values", counters.shape_values},
              {"patterns", counters.patterns},
              {"tangents", counters.tangents},
              {"residuals", counters.residuals},
              {"factorisations", counters.factorisations},
              {"linear iterations", counters.linear_iterations},
              {"newton iterations", counters.newton_iterations},
              {"projections", counters.projections},
              {"visited cells", counters.visited_cells},
              {"visited nodes", counters.visited_nodes},
              {"starved cells", counters.starved_cells}};
    }

    SummaryJson summary_of_seconds(const Seconds &seconds)
    {
      return {{"total", seconds.total},
              {"setup", seconds.setup},
              {"locate", seconds.locate},
              {"pattern", seconds.pattern},
              {"project", seconds.project},
              {"assembly", seconds.assembly},
              {"solve", seconds.solve},
              {"update", seconds.update},
              {"output", seconds.output}};
    }
  } // namespace



  void write_summary(const RunRecord &record, const OutputFolder &folder)
  {
    SummaryJson summary;
    // a run that was stopped is not done, which is all that scripts ask for
    summary["status"] = record.status == "done" ? "done" : "failed";
    if (record.status != "done")
      summary["message"] = record.message;
    summary["scene"]       = record.scene;
    summary["version"]     = IMPOINT_VERSION;
    summary["dimension"]   = record.dimension;
    summary["ranks"]       = record.ranks;
    summary["method"]      = summary_of_method(record);
    summary["results"]     = summary_of_results(record);
    summary["warnings"]    = record.warnings;
    summary["counts"]      = summary_of_counts(record);
    summary["seconds"]     = summary_of_seconds(record.seconds);
    summary["peak memory"] = record.peak_memory;

    // names with broken UTF-8 must not cost the summary of a long run
    folder.write(
      "summary.json",
      summary.dump(2, ' ', false, SummaryJson::error_handler_t::replace) +
        '\n');
  }
} // namespace Impoint
