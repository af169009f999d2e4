#include "elements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <tuple>

namespace swage {
namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

struct WeightedEdge {
  int first, second;  // First below second.
  double weight;
};

/// Elements one after another. An edge added twice to one is there once, of both weights.
class ElementList {
 public:
  explicit ElementList(Eigen::Index vertex_count) : of_vertex_(static_cast<size_t>(vertex_count), -1) {}

  void add(int i, int j, double weight) { open_.push_back({std::min(i, j), std::max(i, j), weight}); }

  void close() {
    std::sort(open_.begin(), open_.end(),
              [](const auto& a, const auto& b) { return std::tie(a.first, a.second) < std::tie(b.first, b.second); });
    for (size_t i = 0; i < open_.size(); ++i) {
      const bool again = i > 0 && open_[i].first == open_[i - 1].first && open_[i].second == open_[i - 1].second;
      if (again) {
        edges_.back().weight += open_[i].weight;
      } else {
        edges_.push_back(open_[i]);
      }
    }
    open_.clear();
    offsets_.push_back(static_cast<int>(edges_.size()));
  }

  int next() const { return static_cast<int>(offsets_.size()) - 1; }
  int& of_vertex(int v) { return of_vertex_[static_cast<size_t>(v)]; }

  Elements take(const Positions& vertices) {
    Elements elements;
    PairsRest& pairs = elements.pairs;
    pairs.vertices = vertices;
    pairs.offsets = std::move(offsets_);
    const auto count = static_cast<Eigen::Index>(edges_.size());
    pairs.pairs.resize(count, 2);
    pairs.weights.resize(count);
    for (Eigen::Index p = 0; p < count; ++p) {
      const WeightedEdge& edge = edges_[static_cast<size_t>(p)];
      pairs.pairs.row(p) << edge.first, edge.second;
      pairs.weights[p] = edge.weight;
    }
    elements.of_vertex = std::move(of_vertex_);
    return elements;
  }

 private:
  std::vector<WeightedEdge> open_, edges_;
  std::vector<int> offsets_{0}, of_vertex_;
};

/// Adds the sides of triangles around a vertex.
void add_star(const Triangles& triangles, const Positions& weights, const Lists::Range& around, double factor,
              ElementList& list) {
  for (const int t : around) {
    for (int k = 0; k < 3; ++k) list.add(triangles(t, k), triangles(t, (k + 1) % 3), factor * weights(t, k));
  }
}

/// Of a tetrahedron's edge: a sixth of the length of the edge that faces it, from a to b, times the cotangent of the
/// angle there, which the faces with c and with d make. All six sum to the volume times |gradient|² of a linear
/// function.
double edge_weight(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
  const Vector3d facing = b - a, m = facing.cross(c - a), n = facing.cross(d - a);
  return facing.norm() * m.dot(n) / (6 * m.cross(n).norm());
}

/// Of no volume to speak of: its cotangents are without bound.
bool is_flat_tetrahedron(const Positions& vertices, const Eigen::RowVector4i& t) {
  constexpr double kFlat = 1e-5;
  const auto edge = [&](int i, int j) -> Vector3d { return (vertices.row(t[j]) - vertices.row(t[i])).transpose(); };
  double longest = 0;
  for (int i = 0; i < 4; ++i) {
    for (int j = i + 1; j < 4; ++j) longest = std::max(longest, edge(i, j).norm());
  }
  return !(std::abs(edge(0, 1).cross(edge(0, 2)).dot(edge(0, 3))) > kFlat * longest * longest * longest);
}

using Corners = std::array<int, 3>;

Corners sorted(int a, int b, int c) {
  Corners corners{a, b, c};
  std::sort(corners.begin(), corners.end());
  return corners;
}

/// Around each vertex the triangles that are no face of a tetrahedron.
Lists bare_triangles(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles) {
  std::vector<Corners> faces;
  for (const auto& t : tetrahedra.rowwise()) {
    if (is_flat_tetrahedron(vertices, t)) continue;
    for (int k = 0; k < 4; ++k) faces.push_back(sorted(t[k], t[(k + 1) % 4], t[(k + 2) % 4]));
  }
  std::sort(faces.begin(), faces.end());
  std::vector<std::pair<int, int>> bare;
  for (int t = 0; t < triangles.rows(); ++t) {
    if (std::binary_search(faces.begin(), faces.end(), sorted(triangles(t, 0), triangles(t, 1), triangles(t, 2)))) {
      continue;
    }
    for (int k = 0; k < 3; ++k) bare.emplace_back(triangles(t, k), t);
  }
  return lists_from(static_cast<int>(vertices.rows()), bare);
}

Eigen::Index element_count(const PairsRest& pairs) { return static_cast<Eigen::Index>(pairs.offsets.size()) - 1; }

/// Weight of all elements together on a mean edge.
double mean_stiffness(const PairsRest& pairs) {
  std::vector<std::pair<int, int>> edges;
  for (const auto& pair : pairs.pairs.rowwise()) edges.emplace_back(pair[0], pair[1]);
  std::sort(edges.begin(), edges.end());
  const auto count = std::unique(edges.begin(), edges.end()) - edges.begin();
  return pairs.weights.sum() / static_cast<double>(count);
}

/// The elements with further edges, and further elements of these alone.
Elements with_edges(const Positions& vertices, const PairsRest& pairs,
                    const std::vector<std::vector<WeightedEdge>>& further, std::vector<int> of_vertex) {
  ElementList list(vertices.rows());
  for (size_t n = 0; n < further.size(); ++n) {
    if (static_cast<Eigen::Index>(n) < element_count(pairs)) {
      for (int p = pairs.offsets[n]; p < pairs.offsets[n + 1]; ++p) {
        list.add(pairs.pairs(p, 0), pairs.pairs(p, 1), pairs.weights[p]);
      }
    }
    for (const WeightedEdge& edge : further[n]) list.add(edge.first, edge.second, edge.weight);
    list.close();
  }
  Elements elements = list.take(vertices);
  elements.of_vertex = std::move(of_vertex);
  return elements;
}

}  // namespace

