#include <algorithm>
#include <string>

#include "foot_search.h"
#include "measures.h"
#include "messages.h"
#include "swage/error.h"
#include "swage/thrown.h"
#include "swage/transfer.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::RowVector3d;

constexpr Index kBlock = 1 << 14;  // Points between two calls of progress: about a tenth of a second.

void check_points(const PositionsRef& points) {
  if (points.rows() == 0) throw InvalidInput("attach: points: there are none; give one at least");
  for (Index i = 0; i < points.rows(); ++i) {
    if (!(points.row(i).array().abs() <= 1e12).all()) {
      throw InvalidInput("attach: points: row " + std::to_string(i) +
                         " has a coordinate that is not a number, infinite or beyond 1e12; mend it");
    }
  }
}

void check_options(const TransferOptions& options, Index point_count) {
  if (options.directions < 0 || options.directions > 10'000) {
    throw InvalidInput("attach: options.directions: " + std::to_string(options.directions) + " is not in [0, 10000]");
  }
  if (!(options.detour >= 1)) {
    throw InvalidInput("attach: options.detour: " + digits(options.detour) + " is not at least 1");
  }
  if (!options.normals) return;
  if (options.normals->rows() != point_count) {
    throw InvalidInput("attach: options.normals: " + std::to_string(options.normals->rows()) + " rows, but there are " +
                       std::to_string(point_count) + " points; give one for each");
  }
  for (Index i = 0; i < point_count; ++i) {
    if (!options.normals->row(i).allFinite()) {
      throw InvalidInput("attach: options.normals: row " + std::to_string(i) + " is not finite; mend it");
    }
  }
}

/// Of the vertices that triangles name: others do not count.
UnitBox box_of(const PositionsRef& positions, const TrianglesRef& triangles) {
  RowVector3d low = positions.row(triangles(0, 0)), high = low;
  for (Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      low = low.cwiseMin(positions.row(triangles(t, k)));
      high = high.cwiseMax(positions.row(triangles(t, k)));
    }
  }
  const double extent = (high - low).maxCoeff();
  return {low, extent > 1e-100 ? extent : 1};  // A surface at one point: any unit will do.
}

/// Calls `attach_one` for each point. False where progress cancelled.
template <typename AttachOne>
bool attach_all(Index count, const ProgressFn& progress, const AttachOne& attach_one) {
  for (Index first = 0; first < count; first += kBlock) {
    const Index last = std::min(count, first + kBlock);
    Thrown thrown;
#pragma omp parallel for schedule(dynamic, 64)
    for (Index i = first; i < last; ++i) thrown.keep([&] { attach_one(i); });
    thrown.rethrow();
    const double part = static_cast<double>(last) / static_cast<double>(count);
    if (progress && !progress({.stage = "attach", .fraction = part})) return false;
  }
  return true;
}

}  // namespace

Attachments attach(const PositionsRef& points, const PositionsRef& surface_positions,
                   const TrianglesRef& surface_triangles, const TransferOptions& options, const ProgressFn& progress) {
  check(surface_positions, surface_triangles);
  check_points(points);
  check_options(options, points.rows());
  if (progress && !progress({.stage = "attach"})) return {};
  const UnitBox box = box_of(surface_positions, surface_triangles);
  const FootSearch foot_of({box.into(surface_positions), surface_triangles}, options.directions);

  Attachments result{Eigen::VectorXi(points.rows()), Positions(points.rows(), 3), Positions(points.rows(), 3)};
  const auto attach_one = [&](Index i) {
    RowVector3d normal = RowVector3d::Zero();
    if (options.normals) normal = options.normals->row(i);
    const Foot foot = foot_of((points.row(i) - box.corner) / box.extent, normal, options.detour);
    result.triangles[i] = foot.triangle;
    result.barycentric.row(i) = foot.barycentric;
    result.offsets.row(i) =
        points.row(i) - point_at(surface_positions, surface_triangles.row(foot.triangle), foot.barycentric);
  };
  return attach_all(points.rows(), progress, attach_one) ? result : Attachments();
}

}  // namespace swage
