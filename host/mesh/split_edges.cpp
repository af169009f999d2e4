#include "split_edges.h"

#include <vector>

#include "adjacency.h"

namespace swage {
namespace {

using Eigen::Index;

using Corners = Eigen::RowVector3i;

/// A triangle whose edges have middles; -1: none.
void split(const Positions& positions, const Corners& corners, const Corners& middles, std::vector<Corners>& into) {
  const auto turned = [](const Corners& of, int by) { return Corners(of[by % 3], of[(by + 1) % 3], of[(by + 2) % 3]); };
  const auto count = (middles.array() >= 0).count();
  // So that the first edge is the only one with a middle, or without.
  int first = 0;
  while (count > 0 && count < 3 && (middles[first] >= 0) != (count == 1)) ++first;
  const Corners c = turned(corners, first), m = turned(middles, first);
  const auto length = [&](int a, int b) { return (positions.row(a) - positions.row(b)).squaredNorm(); };
  if (count == 0) {
    into.push_back(corners);
  } else if (count == 1) {
    into.insert(into.end(), {{c[0], m[0], c[2]}, {m[0], c[1], c[2]}});
  } else if (count == 3) {
    into.insert(into.end(), {{c[0], m[0], m[2]}, {m[0], c[1], m[1]}, {m[2], m[1], c[2]}, {m[0], m[1], m[2]}});
  } else {
    into.emplace_back(m[2], m[1], c[2]);
    if (length(c[0], m[1]) <= length(c[1], m[2])) {
      into.insert(into.end(), {{c[0], c[1], m[1]}, {c[0], m[1], m[2]}});
    } else {
      into.insert(into.end(), {{c[0], c[1], m[2]}, {c[1], m[1], m[2]}});
    }
  }
}

}  // namespace

Mesh split_long_edges(const Mesh& mesh, double longest) {
  Mesh result = mesh;
  while (true) {
    const Edges edges = edges_of(result.triangles);
    Eigen::VectorXi middles = Eigen::VectorXi::Constant(edges.vertices.rows(), -1);
    const Index before = result.positions.rows();
    Index count = before;
    for (Index e = 0; e < middles.size(); ++e) {
      const auto ends = edges.vertices.row(e);
      const double length = (result.positions.row(ends[0]) - result.positions.row(ends[1])).norm();
      if (length > longest) middles[e] = static_cast<int>(count++);
    }
    if (count == before) return result;
    result.positions.conservativeResize(count, 3);
    for (Index e = 0; e < middles.size(); ++e) {
      if (middles[e] < 0) continue;
      const auto ends = edges.vertices.row(e);
      result.positions.row(middles[e]) = (result.positions.row(ends[0]) + result.positions.row(ends[1])) / 2;
    }
    std::vector<Corners> triangles;
    for (Index t = 0; t < result.triangles.rows(); ++t) {
      const Corners on = edges.triangle_edges.row(t);
      split(result.positions, result.triangles.row(t), {middles[on[0]], middles[on[1]], middles[on[2]]}, triangles);
    }
    result.triangles.resize(static_cast<Index>(triangles.size()), 3);
    for (size_t t = 0; t < triangles.size(); ++t) result.triangles.row(static_cast<Index>(t)) = triangles[t];
  }
}

}  // namespace swage
