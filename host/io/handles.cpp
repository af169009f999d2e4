#include "swage/handles.h"

#include <algorithm>
#include <string>

#include "adjacency.h"
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

std::string describe_loose(const std::vector<int>& component, const Triangles& triangles, int loose, size_t others) {
  const auto vertex = std::find(component.begin(), component.end(), loose) - component.begin();
  int triangle_count = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    triangle_count += component[static_cast<size_t>(triangles(t, 0))] == loose ? 1 : 0;
  }
  const std::string number = std::to_string(loose), example = std::to_string(vertex);
  std::string text = triangle_count == 0 ? "isolated vertex " + example + " (component " + number + ", no triangle)"
                                         : "component " + number + " (" + std::to_string(triangle_count) +
                                               " triangles, vertex " + example + " among its vertices)";
  text += " has no handle, so it could be anywhere";
  if (others > 0) text += "; nor have " + std::to_string(others) + " other components";
  return text + "; pin or move it, as by --pin component:" + number;
}

void check_components(const Gesture& gesture, const Triangles& triangles, int vertex_count) {
  const std::vector<int> component = components(triangles, vertex_count);
  const int count = 1 + *std::max_element(component.begin(), component.end());
  std::vector<bool> is_held(static_cast<size_t>(count), false);
  for (const auto& [vertex, target] : gesture.targets) {
    is_held[static_cast<size_t>(component[static_cast<size_t>(vertex)])] = true;
  }
  const auto loose = std::find(is_held.begin(), is_held.end(), false);
  if (loose == is_held.end()) return;
  const auto others = static_cast<size_t>(std::count(loose + 1, is_held.end(), false));
  throw InvalidInput("check: gesture: " +
                     describe_loose(component, triangles, static_cast<int>(loose - is_held.begin()), others));
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
  check_handles(gesture, positions.rows());
  check_components(gesture, triangles, static_cast<int>(positions.rows()));
}

}  // namespace swage
