// The energy that decides when to stop.
#include "plan.h"

namespace swage {
namespace {

double straightness(const Positions& positions, const std::vector<StraightTriple>& straight) {
  double total = 0;
  for (const StraightTriple& triple : straight) {
    const Eigen::RowVector3d before = positions.row(triple.before) - positions.row(triple.middle);
    const Eigen::RowVector3d after = positions.row(triple.middle) - positions.row(triple.after);
    total += (before.normalized() - after.normalized()).squaredNorm();
  }
  return total;
}

double handle_misses(const Positions& positions, const Holds& handles) {
  double total = 0;
  for (size_t h = 0; h < handles.vertices.size(); ++h) {
    total += (positions.row(handles.vertices[h]) - handles.targets.row(static_cast<Eigen::Index>(h))).squaredNorm();
  }
  return total;
}

}  // namespace

std::map<std::string, double> energy_terms(const TransformStep::Energy& local, const Positions& positions,
                                           const std::vector<StraightTriple>& straight, const StepWeights& weights,
                                           const Holds& handles) {
  return {
      {"transform", local.transform},
      {"normal", local.normal},
      {"scale", local.scale},
      {"sphericity", local.sphericity},
      {"straightness", weights.straightness * straightness(positions, straight)},
      {"handle", handles.weight * handle_misses(positions, handles)},
      {"connect", local.connect},
      {"similarity", local.similarity},
      {"transform_normal", weights.transform_normal * local.transform_normal},
      // The published program counts this in place of the transform step's own transform term.
      {"transform_normal_again", local.transform_normal},
      {"transform_sphericity", local.transform_sphericity},
      {"regularizer", local.regularizer},
  };
}

double sum(const std::map<std::string, double>& terms) {
  double total = 0;
  for (const auto& [name, value] : terms) total += value;
  return total;
}

}  // namespace swage
