// What the steps need of the rest shape.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "flat.h"
#include "plan.h"
#include "sphericity.h"

namespace swage {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// What replaces the paper's 0/1 feature flag: edges soften as they sharpen.
double similarity_weight(double dihedral, double feature_angle) {
  if (dihedral <= feature_angle) return 0;
  constexpr double kWidth = std::numbers::pi / 6;
  return std::exp(-std::pow(dihedral - std::numbers::pi, 2) / (2 * kWidth * kWidth));
}

/// Gamma of the paper's section 4.1, with the cut-offs of its program.
double sphericity_weight(double k1, double k2) {
  const double anisotropy = (k1 - k2) / (std::max(std::abs(k1), std::abs(k2)) + 1e-3);
  const double roundness = std::min(1.0, std::min(std::abs(k1), std::abs(k2)) / 2);
  if (anisotropy > 0.5 || roundness <= 0.01) return 0;
  return std::exp(-std::pow(anisotropy / 0.2, 2) / 2) * std::exp(-std::pow((roundness - 1) / 0.3, 2) / 2);
}

/// The vertex of the triangle that is not on the edge.
int opposite(const Triangles& triangles, int triangle, const Eigen::RowVector2i& edge) {
  for (int k = 0; k < 3; ++k) {
    const int v = triangles(triangle, k);
    if (v != edge[0] && v != edge[1]) return v;
  }
  return edge[0];
}

/// Each two triangles beside an edge. Of very many, each and the next: their pairs would outgrow the mesh.
std::vector<std::array<int, 3>> pairs_of(const Edges& edges) {
  constexpr int kManyBeside = 16;
  std::vector<std::array<int, 3>> pairs;
  for (int e = 0; e < edges.triangles.size(); ++e) {
    const Lists::Range beside = edges.triangles[e];
    for (int i = 0; i < beside.size(); ++i) {
      const int last = beside.size() > kManyBeside ? std::min(i + 2, beside.size()) : beside.size();
      for (int j = i + 1; j < last; ++j) pairs.push_back({beside[i], beside[j], e});
    }
  }
  return pairs;
}

/// Interior, whichever way the triangles wind.
double dihedral_angle(const TransformStep::Rest& rest, int t, int s, const Eigen::RowVector2i& edge) {
  const bool alike = runs_along(rest.triangles, t, edge) != runs_along(rest.triangles, s, edge);
  return swage::dihedral_angle(rest.normals.row(t), (alike ? 1 : -1) * rest.normals.row(s));
}

void add_pairs(TransformStep::Rest& rest, const Edges& edges, double feature_angle, double similarity) {
  const std::vector<std::array<int, 3>> pairs = pairs_of(edges);
  const auto count = static_cast<Eigen::Index>(pairs.size());
  rest.pairs.resize(count, 2);
  rest.pair_edges.resize(count);
  rest.pair_opposites.resize(count, 3);
  rest.pair_similarities.resize(count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const auto [t, s, e] = pairs[static_cast<size_t>(p)];
    const int v = opposite(rest.triangles, t, edges.vertices.row(e));
    const int w = opposite(rest.triangles, s, edges.vertices.row(e));
    rest.pairs.row(p) << t, s;
    rest.pair_edges[p] = e;
    rest.pair_opposites.row(p) = (rest.vertices.row(v) - rest.vertices.row(w)).normalized();
    rest.pair_similarities[p] =
        similarity * similarity_weight(dihedral_angle(rest, t, s, edges.vertices.row(e)), feature_angle);
  }
}

}  // namespace

std::vector<StraightTriple> straight_triples(const std::vector<std::vector<int>>& chains, const Edges& edges) {
  std::vector<StraightTriple> triples;
  for (const std::vector<int>& chain : chains) {
    int edge_before = -1;
    for (size_t i = 0; i + 1 < chain.size(); ++i) {
      const int edge = edge_between(edges, chain[i], chain[i + 1]);
      if (edge >= 0 && edge_before >= 0) triples.push_back({chain[i - 1], chain[i], chain[i + 1], edge_before, edge});
      edge_before = edge;  // None where vertices of one place took the edge with them.
    }
  }
  return triples;
}

