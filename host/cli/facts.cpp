#include "facts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "adjacency.h"
#include "measures.h"

namespace swage::cli {
namespace {

// Height over longest side up to which a triangle has no area to speak of.
constexpr double kFlat = 1e-10;

/// The group of each of `count` things, numbered from 0, where `pairs` join things to groups.
std::vector<int> groups_of(const std::vector<std::pair<int, int>>& pairs, int count) {
  Triangles links(static_cast<Eigen::Index>(pairs.size()), 3);
  for (size_t i = 0; i < pairs.size(); ++i) {
    links.row(static_cast<Eigen::Index>(i)) << pairs[i].first, pairs[i].second, pairs[i].second;
  }
  return components(links, count);
}

int corner_of(const Triangles& triangles, int triangle, int vertex) {
  int k = 0;
  while (triangles(triangle, k) != vertex) ++k;
  return 3 * triangle + k;
}

/// Whether the triangle runs along the edge from its first to its second vertex.
bool runs_forward(const Triangles& triangles, int triangle, const Eigen::RowVector2i& edge) {
  return triangles(triangle, (corner_of(triangles, triangle, edge[0]) + 1) % 3) == edge[1];
}

bool repeats_vertex(const Eigen::RowVector3i& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

Triangles without_repeats(const Triangles& triangles) {
  Triangles kept = triangles;
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (!repeats_vertex(triangles.row(t))) kept.row(count++) = triangles.row(t);
  }
  kept.conservativeResize(count, 3);
  return kept;
}

void count_edges(Facts& facts, const Triangles& triangles, const Edges& edges) {
  std::vector<std::pair<int, int>> boundary;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    const Eigen::RowVector2i edge = edges.vertices.row(e);
    if (beside.size() == 1) boundary.emplace_back(edge[0], edge[1]);
    if (beside.size() > 2) ++facts.non_manifold_edges;
    if (beside.size() == 2 && runs_forward(triangles, beside[0], edge) == runs_forward(triangles, beside[1], edge)) {
      ++facts.inconsistent_edges;
    }
  }
  facts.boundary_edges = static_cast<int>(boundary.size());
  const std::vector<int> loop = groups_of(boundary, facts.vertices);
  std::set<int> loops;
  for (const auto& [first, second] : boundary) loops.insert(loop[static_cast<size_t>(first)]);
  facts.boundary_loops = static_cast<int>(loops.size());
}

/// A fan is a set of corners at one vertex, joined across edges.
int count_vertices_with_several_fans(const Triangles& triangles, const Edges& edges, int vertex_count) {
  std::vector<std::pair<int, int>> joined;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    for (int i = 1; i < beside.size(); ++i) {
      for (int end : {edges.vertices(e, 0), edges.vertices(e, 1)}) {
        joined.emplace_back(corner_of(triangles, beside[i - 1], end), corner_of(triangles, beside[i], end));
      }
    }
  }
  const int corners = static_cast<int>(triangles.size());
  const std::vector<int> fan = groups_of(joined, corners);
  std::vector<int> fan_of_vertex(static_cast<size_t>(vertex_count), -1);
  std::set<int> several;
  for (int c = 0; c < corners; ++c) {
    const int v = triangles(c / 3, c % 3);
    int& known = fan_of_vertex[static_cast<size_t>(v)];
    if (known < 0) known = fan[static_cast<size_t>(c)];
    if (known != fan[static_cast<size_t>(c)]) several.insert(v);
  }
  return static_cast<int>(several.size());
}

/// How many rows are equal to another one before them.
template <class Row>
int count_repeats(std::vector<Row> rows) {
  std::sort(rows.begin(), rows.end());
  return static_cast<int>(rows.end() - std::unique(rows.begin(), rows.end()));
}

int count_duplicate_triangles(const Triangles& triangles) {
  std::vector<std::array<int, 3>> rows;
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    rows.push_back({triangles(t, 0), triangles(t, 1), triangles(t, 2)});
    std::sort(rows.back().begin(), rows.back().end());
  }
  return count_repeats(std::move(rows));
}

int count_duplicate_vertices(const Positions& positions) {
  std::vector<std::array<double, 3>> rows;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    rows.push_back({positions(v, 0), positions(v, 1), positions(v, 2)});
  }
  return count_repeats(std::move(rows));
}

void count_pieces(Facts& facts, const Triangles& triangles) {
  std::set<int> used(triangles.data(), triangles.data() + triangles.size());
  facts.isolated_vertices = facts.vertices - static_cast<int>(used.size());
  const std::vector<int> component = components(triangles, facts.vertices);
  const int all = component.empty() ? 0 : 1 + *std::max_element(component.begin(), component.end());
  facts.components = all - facts.isolated_vertices;
}

void measure_edges(Facts& facts, const Positions& positions, const Edges& edges) {
  const Eigen::VectorXd lengths = edge_vectors(positions, edges).rowwise().norm();
  if (lengths.size() == 0) return;
  facts.mean_edge = lengths.mean();
  facts.shortest_edge = lengths.minCoeff();
  facts.longest_edge = lengths.maxCoeff();
}

void measure_triangles(Facts& facts, const Mesh& mesh) {
  facts.smallest_angle = std::numeric_limits<double>::infinity();
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    double longest = 0, twice_area = 0;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d a = mesh.positions.row(mesh.triangles(t, k));
      const Eigen::Vector3d ab = mesh.positions.row(mesh.triangles(t, (k + 1) % 3)).transpose() - a;
      const Eigen::Vector3d ac = mesh.positions.row(mesh.triangles(t, (k + 2) % 3)).transpose() - a;
      twice_area = ab.cross(ac).norm();
      longest = std::max(longest, ab.norm());
      facts.smallest_angle = std::min(facts.smallest_angle, std::atan2(twice_area, ab.dot(ac)));
    }
    if (!(twice_area > kFlat * longest * longest)) ++facts.degenerate_triangles;
  }
}

bool is_closed(const Facts& facts) {
  return facts.boundary_edges == 0 && facts.non_manifold_edges == 0 && facts.inconsistent_edges == 0;
}

double volume_of(const Mesh& mesh, const Eigen::Vector3d& middle) {
  const Positions centred = mesh.positions.rowwise() - middle.transpose();
  double sum = 0;
  for (const auto& t : mesh.triangles.rowwise()) {
    sum += centred.row(t[0]).dot(centred.row(t[1]).cross(centred.row(t[2])));
  }
  return sum / 6;
}

}  // namespace

Facts facts_of(const Mesh& mesh) {
  Facts facts;
  facts.vertices = static_cast<int>(mesh.positions.rows());
  facts.triangles = static_cast<int>(mesh.triangles.rows());
  facts.low = mesh.positions.colwise().minCoeff();
  facts.high = mesh.positions.colwise().maxCoeff();
  facts.duplicate_triangles = count_duplicate_triangles(mesh.triangles);
  facts.duplicate_vertices = count_duplicate_vertices(mesh.positions);
  measure_triangles(facts, mesh);

  // A triangle with a vertex twice is no surface: it must not make an edge look like one of three triangles.
  const Triangles triangles = without_repeats(mesh.triangles);
  const Edges edges = edges_of(triangles);
  count_pieces(facts, triangles);
  count_edges(facts, triangles, edges);
  facts.non_manifold_vertices = count_vertices_with_several_fans(triangles, edges, facts.vertices);
  measure_edges(facts, mesh.positions, edges);
  if (is_closed(facts)) facts.volume = volume_of(mesh, (facts.low + facts.high) / 2);
  return facts;
}

}  // namespace swage::cli
