#include "deform.h"

#include <spdlog/fmt/fmt.h>

#include <utility>

#include "failure.h"

namespace swage::cli {

std::optional<DeformMethod> deform_method(const std::string& name) {
  using enum DeformMethod;
  for (const DeformMethod method : {poisson, arap, arap_volume, conformal}) {
    if (name == to_string(method)) return method;
  }
  return std::nullopt;
}

void check_deform_job(const ReshapeJob& job) {
  const ReshapeJob defaults;
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw WrongUsage(fmt::format("{} does not go with --method {}: leave one out", option, job.method));
  };
  if (!deform_method(job.method)) {
    if (!job.handle_weight) return;
    throw WrongUsage(fmt::format(
        "--handle-weight is for --method poisson, arap, arap-volume and conformal, not {}: leave it out", job.method));
  }
  refuse(job.solver != defaults.solver, "--solver");
  refuse(job.linear_solver != defaults.linear_solver, "--linear-solver");
  refuse(!job.curvature.empty(), "--curvature");
  refuse(job.straight != defaults.straight, "--straight");
  refuse(job.feature_angle != defaults.feature_angle, "--feature-angle");
  refuse(job.no_finalise, "--no-finalise");
  refuse(job.remesh == "always", "--remesh always");
  refuse(!job.scaffold_mesh.empty(), "--scaffold-mesh");
}

DeformOptions deform_options(const ReshapeJob& job, DeformMethod method, const ReshapeOptions& options) {
  DeformOptions result;
  result.method = method;
  result.handle_weight = job.handle_weight;
  result.scaffold = options.scaffold;
  result.backend = options.backend;
  return result;
}

ReshapeResult as_reshaped(DeformResult result) {
  ReshapeResult reshaped;
  reshaped.unfinished = result.positions;
  reshaped.positions = std::move(result.positions);
  reshaped.report = std::move(result.report);
  return reshaped;
}

}  // namespace swage::cli
