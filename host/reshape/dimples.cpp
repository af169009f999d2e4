// Dimples that handles leave: found, and, as published, spread over the surface around them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan.h"

namespace swage {
namespace {

constexpr int kRings = 4;
constexpr double kDimple = std::numbers::pi * 10 / 180;  // Turn of a normal beside a handle, radians.
constexpr double kHandleWeight = 100;

/// The rings of triangles around vertices: each ring's share a vertex with the ring before.
class Rings {
 public:
  explicit Rings(const TransformStep::Rest& rest)
      : triangles_(rest.triangles),
        around_(triangles_of_vertices(rest.triangles, static_cast<int>(rest.vertices.rows()))),
        met_for_(static_cast<size_t>(rest.triangles.rows()), -1) {}

  std::vector<std::vector<int>> of(int vertex) {
    std::vector<std::vector<int>> rings;
    std::vector<int> vertices{vertex};
    ++asked_;
    for (int ring = 0; ring < kRings; ++ring) {
      std::vector<int> triangles, next;
      for (const int v : vertices) {
        for (const int t : around_[v]) {
          if (std::exchange(met_for_[static_cast<size_t>(t)], asked_) == asked_) continue;
          triangles.push_back(t);
          for (int k = 0; k < 3; ++k) next.push_back(triangles_(t, k));
        }
      }
      rings.push_back(std::move(triangles));
      vertices = std::move(next);
    }
    return rings;
  }

 private:
  const Triangles& triangles_;
  Lists around_;
  std::vector<int> met_for_;  // Of each triangle the last question that met it.
  int asked_ = -1;
};

/// Of triangles that have a normal: of others it says nothing.
double largest_turn(const std::vector<int>& triangles, const Positions& rest_normals, const Positions& normals) {
  double largest = 0;
  for (const int t : triangles) {
    if (normals.row(t).isZero(0)) continue;
    largest = std::max(largest, std::numbers::pi - dihedral_angle(rest_normals.row(t), normals.row(t)));
  }
  return largest;
}

bool is_dimple(const std::vector<std::vector<int>>& rings, const Positions& rest_normals, const Positions& normals) {
  const double near = largest_turn(rings.front(), rest_normals, normals);
  return near > kDimple && near > 2 * largest_turn(rings.back(), rest_normals, normals);
}

/// For each triangle the ring, from 1, of the nearest of the handles; 0 outside all rings of such.
std::vector<int> zone_of(const std::vector<Hold>& handles, const TransformStep::Rest& rest) {
  Rings rings_of(rest);
  std::vector<int> zone(static_cast<size_t>(rest.triangles.rows()), 0);
  for (const Hold& handle : handles) {
    const std::vector<std::vector<int>> rings = rings_of.of(handle.vertex());
    for (int ring = 1; ring <= kRings; ++ring) {
      for (const int t : rings[static_cast<size_t>(ring - 1)]) {
        int& nearest = zone[static_cast<size_t>(t)];
        nearest = nearest == 0 ? ring : std::min(nearest, ring);
      }
    }
  }
  return zone;
}

/// Edges with a triangle of the zone beside them.
std::vector<char> edges_inside(const std::vector<int>& zone, const TransformStep::Rest& rest) {
  std::vector<char> inside(static_cast<size_t>(rest.edges.rows()), 0);
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    if (zone[static_cast<size_t>(t)] == 0) continue;
    for (int k = 0; k < 3; ++k) inside[static_cast<size_t>(rest.triangle_edges(t, k))] = 1;
  }
  return inside;
}

/// The rest shape of the finishing step: the output's outside the zone, blended in its normals inside. Length weights
/// are those of the last pass.
TransformStep::Rest finishing_rest(const ReshapePlan& plan, const Iterate& iterate, const std::vector<int>& zone,
                                   const Positions& positions, const Positions& normals) {
  TransformStep::Rest rest = *plan.rest;
  const std::vector<char> inside = edges_inside(zone, rest);
  const Positions vectors = edge_vectors(positions, plan.edges);
  rest.target_lengths = iterate.quadratics.target_lengths;
  const Positions before = edge_vectors(iterate.before, plan.edges) / rest.mean_edge_length;
  rest.length_weights = before.rowwise().squaredNorm().cwiseMax(1);  // Eq. 6
  for (Eigen::Index e = 0; e < rest.edges.rows(); ++e) {
    if (inside[static_cast<size_t>(e)]) {
      rest.target_lengths[e] = rest.edge_vectors.row(e).norm();
    } else {
      rest.edge_vectors.row(e) = vectors.row(e);
    }
  }
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    const int ring = zone[static_cast<size_t>(t)];
    const double output = ring == 0 ? 1 : static_cast<double>(ring - 1) / kRings;
    rest.normals.row(t) = (output * normals.row(t) + (1 - output) * rest.normals.row(t)).normalized();
  }
  return rest;
}

