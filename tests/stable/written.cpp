#include "written.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace swage::test {
namespace {

/// The same on every machine, as std::shuffle is not.
std::vector<int> order(Eigen::Index count, std::mt19937& random) {
  std::vector<int> places(static_cast<size_t>(count));
  std::iota(places.begin(), places.end(), 0);
  for (size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random() % i]);
  return places;
}

}  // namespace

const std::vector<Writing>& other_writings() {
  static const std::vector<Writing> writings = {
      {"small", 1e-6}, {"large", 1e6}, {"moved", 1, 1e6}, {"shuffled", 1, 0, 1}, {"all", 1e-6, 1e6, 2}};
  return writings;
}

Written::Written(const Mesh& mesh, const Writing& by)
    : by_(by), place_(static_cast<size_t>(mesh.positions.rows())), mesh_(mesh) {
  std::iota(place_.begin(), place_.end(), 0);
  std::vector<int> triangles(static_cast<size_t>(mesh.triangles.rows()));
  std::iota(triangles.begin(), triangles.end(), 0);
  std::mt19937 random(by.seed);
  if (by.seed > 0) {
    place_ = order(mesh.positions.rows(), random);
    triangles = order(mesh.triangles.rows(), random);
  }
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    mesh_.positions.row(place_[static_cast<size_t>(v)]) = into(Eigen::Vector3d(mesh.positions.row(v))).transpose();
  }
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const int turn = by.seed > 0 ? static_cast<int>(random() % 3) : 0;
    for (int k = 0; k < 3; ++k) {
      mesh_.triangles(triangles[static_cast<size_t>(t)], (k + turn) % 3) =
          place_[static_cast<size_t>(mesh.triangles(t, k))];
    }
  }
}

Eigen::Vector3d Written::into(const Eigen::Vector3d& point) const {
  return by_.scale * (point + Eigen::Vector3d::Constant(by_.offset));
}

Gesture Written::into(const Gesture& gesture) const {
  Gesture written;
  for (const auto& [vertex, target] : gesture.targets) written.add(place_[static_cast<size_t>(vertex)], into(target));
  return written;
}

std::vector<int> Written::into(std::vector<int> vertices) const {
  for (int& v : vertices) v = place_[static_cast<size_t>(v)];
  return vertices;
}

Positions Written::back(const Positions& positions) const {
  return (positions(place_, Eigen::all) / by_.scale).array() - by_.offset;
}

}  // namespace swage::test
