#include "split_edges.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "adjacency.h"

namespace swage {
namespace {

using Eigen::Index;

using Triple = Eigen::RowVector3i;

/// A triangle whose edges have middles; -1: none.
void split(const Positions& positions, const Triple& corners, const Triple& middles, std::vector<Triple>& into) {
  const auto turned = [](const Triple& of, int by) { return Triple(of[by % 3], of[(by + 1) % 3], of[(by + 2) % 3]); };
  const auto count = (middles.array() >= 0).count();
  // So that the first edge is the only one with a middle, or without.
  int first = 0;
  while (count > 0 && count < 3 && (middles[first] >= 0) != (count == 1)) ++first;
  const Triple c = turned(corners, first), m = turned(middles, first);
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

/// The longest edges of those longer than `longest` whose halving makes no more than `more` triangles, in order.
std::vector<int> longest_edges(const Positions& positions, const Edges& edges, double longest, Index more) {
  std::vector<std::pair<double, int>> all;
  for (int e = 0; e < edges.vertices.rows(); ++e) {
    const auto ends = edges.vertices.row(e);
    const double length = (positions.row(ends[0]) - positions.row(ends[1])).norm();
    if (length > longest) all.emplace_back(-length, e);
  }
  std::sort(all.begin(), all.end());
  std::vector<int> found;
  for (const auto& [length, e] : all) {
    more -= static_cast<Index>(edges.triangles[e].size());
    if (more < 0) break;
    found.push_back(e);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

Mesh split_long_edges(const Mesh& mesh, double longest, Index most) {
  Mesh result = mesh;
  while (true) {
    const Edges edges = edges_of(result.triangles);
    const std::vector<int> halved = longest_edges(result.positions, edges, longest, most - result.triangles.rows());
    if (halved.empty()) return result;
    Eigen::VectorXi middles = Eigen::VectorXi::Constant(edges.vertices.rows(), -1);
    Index middle = result.positions.rows();
    result.positions.conservativeResize(middle + static_cast<Index>(halved.size()), 3);
    for (const int e : halved) {
      const auto ends = edges.vertices.row(e);
      result.positions.row(middle) = (result.positions.row(ends[0]) + result.positions.row(ends[1])) / 2;
      middles[e] = static_cast<int>(middle++);
    }
    std::vector<Triple> triangles;
    for (Index t = 0; t < result.triangles.rows(); ++t) {
      const Triple on = edges.triangle_edges.row(t);
      split(result.positions, result.triangles.row(t), {middles[on[0]], middles[on[1]], middles[on[2]]}, triangles);
    }
    result.triangles.resize(static_cast<Index>(triangles.size()), 3);
    for (size_t t = 0; t < triangles.size(); ++t) result.triangles.row(static_cast<Index>(t)) = triangles[t];
  }
}

}  // namespace swage
