// What a half-edge collapse would cost, and whether it would harm the surface.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "half_edges.h"

namespace swage {

struct Choice {
  double cost = std::numeric_limits<double>::infinity();
  int side = -1;  ///< -1 for none.
};

class Collapses {
 public:
  /// Borrows both. `prepare` comes before anything else.
  Collapses(const Positions& positions, HalfEdges& surface) : positions_(positions), surface_(surface) {}
  /// False where stopped.
  bool prepare(Pace& pace);

  /// Of the sides from the vertex.
  Choice cheapest(int vertex);
  /// A side that was `cheapest`.
  void collapse(int side);
  /// The one of `others` whose normal is closest to the last that `triangle` had.
  int likest(int triangle, const std::array<int, 2>& others) const;

 private:
  bool scale(Pace& pace);
  bool measure(Pace& pace);
  bool refer(Pace& pace);
  bool spread(int vertex);
  Eigen::Vector3d area_vector(int triangle) const;
  Eigen::Vector3d point(int vertex) const { return points_.row(vertex); }
  double flatness(int vertex, const Eigen::Vector3d& at) const;
  double harm(size_t target);
  bool folds(size_t target) const;
  Eigen::Vector3d normal_across(int side) const;
  double sharpest() const;
  double slimmest() const;

  const Positions& positions_;
  HalfEdges& surface_;
  Positions points_;  ///< In a box of unit size about the origin, where quadrics lose least.
  Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor> quadrics_;
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> normals_;     ///< As the triangles are now.
  Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor> references_;  ///< As they were in the original.
  std::vector<int> spokes_;              ///< The sides from the vertex looked at, counter-clockwise.
  std::vector<Eigen::Vector3d> turned_;  ///< Unit normals that the triangles between them would get.
  std::vector<std::pair<double, size_t>> candidates_;
};

}  // namespace swage
