#include "half_edges.h"

#include <algorithm>

namespace swage {
namespace {

constexpr int kStepsPerLook = 16;
constexpr std::chrono::milliseconds kAskEvery{20};

}  // namespace

bool Pace::step(double part) {
  if (!goes_on_ || !going_ || steps_++ % kStepsPerLook != 0) return going_;
  const auto now = std::chrono::steady_clock::now();
  if (now - asked_ < kAskEvery) return true;
  asked_ = now;
  return going_ = goes_on_(part);
}

HalfEdges::HalfEdges(const Triangles& triangles, int vertex_count, Pace& pace)
    : triangles_(triangles),
      twins_(Eigen::VectorXi::Constant(triangles.size(), -1)),
      firsts_(Eigen::VectorXi::Constant(vertex_count, -1)),
      starts_(Eigen::VectorXi::Zero(vertex_count + 2)),
      sides_(triangles.size()),
      locked_(Eigen::VectorX<bool>::Constant(vertex_count, false)),
      marks_(Eigen::VectorXi::Zero(vertex_count)) {
  if (!join(pace) || !lock(pace)) return;
  starts_.resize(0);
  sides_.resize(0);
}

bool HalfEdges::join(Pace& pace) {
  const int count = static_cast<int>(twins_.size());
  for (int side = 0; side < count; ++side) ++starts_[from(side) + 2];
  for (Eigen::Index v = 2; v < starts_.size(); ++v) starts_[v] += starts_[v - 1];
  if (!pace.step(0)) return false;
  for (int side = 0; side < count; ++side) sides_[starts_[from(side) + 1]++] = side;
  for (int v = 0; v < firsts_.size(); ++v) {
    if (!pace.step(0)) return false;
    std::sort(sides_.data() + starts_[v], sides_.data() + starts_[v + 1],
              [&](int side, int other) { return to(side) < to(other); });
  }
  for (int side = 0; side < count; ++side) {
    if (!pace.step(0)) return false;
    match(side);
  }
  return true;
}

/// Sides a to b: those from a, ascending by where they end.
std::pair<const int*, const int*> HalfEdges::sides_between(int a, int b) const {
  const int *const first = sides_.data() + starts_[a], *const last = sides_.data() + starts_[a + 1];
  const int* found = std::lower_bound(first, last, b, [&](int side, int end) { return to(side) < end; });
  return {found, std::upper_bound(found, last, b, [&](int end, int side) { return end < to(side); })};
}

void HalfEdges::match(int side) {
  const int a = from(side), b = to(side);
  const auto alike = sides_between(a, b), opposite = sides_between(b, a);
  if (a == b || alike.second - alike.first != 1 || opposite.second - opposite.first != 1) return;
  twins_[side] = *opposite.first;
}

bool HalfEdges::lock(Pace& pace) {
  for (int v = 0; v < firsts_.size(); ++v) {
    if (!pace.step(0)) return false;
    const int valence = starts_[v + 1] - starts_[v];
    int turns = 0;
    if (valence > 0) {
      firsts_[v] = sides_[starts_[v]];
      int side = firsts_[v];
      do {
        side = turned(side);
        ++turns;
      } while (side >= 0 && side != firsts_[v] && turns < valence);
      if (side != firsts_[v]) turns = -1;
    }
    locked_[v] = valence < 3 || turns != valence;
  }
  return true;
}

bool HalfEdges::may_collapse(int side) {
  const int u = from(side), v = to(side);
  if (locked_[u] || locked_[v]) return false;
  ++mark_;
  int valence = 0, other_valence = 0, common = 0;
  int spoke = side;
  do {
    marks_[to(spoke)] = mark_;
    ++valence;
    spoke = turned(spoke);
  } while (spoke != side);
  const int back = twin(side);
  spoke = back;
  do {
    common += marks_[to(spoke)] == mark_;
    ++other_valence;
    spoke = turned(spoke);
  } while (spoke != back);
  const bool is_tetrahedron = valence == 3 && other_valence == 3;
  return common == 2 && !is_tetrahedron;
}

void HalfEdges::collapse(int side) {
  const int v = to(side), back = twin(side);
  int spoke = turned(side);
  firsts_[v] = spoke;
  firsts_[to(spoke)] = twin(next(side));
  firsts_[to(next(back))] = twin(next(back));
  for (; spoke != next(back); spoke = turned(spoke)) triangles_.data()[spoke] = v;
  drop(side);
  drop(back);
}

void HalfEdges::drop(int side) {
  const int across = twin(next(side)), other = twin(previous(side));
  twins_[across] = other;
  twins_[other] = across;
  triangles_.row(side / 3).setConstant(-1);
}

}  // namespace swage
