#include "reshape_json.h"

#include "changes.h"
#include "deform.h"

namespace swage::cli {

Json report_json(const ReshapeJob& job, const MeshFile& file, const Gesture& gesture, const ReshapeResult& result,
                 const Backend& backend, const RunSeconds& seconds) {
  std::vector<std::string> warnings = file.warnings;
  warnings.insert(warnings.end(), result.report.warnings.begin(), result.report.warnings.end());
  Json json = run_json("reshape", job.mesh, file.mesh, job.method);
  if (!deform_method(job.method)) json["solver"] = job.solver;
  add_backend(json, backend);
  add_solve(json, result.report, warnings);
  add_changes(json, file.mesh, gesture, result.positions, warnings);
  const double miss = largest_miss(gesture, result.unfinished) / box_diagonal(file.mesh.positions);
  json["handle_error_unfinished"] = finite(miss, "handle_error_unfinished", warnings);
  json["finalised"] = result.finalised;
  json["straight_chains"] = result.straight_chains;
  add_costs(json, result.report, backend, seconds);
  json["warnings"] = warnings;
  return json;
}

}  // namespace swage::cli
