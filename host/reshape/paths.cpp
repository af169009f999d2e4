// Whether the two global systems are factored, decided by what that would take.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>

#include "plan.h"

namespace swage {
namespace {

constexpr double kBytesAnEntry = 12;            // In double while it is made, and in single.
constexpr double kMostBytes = 4.0 * (1 << 30);  // Beyond, multigrid is faster, even where the factor is made already.
constexpr Eigen::Index kFewVertices = 1500;     // Factored as fast.

/// Of the machine, or of the control group where that has less. Not what is free now: results must not depend on it.
double memory() {
  double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  for (const char* path : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    double limit = 0;
    if (std::ifstream(path) >> limit && limit > 0) bytes = std::min(bytes, limit);
  }
  return bytes;
}

std::string gigabytes(double bytes) {
  const std::string text = std::to_string(std::round(bytes / 1e8) / 10);
  return text.substr(0, text.find('.') + 2) + " GB";
}

}  // namespace

/// By nested dissection the transform step's factor has c n log2 n entries; c was 130 to 160 on models of 20,000 to
/// 340,000 triangles.
double factor_bytes(Eigen::Index triangle_count) {
  const auto n = static_cast<double>(std::max<Eigen::Index>(triangle_count, 2));
  return kBytesAnEntry * 150 * n * std::log2(n);
}

const char* to_string(LinearSolver solver) {
  switch (solver) {
    case LinearSolver::factor:
      return "factor";
    case LinearSolver::multigrid:
      return "multigrid";
    case LinearSolver::automatic:
      break;
  }
  return "auto";
}

Paths choose_paths(const ReshapeOptions& options, Eigen::Index vertex_count, Eigen::Index triangle_count,
                   bool has_straight_chains) {
  using enum LinearSolver;
  Paths paths;
  const bool forced = options.linear_solver != automatic;
  if (forced || options.solver == ReshapeSolver::published || options.refactor_every_pass) {
    paths.vertices = paths.transforms = forced ? options.linear_solver : factor;
    paths.why_vertices = paths.why_transforms = forced ? "as asked" : "as published";
  } else {
    const double needed = factor_bytes(triangle_count);
    const double allowed =
        options.factor_memory > 0 ? static_cast<double>(options.factor_memory) : std::min(memory() / 4, kMostBytes);
    paths.transforms = needed <= allowed ? factor : multigrid;
    paths.why_transforms = "a factor takes about " + gigabytes(needed) +
                           (needed <= allowed ? ", at most " : ", over ") + gigabytes(allowed);
    paths.vertices = vertex_count < kFewVertices ? factor : multigrid;
    paths.why_vertices = std::to_string(vertex_count) + " vertices";
  }
  if (has_straight_chains && paths.vertices == multigrid) {
    paths.vertices = factor;
    paths.why_vertices = "straight chains, too stiff for multigrid";
  }
  return paths;
}

}  // namespace swage
