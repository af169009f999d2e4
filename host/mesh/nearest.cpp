#include "nearest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

namespace swage {
namespace {

using Eigen::Vector3d;

constexpr int kLeaf = 4;

BoxTree::Box box_of(const Positions& positions, const Eigen::RowVector3i& triangle) {
  const Vector3d a = positions.row(triangle[0]), b = positions.row(triangle[1]), c = positions.row(triangle[2]);
  return {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
}

Foot foot_at(const Vector3d& p, const std::array<Vector3d, 3>& corners, const Vector3d& barycentric) {
  const Vector3d at = barycentric[0] * corners[0] + barycentric[1] * corners[1] + barycentric[2] * corners[2];
  return {-1, barycentric, (p - at).norm()};
}

Foot nearest_on_side(const Vector3d& p, const std::array<Vector3d, 3>& corners, int from, int to) {
  const Vector3d& a = corners[static_cast<size_t>(from)];
  const Vector3d side = corners[static_cast<size_t>(to)] - a;
  const double length = side.squaredNorm();
  const double s = length > 0 ? std::clamp((p - a).dot(side) / length, 0.0, 1.0) : 0;
  Vector3d barycentric = Vector3d::Zero();
  barycentric[from] = 1 - s;
  barycentric[to] = s;
  return foot_at(p, corners, barycentric);
}

}  // namespace

Foot nearest_on_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const std::array<Vector3d, 3> corners{a, b, c};
  const Vector3d normal = (b - a).cross(c - a);
  const double area = normal.squaredNorm();
  if (area > 0) {
    Vector3d barycentric;
    for (int k = 0; k < 3; ++k) {
      const Vector3d& from = corners[static_cast<size_t>((k + 1) % 3)];
      barycentric[k] = (corners[static_cast<size_t>((k + 2) % 3)] - from).cross(p - from).dot(normal) / area;
    }
    if ((barycentric.array() >= 0).all()) return foot_at(p, corners, barycentric / barycentric.sum());
  }
  Foot best{-1, {}, std::numeric_limits<double>::infinity()};
  for (int k = 0; k < 3; ++k) {
    const Foot foot = nearest_on_side(p, corners, k, (k + 1) % 3);
    if (foot.distance < best.distance) best = foot;
  }
  return best;
}

BoxTree::BoxTree(const Positions& positions, const Triangles& triangles)
    : positions_(positions), triangles_(triangles), order_(static_cast<size_t>(triangles.rows())) {
  std::iota(order_.begin(), order_.end(), 0);
  boxes_.reserve(order_.size());
  for (const auto& triangle : triangles.rowwise()) boxes_.push_back(box_of(positions, triangle));
  nodes_.push_back({{}, 0, static_cast<int>(order_.size()), -1});
  for (int node = 0; node < static_cast<int>(nodes_.size()); ++node) build(node);
}

/// Halves at the median of the centres along the box's longest side.
void BoxTree::build(int node) {
  const int first = nodes_[static_cast<size_t>(node)].first, end = nodes_[static_cast<size_t>(node)].end;
  Box box = boxes_[static_cast<size_t>(order_[static_cast<size_t>(first)])];
  for (int i = first + 1; i < end; ++i) {
    const Box& own = boxes_[static_cast<size_t>(order_[static_cast<size_t>(i)])];
    box = {box.low.cwiseMin(own.low), box.high.cwiseMax(own.high)};
  }
  nodes_[static_cast<size_t>(node)].box = box;
  if (end - first <= kLeaf) return;
  Eigen::Index axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const int middle = (first + end) / 2;
  const auto centre = [&](int t) {
    return std::pair(boxes_[static_cast<size_t>(t)].low[axis] + boxes_[static_cast<size_t>(t)].high[axis], t);
  };
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end,
                   [&](int a, int b) { return centre(a) < centre(b); });
  nodes_[static_cast<size_t>(node)].below = static_cast<int>(nodes_.size());
  nodes_.push_back({{}, first, middle, -1});
  nodes_.push_back({{}, middle, end, -1});
}

Foot BoxTree::nearest(const Vector3d& point, double most, const std::function<bool(int)>& counts) const {
  Foot best{-1, Vector3d::Zero(), most};
  std::vector<std::pair<double, int>> open{{nodes_[0].box.distance(point), 0}};
  while (!open.empty()) {
    const auto [distance, at] = open.back();
    open.pop_back();
    if (distance > best.distance) continue;
    const Node& node = nodes_[static_cast<size_t>(at)];
    if (node.below >= 0) {
      std::array<std::pair<double, int>, 2> below;
      for (int k = 0; k < 2; ++k) {
        below[static_cast<size_t>(k)] = {nodes_[static_cast<size_t>(node.below + k)].box.distance(point),
                                         node.below + k};
      }
      if (below[0].first < below[1].first) std::swap(below[0], below[1]);  // The nearer is looked at first.
      open.insert(open.end(), below.begin(), below.end());
      continue;
    }
    for (int i = node.first; i < node.end; ++i) {
      const int t = order_[static_cast<size_t>(i)];
      if (!counts(t)) continue;
      Foot foot = nearest_on_triangle(point, positions_.row(triangles_(t, 0)), positions_.row(triangles_(t, 1)),
                                      positions_.row(triangles_(t, 2)));
      foot.triangle = t;
      if (std::pair(foot.distance, t) <
          std::pair(best.distance, best.triangle < 0 ? std::numeric_limits<int>::max() : best.triangle))
        best = foot;
    }
  }
  return best;
}

Foot BoxTree::nearest(const Vector3d& point) const {
  return nearest(point, std::numeric_limits<double>::infinity(), [](int) { return true; });
}

void BoxTree::visit(const Box& box, const std::function<void(int)>& visit) const {
  std::vector<int> open{0};
  while (!open.empty()) {
    const Node& node = nodes_[static_cast<size_t>(open.back())];
    open.pop_back();
    if (!node.box.meets(box)) continue;
    if (node.below >= 0) {
      open.insert(open.end(), {node.below, node.below + 1});
      continue;
    }
    for (int i = node.first; i < node.end; ++i) {
      const int t = order_[static_cast<size_t>(i)];
      if (boxes_[static_cast<size_t>(t)].meets(box)) visit(t);
    }
  }
}

}  // namespace swage