Holds hold_outside(const std::vector<int>& zone, const Triangles& triangles, const Positions& positions,
                   double weight) {
  std::vector<char> outside(static_cast<size_t>(positions.rows()), 0);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    if (zone[static_cast<size_t>(t)] > 0) continue;
    for (int k = 0; k < 3; ++k) outside[static_cast<size_t>(triangles(t, k))] = 1;
  }
  Holds holds{{}, weight};
  for (int v = 0; v < positions.rows(); ++v) {
    if (outside[static_cast<size_t>(v)] != 0) holds.points.push_back(Hold::at(v, positions.row(v)));
  }
  return holds;
}

Transforms rigid_outside(const std::vector<int>& zone, const Transforms& transforms) {
  Transforms result = identities(transforms.rows());
  for (Eigen::Index t = 0; t < transforms.rows(); ++t) {
    if (zone[static_cast<size_t>(t)] > 0) result.row(t) = transforms.row(t);
  }
  return result;
}

void fit_edges(const Backend& backend, std::shared_ptr<const TransformStep::Rest> rest, const Transforms& transforms,
               TransformStep::EdgeQuadratics& quadratics, const Poll& poll) {
  ask(poll);
  const std::unique_ptr<TransformStep> step = backend.transform(std::move(rest));
  ask(poll);
  step->fit_edges(transforms, quadratics);
}

}  // namespace

std::vector<Hold> dimples(const Holds& handles, const TransformStep::Rest& rest, const Positions& positions) {
  const Positions normals = unit_normals(positions, rest.triangles);
  Rings rings(rest);
  std::vector<Hold> found;
  for (const Hold& handle : handles.points) {
    if (is_dimple(rings.of(handle.vertex()), rest.normals, normals)) found.push_back(handle);
  }
  return found;
}

std::optional<Positions> let_go(const ReshapePlan& plan, Iterate& iterate, const Positions& positions,
                                const Poll& poll) {
  const std::vector<Hold> found = dimples(iterate.handles, *plan.rest, positions);
  if (found.empty()) return std::nullopt;
  const std::vector<int> zone = zone_of(found, *plan.rest);
  const Positions normals = unit_normals(positions, plan.rest->triangles);
  ask(poll);
  const auto shared =
      std::make_shared<const TransformStep::Rest>(finishing_rest(plan, iterate, zone, positions, normals));
  const TransformStep::Rest& rest = *shared;
  ask(poll);
  fit_edges(*plan.options.backend, shared, rigid_outside(zone, iterate.transforms), iterate.quadratics, poll);
  ask(poll);
  Holds handles = iterate.handles;
  handles.weight = kHandleWeight;
  const Holds outside = hold_outside(zone, rest.triangles, positions, plan.weights.handle);
  ask(poll);
  VertexSystem& vertices = iterate.work.vertices;
  vertices.constant =
      std::make_shared<const Eigen::VectorXd>(constant_values(vertices.system, rest, plan.bonds.ties, poll));
  vertices.system.forget_factor();  // Of another problem.
  ask(poll);
  return place_vertices(vertices, rest, iterate.quadratics, plan.bonds, {handles, outside}, positions, poll);
}

}  // namespace swage
