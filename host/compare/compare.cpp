#include "swage/compare.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "changes.h"
#include "measures.h"
#include "messages.h"
#include "parts.h"
#include "swage/diagnose.h"
#include "swage/error.h"

namespace swage {
namespace {

void check_options(const CompareOptions& options, Eigen::Index vertex_count) {
  if (!(options.crease_angle >= 0 && options.crease_angle <= std::numbers::pi)) {
    throw InvalidInput("compare: options.crease_angle: " + digits(options.crease_angle) +
                       " is not an angle between 0 and pi radians");
  }
  if (options.crossing_limit < 0) {
    throw InvalidInput("compare: options.crossing_limit: " + std::to_string(options.crossing_limit) + " is below 0");
  }
  for (size_t c = 0; c < options.straight_chains.size(); ++c) {
    for (int v : options.straight_chains[c]) {
      if (v >= 0 && v < vertex_count) continue;
      throw InvalidInput("compare: options.straight_chains: chain " + std::to_string(c) + ": vertex " +
                         std::to_string(v) + " is not one of the mesh's " + std::to_string(vertex_count) +
                         "; is it a chain of another mesh?");
    }
  }
}

void check_meshes(const PositionsRef& rest, const PositionsRef& edit, const TrianglesRef& triangles) {
  check(rest, triangles);
  if (edit.rows() != rest.rows()) {
    throw InvalidInput("compare: edit: " + std::to_string(edit.rows()) + " vertices, but the rest has " +
                       std::to_string(rest.rows()) + ": an edit keeps their number and order");
  }
  check(edit, triangles);
  if (box_diagonal(rest) == 0)
    throw InvalidInput("compare: rest: all vertices are at one place; there is nothing to compare");
}

/// The farthest that an inner vertex strays from the line between its chain's ends.
double bend(const Positions& positions, const std::vector<std::vector<int>>& chains) {
  double farthest = 0;
  for (const std::vector<int>& chain : chains) {
    if (chain.size() < 3) continue;
    const Eigen::RowVector3d from = positions.row(chain.front()), chord = positions.row(chain.back()) - from;
    const double length = chord.squaredNorm();
    for (int v : chain) {
      const Eigen::RowVector3d off = positions.row(v) - from;
      const double along = length > 0 ? off.dot(chord) / length : 0;
      farthest = std::max(farthest, (off - along * chord).norm());
    }
  }
  return farthest;
}

Eigen::VectorXd areas(const Positions& positions, const Triangles& triangles) {
  return area_vectors(positions, triangles).rowwise().norm() / 2;
}

struct Comparing {
  Positions rest, edit;
  Triangles triangles;
  double diagonal;
  Eigen::VectorXd areas;  ///< At rest.
};

std::optional<double> out_of_round(const std::vector<RoundPart>& parts) {
  if (parts.empty()) return std::nullopt;
  double sum = 0, whole = 0;
  for (const RoundPart& part : parts) {
    sum += part.area * std::max(0.0, part.after - part.before);
    whole += part.area;
  }
  return sum / whole;
}

/// Of the area.
double measured(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
  const double known = values.array().isNaN().select(0, weights.array()).sum();
  return weights.sum() > 0 ? known / weights.sum() : 0;
}

/// Whether it has area at rest, and lost it.
bool collapses(const Comparing& what, Eigen::Index t) {
  return has_area(what.rest, what.triangles.row(t)) && !has_area(what.edit, what.triangles.row(t));
}

void measure_triangles(const Comparing& what, Comparison& result) {
  FaceChanges& faces = result.faces = face_changes(what.rest, what.edit, what.triangles);
  result.turn = spread(faces.turn, what.areas);
  result.uneven = spread(faces.uneven, what.areas);
  result.shear = spread(faces.shear, what.areas);
  result.size = spread(faces.size.cwiseAbs(), what.areas);
  result.area_before = what.areas.sum();
  result.area_after = areas(what.edit, what.triangles).sum();
  result.flipped = flipped(faces.turn);
  for (Eigen::Index t = 0; t < what.triangles.rows(); ++t) result.collapsed += collapses(what, t) ? 1 : 0;
}

void measure_what_was_asked(const Comparing& what, const CompareOptions& options, Comparison& result) {
  if (options.gesture) result.handle_error = largest_miss(*options.gesture, what.edit) / what.diagonal;
  if (options.straight_chains.empty()) return;
  result.bend_before = bend(what.rest, options.straight_chains) / what.diagonal;
  result.bend_after = bend(what.edit, options.straight_chains) / what.diagonal;
}

void measure_crossings(const Comparing& what, int limit, Comparison& result) {
  const auto change = crossing_change(what.rest, what.edit, what.triangles, static_cast<std::size_t>(limit));
  if (!change) return;
  result.crossings_before = change->before;
  result.new_crossings = change->fresh;
}

}  // namespace

Comparison compare(const PositionsRef& rest, const PositionsRef& edit, const TrianglesRef& triangles,
                   const CompareOptions& options, const ProgressFn& progress) {
  check_meshes(rest, edit, triangles);
  check_options(options, rest.rows());
  if (options.gesture) check(*options.gesture, rest, triangles);
  const Comparing what{rest, edit, triangles, box_diagonal(rest), areas(rest, triangles)};
  const auto go_on = [&](const char* stage, double fraction) {
    return !progress || progress(Progress{stage, 0, 0, fraction, 0});
  };
  Comparison result;
  result.complete = false;
  measure_triangles(what, result);
  measure_what_was_asked(what, options, result);
  if (!go_on("slippage", 0.1)) return result;
  result.faces.slippage_loss = slippage_losses(what.rest, what.edit, what.triangles, options.crease_angle);
  result.slippage_loss = spread(result.faces.slippage_loss, what.areas);
  result.slippage_measured = measured(result.faces.slippage_loss, what.areas);
  if (!go_on("roundness", 0.6)) return result;
  result.round_parts = round_parts(what.rest, what.edit, what.triangles, options.crease_angle);
  result.out_of_round = out_of_round(result.round_parts);
  if (!go_on("volume", 0.7)) return result;
  result.volume_before = diagnose(what.rest, what.triangles, {}, 0).volume;
  result.volume_after = diagnose(what.edit, what.triangles, {}, 0).volume;
  if (!go_on("crossings", 0.8)) return result;
  measure_crossings(what, options.crossing_limit, result);
  result.complete = true;
  return result;
}

}  // namespace swage
