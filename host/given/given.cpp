#include "given.h"

#include <algorithm>
#include <string>
#include <utility>

#include "matrices.h"
#include "measures.h"
#include "nearest.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kSamePlace = 1e-6;  // Of the box. Files keep six digits.

/// Numbers of what stands in `order`, and of each given where it went.
void put_in_order(const std::vector<int>& order, std::vector<int>& numbers, std::vector<int>& places) {
  const std::vector<int> place = inverse(order);
  std::vector<int> ordered(numbers.size());
  for (size_t i = 0; i < order.size(); ++i) ordered[i] = numbers[static_cast<size_t>(order[i])];
  numbers = std::move(ordered);
  for (int& p : places) p = p < 0 ? p : place[static_cast<size_t>(p)];
}

Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(const Transforms& transforms, int triangle) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(transforms.row(triangle).data());
}

}  // namespace

Given::Given(Mesh mesh, Surface& surface, bool in_order)
    : mesh_(std::move(mesh)),
      vertices_(std::move(surface.vertices)),
      triangles_(std::move(surface.triangles)),
      vertex_of_(std::move(surface.vertex_of)),
      triangle_of_(std::move(surface.triangle_of)) {
  if (in_order) {
    const Numbering numbering = by_neighbourhood(surface.mesh, surface.edges);
    surface.mesh = swage::in_order(surface.mesh, numbering);
    surface.edges = edges_of(surface.mesh.triangles);
    put_in_order(numbering.vertices, vertices_, vertex_of_);
    put_in_order(numbering.triangles, triangles_, triangle_of_);
  }
  list_loose(surface.mesh);
  find_stand_ins(surface.mesh);
}

void Given::list_loose(const Mesh& surface) {
  if (std::find(vertex_of_.begin(), vertex_of_.end(), -1) == vertex_of_.end()) return;
  const TriangleTree tree(surface.positions, surface.triangles);
  const double tolerance = kSamePlace * unit_box(surface.positions).extent;
  for (int v = 0; v < static_cast<int>(vertex_of_.size()); ++v) {
    if (!is_loose(v)) continue;
    const Eigen::RowVector3d point = mesh_.positions.row(v);
    Loose loose{v, {}};
    for (const Foot& foot : tree.all_nearest(point.transpose(), tolerance)) {
      const Eigen::RowVector3i corners = surface.triangles.row(foot.triangle);
      LooseFoot at{foot.triangle, {corners[0], corners[1], corners[2]}, foot.barycentric, point};
      for (int k = 0; k < 3; ++k) at.offset -= foot.barycentric[k] * surface.positions.row(corners[k]);
      loose.feet.push_back(at);
    }
    loose_.push_back(std::move(loose));
  }
}

void Given::find_stand_ins(const Mesh& surface) {
  if (std::find(triangle_of_.begin(), triangle_of_.end(), -1) == triangle_of_.end()) return;
  std::vector<int> at_vertex(vertices_.size(), -1);
  for (int t = 0; t < surface.triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) at_vertex[static_cast<size_t>(surface.triangles(t, k))] = t;
  }
  for (size_t t = 0; t < triangle_of_.size(); ++t) {
    for (int k = 0; k < 3 && triangle_of_[t] < 0; ++k) {
      const int v = vertex_of_[static_cast<size_t>(mesh_.triangles(static_cast<Eigen::Index>(t), k))];
      if (v >= 0) triangle_of_[t] = at_vertex[static_cast<size_t>(v)];
    }
  }
}

std::vector<int> Given::into(const std::vector<int>& chain) const {
  std::vector<int> result;
  result.reserve(chain.size());
  for (const int vertex : chain) result.push_back(vertex_of_[static_cast<size_t>(vertex)]);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Hold> Given::into(const std::vector<Hold>& holds) const {
  std::vector<Hold> result;
  for (Hold hold : holds) {
    if (std::any_of(hold.vertices.begin(), hold.vertices.end(), [&](int v) { return is_loose(v); })) continue;
    for (size_t k = 0; k < 3; ++k) {
      const int v = std::exchange(hold.vertices[k], vertex_of_[static_cast<size_t>(hold.vertices[k])]);
      hold.target -= hold.factors[static_cast<Eigen::Index>(k)] * aside(v);
    }
    result.push_back(hold);
  }
  return result.empty() ? at_feet(holds) : result;
}

std::vector<Hold> Given::at_feet(const std::vector<Hold>& holds) const {
  std::vector<Hold> result;
  for (const Hold& hold : holds) {
    const auto loose =
        std::find_if(loose_.begin(), loose_.end(), [&](const Loose& l) { return l.vertex == hold.vertex(); });
    if (loose == loose_.end()) continue;
    const double share = hold.share / static_cast<double>(loose->feet.size());
    for (const LooseFoot& foot : loose->feet) {
      result.push_back({foot.corners, foot.barycentric, hold.target - foot.offset, share});
    }
  }
  return result;
}

Eigen::RowVector3d Given::aside(int v) const {
  return mesh_.positions.row(v) - mesh_.positions.row(vertex(vertex_of_[static_cast<size_t>(v)]));
}

Positions Given::back(const Positions& positions, const Transforms& transforms) const {
  Positions given(mesh_.positions.rows(), 3);
  for (int v = 0; v < given.rows(); ++v) {
    if (is_loose(v)) continue;
    given.row(v) = positions.row(vertex_of_[static_cast<size_t>(v)]) + aside(v);
  }
  for (const Loose& loose : loose_) {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (const LooseFoot& foot : loose.feet) {
      sum += (matrix(transforms, foot.triangle) * foot.offset.transpose()).transpose();
      for (int k = 0; k < 3; ++k) sum += foot.barycentric[k] * positions.row(foot.corners[static_cast<size_t>(k)]);
    }
    given.row(loose.vertex) = sum / static_cast<double>(loose.feet.size());
  }
  return given;
}

Positions Given::back_vertices(const Positions& rows) const {
  Positions given = Positions::Zero(mesh_.positions.rows(), 3);
  for (int v = 0; v < given.rows(); ++v) {
    if (!is_loose(v)) given.row(v) = rows.row(vertex_of_[static_cast<size_t>(v)]);
  }
  return given;
}

Tetrahedra Given::back(const Tetrahedra& tetrahedra) const {
  const auto surface = static_cast<int>(vertices_.size()), first_own = static_cast<int>(mesh_.positions.rows());
  return tetrahedra.unaryExpr([&](int v) { return v < surface ? vertex(v) : first_own + v - surface; });
}

Transforms Given::back(const Transforms& transforms) const {
  Transforms given = identities(mesh_.triangles.rows());
  for (size_t t = 0; t < triangle_of_.size(); ++t) {
    if (triangle_of_[t] >= 0) given.row(static_cast<Eigen::Index>(t)) = transforms.row(triangle_of_[t]);
  }
  return given;
}

void Given::place_loose(const Gesture& gesture, Positions& positions) const {
  for (const auto& [vertex, target] : gesture.targets) {
    if (is_loose(vertex)) positions.row(vertex) = target.transpose();
  }
}

Surface surface_given(const Mesh& mesh, const char* caller) {
  Surface surface = surface_of(mesh, kSamePlace * unit_box(mesh.positions).extent);
  const Positions areas = area_vectors(surface.mesh.positions, surface.mesh.triangles);
  if (areas.rows() > 0 && areas.squaredNorm() > 0) return surface;
  throw InvalidInput(std::string(caller) + ": triangles: none of " + std::to_string(surface.triangle_of.size()) +
                     " has any area: there is no surface; check the mesh's units and coordinates");
}

}  // namespace swage
