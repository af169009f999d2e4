#include "straight.h"

#include <spdlog/spdlog.h>

#include <numbers>

#include "failure.h"
#include "options.h"
#include "swage/features.h"
#include "swage/handles.h"

namespace swage::cli {

void add_finding_options(CLI::App& app, StraightFinding& finding, CLI::Option& straight) {
  app.add_option("--straight-angle", finding.angle,
                 "Straight chains are found along edges of a smaller interior angle, degrees (160)")
      ->group(straight.get_group())
      ->needs(&straight)
      ->check(between(0, 180))
      ->type_name("DEG");
  app.add_option("--straight-shortest", finding.shortest, "The shortest chain found, in box diagonals (0.05)")
      ->group(straight.get_group())
      ->needs(&straight)
      ->check(between(0, 1))
      ->type_name("FRACTION");
}

namespace {

StraightOptions as_options(const StraightFinding& finding) {
  StraightOptions options;
  if (finding.angle) options.feature_angle = *finding.angle * std::numbers::pi / 180;
  options.shortest = finding.shortest.value_or(options.shortest);
  return options;
}

}  // namespace

std::vector<std::vector<int>> find_chains(const Mesh& mesh, const StraightFinding& finding) {
  std::vector<std::vector<int>> chains = straight_chains(mesh.positions, mesh.triangles, as_options(finding));
  spdlog::info("{} straight chains found", chains.size());
  return chains;
}

void set_chains(const std::string& straight, const StraightFinding& finding, const Mesh& mesh,
                ReshapeOptions& options) {
  if (straight == "auto") {
    options.find_chains = as_options(finding);
  } else if (straight != "none") {
    options.straight_chains = read_straight_chains(straight, static_cast<int>(mesh.positions.rows()));
  }
}

void check_finding(const std::string& straight, const StraightFinding& finding) {
  if (straight == "auto" || !(finding.angle || finding.shortest)) return;
  throw WrongUsage("--straight-angle and --straight-shortest go with --straight auto: leave them out");
}

void check(const ChainsOutput& output, const std::string& json) {
  const std::string& path = output.path;
  if (path.empty()) return;
  if (path == kStdout) throw WrongUsage("--straight -: name a file: stdout is for what the mesh is like");
  if (path == json)
    throw WrongUsage(fmt::format("--straight and --json both name {}: give them different files", path));
  check_can_be_written(path, "--straight");
}

void write(const ChainsOutput& output, const Mesh& mesh) {
  if (!output.path.empty()) write_straight_chains(output.path, find_chains(mesh, output.finding));
}

}  // namespace swage::cli
