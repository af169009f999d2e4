#include "swage/diagnose.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "defects.h"
#include "intersections.h"
#include "measures.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kNeedle = 10 * std::numbers::pi / 180;
constexpr double kLow = 0.05;

void measure_edges(Diagnosis& diagnosis, const Positions& positions, const Edges& edges) {
  const Eigen::VectorXd lengths = edge_vectors(positions, edges).rowwise().norm();
  if (lengths.size() == 0) return;
  diagnosis.mean_edge = lengths.mean();
  diagnosis.shortest_edge = lengths.minCoeff();
  diagnosis.longest_edge = lengths.maxCoeff();
  diagnosis.longest_to_mean_edge = diagnosis.mean_edge > 0 ? diagnosis.longest_edge / diagnosis.mean_edge : 0;
}

/// Of ascending values, between the two nearest ones where it falls between.
double quantile(const std::vector<double>& ascending, double part) {
  const double at = part * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<size_t>(at);
  const size_t above = std::min(below + 1, ascending.size() - 1);
  return std::lerp(ascending[below], ascending[above], at - static_cast<double>(below));
}

/// The smallest angle of each triangle with area, ascending.
std::vector<double> smallest_angles(Diagnosis& diagnosis, const Mesh& mesh) {
  std::vector<double> angles;
  for (int t = 0; t < diagnosis.triangles; ++t) {
    if (has_area(mesh.positions, mesh.triangles.row(t))) {
      angles.push_back(corner_angles(mesh.positions(mesh.triangles.row(t), Eigen::all)).minCoeff());
    } else if (diagnosis.degenerate_triangles.count++ == 0) {
      diagnosis.degenerate_triangles.first = t;
    }
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

void measure_triangles(Diagnosis& diagnosis, const Mesh& mesh) {
  const std::vector<double> angles = smallest_angles(diagnosis, mesh);
  const auto needles = std::lower_bound(angles.begin(), angles.end(), kNeedle) - angles.begin();
  diagnosis.needle_fraction = static_cast<double>(needles + diagnosis.degenerate_triangles.count) / diagnosis.triangles;
  if (angles.empty()) return;
  diagnosis.smallest_angle = angles.front();
  diagnosis.low_angle = quantile(angles, kLow);
}

bool is_closed(const Diagnosis& diagnosis) {
  return diagnosis.boundary_edges.count == 0 && diagnosis.non_manifold_edges.count == 0 &&
         diagnosis.inconsistent_edges.count == 0;
}

double volume_of(const Mesh& mesh, const Eigen::Vector3d& middle) {
  const Positions centred = mesh.positions.rowwise() - middle.transpose();
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    sum += centred.row(t[0]).dot(centred.row(t[1]).cross(centred.row(t[2])));
  }
  return sum / 6;
}

void find_self_intersections(Diagnosis& diagnosis, const Mesh& mesh, int limit, const ProgressFn& progress) {
  if (limit == 0) return;
  const auto goes_on = [&](double part) {
    Progress now;
    now.stage = "self-intersections";
    now.fraction = part;
    return !progress || progress(now);
  };
  const Crossings found = self_intersections(mesh.positions, mesh.triangles, static_cast<std::size_t>(limit), goes_on);
  diagnosis.self_intersections.count = static_cast<int>(found.pairs.size());
  if (!found.pairs.empty()) diagnosis.self_intersections.first = found.pairs.front();
  diagnosis.self_intersections_complete = found.complete;
}

}  // namespace

Diagnosis diagnose(const PositionsRef& positions, const TrianglesRef& triangles, const ProgressFn& progress,
                   int crossing_limit) {
  check(positions, triangles);
  if (crossing_limit < 0) {
    throw InvalidInput("diagnose: crossing_limit: " + std::to_string(crossing_limit) + " is below 0");
  }
  const Mesh mesh{positions, triangles};
  Diagnosis diagnosis;
  diagnosis.vertices = static_cast<int>(mesh.positions.rows());
  diagnosis.triangles = static_cast<int>(mesh.triangles.rows());
  diagnosis.low = mesh.positions.colwise().minCoeff();
  diagnosis.high = mesh.positions.colwise().maxCoeff();
  measure_triangles(diagnosis, mesh);

  // A triangle with a vertex twice is no surface: it must not make an edge look like one of three triangles.
  const Triangles proper = without_repeats(mesh.triangles);
  const Edges edges = edges_of(proper);
  count_defects(diagnosis, proper, edges);
  count_repeats(diagnosis, mesh.positions, mesh.triangles, proper);
  measure_edges(diagnosis, mesh.positions, edges);
  if (is_closed(diagnosis)) diagnosis.volume = volume_of(mesh, (diagnosis.low + diagnosis.high) / 2);
  find_self_intersections(diagnosis, mesh, crossing_limit, progress);
  return diagnosis;
}

}  // namespace swage
