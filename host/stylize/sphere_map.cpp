// A style's way to the sphere, by conformalised mean curvature flow (Kazhdan, Solomon, Ben-Chen 2012).
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "adjacency.h"
#include "flat.h"
#include "laplacian_system.h"
#include "measures.h"
#include "sphere.h"
#include "spokes_and_rims.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kTimeStep = 1e-3;  // Of unit area.
constexpr double kStill = 1e-9;
constexpr int kStepLimit = 300;

[[noreturn]] void refuse_surface(const std::string& why) {
  throw Unsolvable("sphere_map: style: " + why + "; take another style, or its closest normals");
}

/// As a sphere is: closed, in one part, without tunnels.
void check_topology(const Mesh& style) {
  const Edges edges = edges_of(style.triangles);
  for (int e = 0; e < edges.triangles.size(); ++e) {
    if (edges.triangles[e].size() == 2) continue;
    refuse_surface("the edge of vertices " + std::to_string(edges.vertices(e, 0)) + " and " +
                   std::to_string(edges.vertices(e, 1)) + " has " + std::to_string(edges.triangles[e].size()) +
                   " triangles, not two: only a closed surface flows to a sphere");
  }
  const std::vector<int> component = components(style.triangles, static_cast<int>(style.positions.rows()));
  const int parts = 1 + *std::max_element(component.begin(), component.end());
  if (parts > 1) refuse_surface(std::to_string(parts) + " components: only a surface in one part flows to a sphere");
  const Eigen::Index euler = style.positions.rows() - edges.vertices.rows() + style.triangles.rows();
  if (euler != 2) {
    refuse_surface("Euler characteristic " + std::to_string(euler) +
                   ", a sphere's is 2: it has tunnels or pinched vertices");
  }
}

/// About the surface's centre, of area 1.
void centre_and_scale(Positions& positions, const Triangles& triangles) {
  const Eigen::VectorXd mass = barycentric_areas(positions, triangles);
  const double area = mass.sum();
  positions.rowwise() -= (mass.transpose() * positions / area).eval();
  positions /= std::sqrt(area);
}

/// L stays the style's, the masses follow the flow: (M + dt L) U⁺ = M U. Not `scaled`, the first step is one of the
/// style's own size.
Positions flowed(const Mesh& style, bool scaled) {
  const Positions cotangents =
      half_cotangents(style.positions, style.triangles, flat_triangles(style.positions, style.triangles));
  const SparseMatrix laplacian = kTimeStep * LaplacianSystem(triangle_elements(style, cotangents).pairs).laplacian();
  Eigen::SimplicialLDLT<SparseMatrix> factor;
  factor.analyzePattern(laplacian);
  Positions positions = style.positions;
  if (scaled) centre_and_scale(positions, style.triangles);
  for (int step = 0; step < kStepLimit; ++step) {
    const Eigen::VectorXd mass = barycentric_areas(positions, style.triangles);
    SparseMatrix matrix = laplacian;
    matrix.diagonal() += mass;
    factor.factorize(matrix);
    const Eigen::MatrixX3d right = mass.asDiagonal() * positions;
    Positions next = factor.solve(right);
    if (factor.info() != Eigen::Success || !next.allFinite()) refuse_surface("the flow to a sphere broke down");
    centre_and_scale(next, style.triangles);
    const Positions moved = next - positions;
    positions = next;
    const Eigen::RowVector3d work = mass.transpose() * moved.cwiseAbs2();
    if (work.sum() < kStill) break;
  }
  return positions;
}

}  // namespace

SphereMap sphere_map(const Mesh& style, bool nearest) {
  check(style.positions, style.triangles);
  check_topology(style);
  const Positions sphere = flowed(style, !nearest);
  const Positions directions = normalised(sphere);
  const int folded = folded_triangles(directions, style.triangles);
  if (folded > 0) {
    refuse_surface("the flow does not reach a sphere: " + std::to_string(folded) + " of " +
                   std::to_string(style.triangles.rows()) + " triangles are folded after " +
                   std::to_string(kStepLimit) + " steps at most, or wind inside out");
  }
  return {nearest ? vertex_normals(sphere, style.triangles) : directions, style.triangles,
          vertex_normals(style.positions, style.triangles), nearest};
}

}  // namespace swage
