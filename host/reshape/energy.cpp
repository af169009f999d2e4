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
  for (const Hold& hold : handles.points) total += hold.share * (hold.point(positions) - hold.target).squaredNorm();
  return total;
}

double tie_misses(const Positions& positions, const std::vector<Tie>& ties) {
  double total = 0;
  for (const Tie& tie : ties) {
    Eigen::RowVector3d sum = -tie.rest;
    for (const auto& [v, factor] : tie.factors) sum += factor * positions.row(v);
    total += tie.weight * sum.squaredNorm();
  }
  return total;
}

}  // namespace

double largest_miss(const Holds& handles, const Positions& positions) {
  double largest = 0;
  for (const Hold& hold : handles.points) largest = std::max(largest, (hold.point(positions) - hold.target).norm());
  return largest;
}

std::map<std::string, double> energy_terms(const TransformStep::Energy& local, const Positions& positions,
                                           const Bonds& bonds, const StepWeights& weights, const Holds& handles) {
  return {
      {"transform", local.transform},
      {"normal", local.normal},
      {"scale", local.scale},
      {"sphericity", local.sphericity},
      {"straightness", bonds.straightness_weight * straightness(positions, bonds.straight)},
      {"tie", tie_misses(positions, bonds.ties)},
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
