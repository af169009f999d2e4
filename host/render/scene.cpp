#include "scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "heat.h"
#include "sets.h"
#include "surface.h"

namespace swage {
namespace {

constexpr double kOnePlace = 1e-7;  // In unit boxes: as much as single precision tells apart.
constexpr double kSpeck = 0.025;    // Likewise: lines shorter than that are clutter.

int corner_at(const Triangles& triangles, int triangle, int vertex) {
  int k = 0;
  while (triangles(triangle, k) != vertex) ++k;
  return 3 * triangle + k;
}

double angle_at(const Mesh& mesh, int triangle, int corner) {
  const auto at = [&](int k) -> Eigen::RowVector3d { return mesh.positions.row(mesh.triangles(triangle, k % 3)); };
  const Eigen::RowVector3d to = at(corner + 1) - at(corner), other = at(corner + 2) - at(corner);
  return std::atan2(to.cross(other).norm(), to.dot(other));
}

bool winds_alike(const Triangles& triangles, const Lists::Range& beside, const Eigen::RowVector2i& edge) {
  return runs_along(triangles, beside[0], edge) != runs_along(triangles, beside[1], edge);
}

struct EdgeKinds {
  std::vector<int> smooth;  ///< Of two triangles that wind alike.
  std::vector<int> lines;
};

EdgeKinds kinds_of(const Surface& surface, const Positions& normals, double feature_angle) {
  EdgeKinds kinds;
  for (int e = 0; e < surface.edges.triangles.size(); ++e) {
    const Lists::Range beside = surface.edges.triangles[e];
    if (beside.size() != 2) {
      kinds.lines.push_back(e);
      continue;
    }
    const bool alike = winds_alike(surface.mesh.triangles, beside, surface.edges.vertices.row(e));
    const double angle = dihedral_angle(normals.row(beside[0]), (alike ? 1 : -1) * normals.row(beside[1]));
    if (angle < feature_angle) {
      kinds.lines.push_back(e);
    } else if (alike) {
      kinds.smooth.push_back(e);
    }
  }
  return kinds;
}

/// Means by angle, which do not depend on how a corner is cut into triangles.
std::vector<Eigen::Vector3f> corner_normals(const Surface& surface, const Positions& normals,
                                            const std::vector<int>& smooth) {
  const Mesh& mesh = surface.mesh;
  Sets sets(static_cast<int>(3 * mesh.triangles.rows()));
  for (const int e : smooth) {
    const Lists::Range beside = surface.edges.triangles[e];
    for (int k = 0; k < 2; ++k) {
      const int vertex = surface.edges.vertices(e, k);
      sets.join(corner_at(mesh.triangles, beside[0], vertex), corner_at(mesh.triangles, beside[1], vertex));
    }
  }
  Positions sums = Positions::Zero(3 * mesh.triangles.rows(), 3);
  for (int c = 0; c < sums.rows(); ++c) sums.row(sets.of(c)) += angle_at(mesh, c / 3, c % 3) * normals.row(c / 3);
  std::vector<Eigen::Vector3f> means;
  means.reserve(static_cast<size_t>(sums.rows()));
  for (int c = 0; c < sums.rows(); ++c) {
    const Eigen::RowVector3d mean = sums.row(sets.of(c)).stableNormalized();
    means.push_back(mean.transpose().cast<float>());
  }
  return means;
}

/// Without those that join to no more than a speck.
std::vector<std::array<int, 2>> long_lines(const Surface& surface, const std::vector<int>& edges) {
  const Positions& positions = surface.mesh.positions;
  std::vector<std::array<int, 2>> lines;
  Sets sets(static_cast<int>(positions.rows()));
  for (const int e : edges) {
    lines.push_back({surface.edges.vertices(e, 0), surface.edges.vertices(e, 1)});
    sets.join(lines.back()[0], lines.back()[1]);
  }
  std::vector<double> lengths(static_cast<size_t>(positions.rows()), 0);
  const auto length_of = [&](int vertex) -> double& { return lengths[static_cast<size_t>(sets.of(vertex))]; };
  for (const auto& [a, b] : lines) length_of(a) += (positions.row(b) - positions.row(a)).norm();
  std::erase_if(lines, [&](const auto& line) { return length_of(line[0]) < kSpeck; });
  return lines;
}

std::vector<Colour> colours_of(const Panel& panel, const Surface& surface, const HeatMap& heat) {
  std::vector<Colour> colours(surface.triangles.size(), palette::kSurface);
  if (panel.face_values.size() == 0) return colours;
  std::transform(surface.triangles.begin(), surface.triangles.end(), colours.begin(),
                 [&](int t) { return heat_colour(heat, panel.face_values[t]); });
  return colours;
}

}  // namespace

RenderScene scene_of(const Panel& panel, const UnitBox& box, double feature_angle, const HeatMap& heat) {
  Surface surface = surface_of({box.into(panel.mesh.positions), panel.mesh.triangles}, kOnePlace);
  RenderScene scene;
  if (surface.triangles.empty()) return scene;
  const Positions normals = unit_normals(surface.mesh.positions, surface.mesh.triangles);
  const EdgeKinds kinds = kinds_of(surface, normals, feature_angle);
  scene.rays = std::make_unique<RayScene>(surface.mesh.positions, surface.mesh.triangles);
  for (const auto& normal : normals.rowwise()) scene.normals.push_back(normal.transpose().cast<float>());
  scene.corner_normals = corner_normals(surface, normals, kinds.smooth);
  scene.is_heat_map = panel.face_values.size() > 0;
  scene.colours = colours_of(panel, surface, heat);
  scene.lines = long_lines(surface, kinds.lines);
  scene.mesh = std::move(surface.mesh);
  return scene;
}

}  // namespace swage