TransformStep::Rest rest_shape(const ReshapeOptions& options, const Mesh& unit_mesh, const Edges& edges,
                               const Curvatures& unit_box_curvatures) {
  const StepWeights weights = step_weights(options, unit_mesh);
  TransformStep::Rest rest;
  rest.triangles = unit_mesh.triangles;
  rest.edges = edges.vertices;
  rest.triangle_edges = edges.triangle_edges;
  rest.vertices = unit_mesh.positions;
  rest.edge_vectors = edge_vectors(rest.vertices, edges);
  const std::vector<char> is_flat = flat_triangles(rest.vertices, rest.triangles);
  rest.normals = lent_normals(rest.vertices, rest.triangles, edges, is_flat);
  rest.mean_edge_length = mean_edge_length(rest.vertices, rest.triangles);
  rest.normal_weight = weights.normal;
  rest.scale_weight = weights.scale;
  rest.connect_weight = weights.connect;
  rest.transform_normal_weight = weights.transform_normal;
  rest.regularizer_weight = weights.regularizer;
  rest.normal_regularizer_weight = weights.normal_regularizer;
  rest.maps_normals = rest.weighs_targets = options.solver == ReshapeSolver::steady;
  if (weights.sphericity > 0) rest.transform_sphericity_factor = weights.transform_sphericity / weights.sphericity;
  rest.sphericities.resize(rest.triangles.rows());
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    if (is_flat[static_cast<size_t>(t)] != 0) {
      rest.sphericities[t] = 0;
    } else if (options.method == ReshapeMethod::alup) {
      rest.sphericities[t] = weights.sphericity;  // Conformality, eq. 18 and 27.
    } else {
      rest.sphericities[t] =
          weights.sphericity * sphericity_weight(unit_box_curvatures(t, 0), unit_box_curvatures(t, 1));
    }
  }
  add_pairs(rest, edges, options.feature_angle, weights.similarity);
  return rest;
}

Eigen::Matrix<double, 9, 9> triangle_block(const TransformStep::Rest& rest, Eigen::Index t) {
  Matrix9d block = rest.regularizer_weight * Matrix9d::Identity();
  const Vector3d normal = rest.normals.row(t);
  for (int r = 0; r < 3; ++r) {
    block.block<3, 3>(3 * r, 3 * r) += rest.normal_regularizer_weight * normal * normal.transpose();
  }
  for (int k = 0; k < 3; ++k) {
    const Vector3d e0 = rest.edge_vectors.row(rest.triangle_edges(t, k)), d = e0.normalized();
    Eigen::Matrix<double, 9, 1> tilt;
    for (int r = 0; r < 3; ++r) {
      block.block<3, 3>(3 * r, 3 * r) += e0 * e0.transpose() / rest.mean_edge_length;
      tilt.segment<3>(3 * r) = normal[r] * d;
    }
    block += rest.transform_normal_weight * tilt * tilt.transpose();
  }
  if (rest.sphericities[t] == 0) return block;
  for (const Corner& corner : corners(rest, t)) {
    Eigen::Matrix<double, 3, 9> difference;
    for (int r = 0; r < 3; ++r) {
      difference.middleCols<3>(3 * r) = -corner.turn.col(r) * corner.toward_k.transpose();
      difference.row(r).segment<3>(3 * r) += corner.toward_j.transpose();
    }
    block += rest.transform_sphericity_factor * rest.sphericities[t] * difference.transpose() * difference;
  }
  return block;
}

Matrix3d pair_block(const TransformStep::Rest& rest, Eigen::Index p) {
  const Vector3d d = rest.edge_vectors.row(rest.pair_edges[p]).normalized(), o = rest.pair_opposites.row(p);
  return rest.connect_weight * d * d.transpose() + rest.pair_similarities[p] * o * o.transpose();
}

VertexSystem vertex_system(const TransformStep::Rest& rest, const Bonds& bonds, std::optional<FactorKind> kind,
                           const Poll& poll) {
  std::vector<std::pair<int, int>> couplings;
  for (const auto& edge : rest.edges.rowwise()) couplings.emplace_back(edge[0], edge[1]);
  for (const StraightTriple& triple : bonds.straight) {
    if (triple.before != triple.after) couplings.emplace_back(triple.before, triple.after);
  }
  for (const Tie& tie : bonds.ties) {
    for (size_t a = 0; a < tie.factors.size(); ++a) {
      for (size_t b = a + 1; b < tie.factors.size(); ++b) {
        couplings.emplace_back(tie.factors[a].first, tie.factors[b].first);
      }
    }
  }
  VertexSystem vertices{BlockSystem(static_cast<int>(rest.vertices.rows()), 1, couplings, kind), {}, {}};
  ask(poll);
  vertices.edges = std::make_shared<const BlockSystem::Stars>(vertices.system.stars(rest.edges));
  ask(poll);
  vertices.constant = std::make_shared<const Eigen::VectorXd>(constant_values(vertices.system, rest, bonds.ties, poll));
  return vertices;
}

BlockSystem transform_system(const TransformStep::Rest& rest, std::optional<FactorKind> kind, const Poll& poll) {
  std::vector<std::pair<int, int>> couplings;
  for (const auto& pair : rest.pairs.rowwise()) couplings.emplace_back(pair[0], pair[1]);
  BlockSystem system(static_cast<int>(rest.triangles.rows()), 3, couplings, kind);
  ask(poll);
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) system.add(static_cast<int>(t), triangle_block(rest, t));
  for (Eigen::Index p = 0; p < rest.pairs.rows(); ++p) {
    const Matrix3d agree = pair_block(rest, p);
    Matrix9d own = Matrix9d::Zero();
    for (int r = 0; r < 3; ++r) {
      own.block<3, 3>(3 * r, 3 * r) = agree;
      system.add(rest.pairs(p, 0), rest.pairs(p, 1), r, -agree);
    }
    system.add(rest.pairs(p, 0), own);
    system.add(rest.pairs(p, 1), own);
  }
  return system;
}

}  // namespace swage
