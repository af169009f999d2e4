// A triangle surface that shrinks by half-edge collapses, in arrays that never grow.
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <functional>
#include <utility>

#include "swage/mesh.h"

namespace swage {

/// Asks whether to go on, of many small steps only every few hundredths of a second. The answer no stays.
class Pace {
 public:
  explicit Pace(const std::function<bool(double)>& goes_on) : goes_on_(goes_on) {}
  /// `part` done, in [0, 1].
  bool step(double part);

 private:
  const std::function<bool(double)>& goes_on_;
  std::chrono::steady_clock::time_point asked_;
  int steps_ = 0;
  bool going_ = true;
};

/// Side 3 t + k of triangle t runs from its corner k to corner k + 1.
class HalfEdges {
 public:
  /// Unfit for use where `pace` said no.
  HalfEdges(const Triangles& triangles, int vertex_count, Pace& pace);

  static int next(int side) { return side % 3 == 2 ? side - 2 : side + 1; }
  static int previous(int side) { return side % 3 == 0 ? side + 2 : side - 1; }
  int from(int side) const { return triangles_.data()[side]; }
  int to(int side) const { return from(next(side)); }
  /// The same edge from the other triangle.
  int twin(int side) const { return twins_[side]; }
  /// The next side from the same vertex, counter-clockwise.
  int turned(int side) const { return twins_[previous(side)]; }
  /// A side from the vertex.
  int first(int vertex) const { return firsts_[vertex]; }
  /// Whether the triangles at the vertex do not make one closed fan: such a vertex takes no part in collapses.
  bool is_locked(int vertex) const { return locked_[vertex]; }
  bool is_gone(int triangle) const { return triangles_(triangle, 0) < 0; }
  const Triangles& triangles() const { return triangles_; }

  /// Whether from(side) may be moved into to(side), and the surface stays what it is, topologically.
  bool may_collapse(int side);
  void collapse(int side);

 private:
  bool join(Pace& pace);
  bool lock(Pace& pace);
  std::pair<const int*, const int*> sides_between(int a, int b) const;
  void match(int side);
  void drop(int side);

  Triangles triangles_;
  Eigen::VectorXi twins_;           ///< -1 where not exactly one triangle lies across.
  Eigen::VectorXi firsts_;          ///< -1 for a vertex of no triangle.
  Eigen::VectorXi starts_, sides_;  ///< Sides by the vertex they start from; empty once built.
  Eigen::VectorX<bool> locked_;
  Eigen::VectorXi marks_;
  int mark_ = 0;
};

}  // namespace swage