Positions half_cotangents(const Positions& positions, const Triangles& triangles, const std::vector<char>& is_flat) {
  Positions result = Positions::Constant(triangles.rows(), 3, 0.5 / std::sqrt(3.0));
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] != 0) continue;
    for (int k = 0; k < 3; ++k) {
      const RowVector3d facing = positions.row(triangles(t, (k + 2) % 3));
      const RowVector3d a = positions.row(triangles(t, k)) - facing,
                        b = positions.row(triangles(t, (k + 1) % 3)) - facing;
      result(t, k) = a.dot(b) / (2 * a.cross(b).norm());
    }
  }
  return result;
}

Elements triangle_elements(const Mesh& mesh, double weight) {
  ElementList list(mesh.positions.rows());
  for (const auto& triangle : mesh.triangles.rowwise()) {
    for (int k = 0; k < 3; ++k) {
      list.of_vertex(triangle[k]) = list.next();
      list.add(triangle[k], triangle[(k + 1) % 3], weight);
    }
    list.close();
  }
  return list.take(mesh.positions);
}

Elements vertex_elements(const Mesh& mesh, const std::vector<char>& is_flat) {
  const auto count = static_cast<int>(mesh.positions.rows());
  const Positions weights = half_cotangents(mesh.positions, mesh.triangles, is_flat);
  const Lists around = triangles_of_vertices(mesh.triangles, count);
  ElementList list(count);
  for (int v = 0; v < count; ++v) {
    list.of_vertex(v) = list.next();
    add_star(mesh.triangles, weights, around[v], 1, list);
    list.close();
  }
  return list.take(mesh.positions);
}

Elements tetrahedron_elements(const Positions& vertices, const Tetrahedra& tetrahedra, const Triangles& triangles,
                              const std::vector<char>& is_flat, double thickness) {
  ElementList list(vertices.rows());
  const auto at = [&](int v) -> Vector3d { return vertices.row(v).transpose(); };
  for (const auto& t : tetrahedra.rowwise()) {
    if (is_flat_tetrahedron(vertices, t)) continue;
    constexpr int kEdges[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
    for (const auto& [a, b, c, d] : kEdges) {
      list.add(t[a], t[b], edge_weight(at(t[c]), at(t[d]), at(t[a]), at(t[b])));
    }
    for (int k = 0; k < 4; ++k) list.of_vertex(t[k]) = list.next();
    list.close();
  }
  const auto count = static_cast<int>(vertices.rows());
  const Positions weights = half_cotangents(vertices, triangles, is_flat);
  const Lists bare = bare_triangles(vertices, tetrahedra, triangles);
  for (int v = 0; v < count; ++v) {
    if (bare[v].size() == 0) continue;
    if (list.of_vertex(v) < 0) list.of_vertex(v) = list.next();
    add_star(triangles, weights, bare[v], thickness, list);
    list.close();
  }
  return list.take(vertices);
}

void add_ties(const Positions& vertices, const std::vector<Tie>& ties, double mean_edge_length, Elements& elements) {
  PairsRest& pairs = elements.pairs;
  if (ties.empty()) return;
  const double stiffness = mean_stiffness(pairs) * mean_edge_length * mean_edge_length;
  std::vector<std::vector<WeightedEdge>> of_element(static_cast<size_t>(element_count(pairs)));
  std::vector<int> of_vertex = elements.of_vertex;
  of_vertex.resize(static_cast<size_t>(vertices.rows()), -1);
  const auto add = [&](int v, const WeightedEdge& edge) {
    int& element = of_vertex[static_cast<size_t>(v)];
    if (element < 0) {
      element = static_cast<int>(of_element.size());
      of_element.emplace_back();
    }
    of_element[static_cast<size_t>(element)].push_back(edge);
  };
  for (const Tie& tie : ties) {
    for (const auto& [i, positive] : tie.factors) {
      for (const auto& [j, negative] : tie.factors) {
        if (positive <= 0 || negative >= 0) continue;
        const WeightedEdge half{i, j, -0.5 * stiffness * tie.weight * positive * negative};
        add(i, half);
        add(j, half);
      }
    }
  }
  elements = with_edges(vertices, pairs, of_element, std::move(of_vertex));
}

}  // namespace swage
