// The global steps: two sparse systems.
#include "element_graphs.h"
#include "gradients.h"
#include "plan.h"
#include "sphericity.h"
#include "swage/error.h"

namespace swage {
namespace {

using Eigen::Matrix3d;

// What multigrid leaves of a pass's error. Tenfold less of either takes as many passes; twice as much, more.
constexpr double kNearTransforms = 0.1, kNearVertices = 1e-2;
// First passes go far, and what they leave moves vertices farther than energies tell.
constexpr double kNearVerticesAtFirst = 1e-3;
constexpr int kFirst = 2;
// A factor is made and used in the time of 40 to 100 iterations.
constexpr int kMostForVertices = 60;
// What transforms do to normals hardly matters and converges slowly: left to the passes to come.
constexpr int kMostForTransforms = 20;

struct Quadratic {
  BlockSystem& system;
  Eigen::VectorXd right_hand_side;
};

void add_edges(Quadratic& quadratic, const BlockSystem::Stars& edges, const TransformStep::Rest& rest,
               const TransformStep::EdgeQuadratics& quadratics) {
  quadratic.system.add_differences(edges, quadratics.blocks);
  for (Eigen::Index e = 0; e < rest.edges.rows(); ++e) {
    quadratic.right_hand_side.segment<3>(3 * rest.edges(e, 0)) -= quadratics.right_hand_sides.row(e);
    quadratic.right_hand_side.segment<3>(3 * rest.edges(e, 1)) += quadratics.right_hand_sides.row(e);
  }
}

/// Eq. 22 for one inner vertex of a chain; beside an edge shorter than firm_length no firmer than beside one of it, or
/// the matrix would be singular in double precision.
void add_straight(Quadratic& quadratic, const StraightTriple& triple, const Eigen::VectorXd& target_lengths,
                  double weight, double firm_length) {
  const double length_before = target_lengths[triple.edge_before], length_after = target_lengths[triple.edge_after];
  const double shorter = std::min(length_before, length_after);
  const double softer = shorter < firm_length ? shorter / firm_length : 1;
  const double before = softer / length_before, after = softer / length_after;
  const std::array<int, 3> vertices{triple.before, triple.middle, triple.after};
  const std::array<double, 3> factors{before, -before - after, after};
  for (size_t a = 0; a < 3; ++a) {
    quadratic.system.add(vertices[a], weight * factors[a] * factors[a] * Matrix3d::Identity());
    for (size_t b = a + 1; b < 3; ++b) {
      const Matrix3d block = weight * factors[a] * factors[b] * Matrix3d::Identity();
      if (vertices[a] == vertices[b]) {
        quadratic.system.add(vertices[a], 2 * block);
      } else {
        quadratic.system.add(vertices[a], vertices[b], 0, block);
      }
    }
  }
}

void add_hold(Quadratic& quadratic, const Hold& hold, double weight) {
  for (size_t a = 0; a < 3; ++a) {
    const int v = hold.vertices[a];
    const double factor = hold.factors[static_cast<Eigen::Index>(a)];
    if (factor == 0) continue;
    quadratic.system.add(v, weight * factor * factor * Matrix3d::Identity());
    quadratic.right_hand_side.segment<3>(3 * v) += weight * factor * hold.target;
    for (size_t b = a + 1; b < 3; ++b) {
      const double other = hold.factors[static_cast<Eigen::Index>(b)];
      if (other != 0) quadratic.system.add(v, hold.vertices[b], 0, weight * factor * other * Matrix3d::Identity());
    }
  }
}

void add_tie(BlockSystem& system, const Tie& tie) {
  for (size_t a = 0; a < tie.factors.size(); ++a) {
    const auto [v, factor] = tie.factors[a];
    system.add(v, tie.weight * factor * factor * Matrix3d::Identity());
    for (size_t b = a + 1; b < tie.factors.size(); ++b) {
      const auto [other, times] = tie.factors[b];
      system.add(v, other, 0, tie.weight * factor * times * Matrix3d::Identity());
    }
  }
}

void add_sphericity(BlockSystem& system, const TransformStep::Rest& rest, Eigen::Index t) {
  for (const Corner& corner : corners(rest, t)) {
    const Matrix3d at_j = Matrix3d::Identity() / corner.length_j, at_k = -corner.turn / corner.length_k;
    const std::array<int, 3> vertices{corner.i, corner.j, corner.k};
    const std::array<Matrix3d, 3> factors{-at_j - at_k, at_j, at_k};
    for (size_t a = 0; a < 3; ++a) {
      system.add(vertices[a], rest.sphericities[t] * factors[a].transpose() * factors[a]);
      for (size_t b = a + 1; b < 3; ++b) {
        system.add(vertices[a], vertices[b], 0, rest.sphericities[t] * factors[a].transpose() * factors[b]);
      }
    }
  }
}

}  // namespace

Eigen::VectorXd constant_values(BlockSystem& system, const TransformStep::Rest& rest, const std::vector<Tie>& ties,
                                const Poll& poll) {
  system.set_zero();
  ask(poll);
  for (Eigen::Index t = 0; t < rest.triangles.rows(); ++t) {
    if (rest.sphericities[t] != 0) add_sphericity(system, rest, t);
  }
  for (const Tie& tie : ties) add_tie(system, tie);
  ask(poll);
  return system.values();
}

Eigen::VectorXd assemble(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                         const std::vector<Holds>& holds) {
  Quadratic quadratic{vertices.system, Eigen::VectorXd::Zero(vertices.system.unknowns())};
  vertices.system.values() = *vertices.constant;
  add_edges(quadratic, *vertices.edges, rest, quadratics);
  for (const StraightTriple& triple : bonds.straight) {
    add_straight(quadratic, triple, quadratics.target_lengths, bonds.straightness_weight, bonds.firm_length);
  }
  for (const Tie& tie : bonds.ties) {
    for (const auto& [v, factor] : tie.factors) {
      quadratic.right_hand_side.segment<3>(3 * v) += tie.weight * factor * tie.rest;
    }
  }
  for (const Holds& held : holds) {
    for (const Hold& hold : held.points) add_hold(quadratic, hold, hold.share * held.weight);
  }
  return quadratic.right_hand_side;
}

Positions place_vertices(VertexSystem& vertices, const TransformStep::Rest& rest,
                         const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                         const std::vector<Holds>& holds, const Positions& start, const Poll& poll) {
  if (!vertices.system.has_factor()) {
    if (std::optional<Positions> placed = place_by_multigrid(vertices, rest, quadratics, bonds, holds, start, poll)) {
      return *placed;
    }
    vertices = vertex_system(rest, bonds, {}, poll);
  }
  const Eigen::VectorXd right_hand_side = assemble(vertices, rest, quadratics, bonds, holds);
  ask(poll);
  const Eigen::VectorXd solution =
      vertices.system.solve_near(right_hand_side, Eigen::Map<const Eigen::VectorXd>(start.data(), start.size()));
  return Eigen::Map<const Positions>(solution.data(), rest.vertices.rows(), 3);
}

std::optional<Positions> place_by_multigrid(VertexSystem& vertices, const TransformStep::Rest& rest,
                                            const TransformStep::EdgeQuadratics& quadratics, const Bonds& bonds,
                                            const std::vector<Holds>& holds, const Positions& start, const Poll& poll) {
  const Eigen::VectorXd right_hand_side = assemble(vertices, rest, quadratics, bonds, holds);
  ask(poll);
  const ElementGraph graph = vertex_graph(rest, quadratics, bonds.ties, holds);
  ask(poll);
  vertices.multilevel ? vertices.multilevel->refill(graph, poll) : void(vertices.multilevel.emplace(graph, poll));
  const auto times_matrix = [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = vertices.system.times(x); };
  Eigen::VectorXd solution = Eigen::Map<const Eigen::VectorXd>(start.data(), start.size());
  const double near = vertices.solves++ < kFirst ? kNearVerticesAtFirst : kNearVertices;
  const Gradients done =
      vertices.multilevel->improve(times_matrix, right_hand_side, near, kMostForVertices, solution, poll);
  if (!done.converged) return std::nullopt;
  return Eigen::Map<const Positions>(solution.data(), rest.vertices.rows(), 3);
}

Transforms improved_transforms(const Multilevel& multilevel, CouplingStep& matrix, const Transforms& right_hand_sides,
                               const Transforms& transforms, const Poll& poll) {
  Transforms left;
  matrix.apply(transforms, left);
  left = right_hand_sides - left;
  ask(poll);
  Eigen::VectorXd change;
  const Gradients done = multilevel.solve(Eigen::Map<const Eigen::VectorXd>(left.data(), left.size()), kNearTransforms,
                                          kMostForTransforms, change, poll);
  if (!done.converged && done.iterations == 0) {  // Or passes would end where transforms no longer follow.
    throw Unsolvable(
        "transform step: multigrid could not bring the transforms nearer; solve with linear_solver = factor");
  }
  return transforms + Eigen::Map<const Transforms>(change.data(), transforms.rows(), 9);
}

Transforms solve_transforms(const BlockSystem& system, const Transforms& right_hand_sides) {
  const Eigen::Map<const Eigen::VectorXd> flat(right_hand_sides.data(), right_hand_sides.size());
  const Eigen::VectorXd solution = system.solve(flat);
  return Eigen::Map<const Transforms>(solution.data(), right_hand_sides.rows(), 9);
}

Transforms improved_transforms(const BlockSystem& system, const Transforms& right_hand_sides,
                               const Transforms& transforms) {
  const Eigen::VectorXd solution =
      system.improved(Eigen::Map<const Eigen::VectorXd>(right_hand_sides.data(), right_hand_sides.size()),
                      Eigen::Map<const Eigen::VectorXd>(transforms.data(), transforms.size()));
  return Eigen::Map<const Transforms>(solution.data(), transforms.rows(), 9);
}

}  // namespace swage
