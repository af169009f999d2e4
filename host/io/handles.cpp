#include "swage/handles.h"

#include <string>

#include "scanner.h"
#include "swage/error.h"

namespace swage {
namespace {

void check_handles(const Gesture& gesture, Eigen::Index vertex_count) {
  for (const auto& [vertex, target] : gesture.targets) {
    const std::string handle = "check: gesture: handle " + std::to_string(vertex);
    if (vertex < 0 || vertex >= vertex_count) {
      throw InvalidInput(handle + " is not a vertex; they run from 0 to " + std::to_string(vertex_count - 1));
    }
    if (!(target.array().abs() <= kLargestCoordinate).all()) {
      throw InvalidInput(handle + " has a target that is not a number, infinite or beyond 1e12; mend it");
    }
  }
}

}  // namespace

void Gesture::add(int vertex, const Eigen::Vector3d& target) {
  const auto [found, is_new] = targets.emplace(vertex, target);
  if (is_new || found->second == target) return;
  throw InvalidInput("Gesture::add: vertex " + std::to_string(vertex) +
                     " has two different targets; let only one handle hold it");
}

void check(const Gesture& gesture, const PositionsRef& positions, const TrianglesRef& triangles) {
  check(positions, triangles);
  if (gesture.targets.empty()) throw InvalidInput("check: gesture: no handles; pin or move some vertices");
  check_handles(gesture, positions.rows());
}

}  // namespace swage
