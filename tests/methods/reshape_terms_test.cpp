// Each term of both steps: the matrix that is solved against differences of the energy it stands for.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "measures.h"
#include "plan.h"
#include "shapes.h"

namespace swage {
namespace {

constexpr double kDifference = 1e-6;  // Of a central difference: its error is rounding, energies being quadratic.
constexpr double kTolerance = 1e-6;   // Relative to the gradient's length.

/// A small round shape with every term alive: curved, so that sphericity counts, and a straight chain.
struct Case {
  ReshapeOptions options;
  Mesh mesh = test::transformed(test::sphere(0.5, 1), 1, {0.5, 0.5, 0.5});
  Edges edges = edges_of(mesh.triangles);
  Bonds bonds;
  TransformStep::Rest rest;
  Transforms transforms;
  Positions positions;

  explicit Case(const ReshapeWeights& weights, ReshapeSolver solver = ReshapeSolver::published) {
    options.solver = solver;
    options.weights = weights;
    const Curvatures curvatures = Curvatures::Constant(mesh.triangles.rows(), 2, 2);
    rest = rest_shape(options, mesh, edges, curvatures);
    bonds = {straight_triples({chain()}, edges), weights.straightness};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-0.2, 0.2);
    transforms = identities(rest.triangles.rows()).unaryExpr([&](double x) { return x + number(random); });
    positions = mesh.positions.unaryExpr([&](double x) { return x + number(random) / 4; });
  }

  std::vector<int> chain() const {
    const Lists ring = one_rings(edges, static_cast<int>(mesh.positions.rows()));
    std::vector<int> vertices{0, ring[0][0]};
    for (const int v : ring[vertices[1]]) {
      if (v != 0) return {0, vertices[1], v};
    }
    return vertices;
  }
};

ReshapeWeights no_weights() {
  ReshapeWeights none;
  none.normal = none.similarity = none.connect = none.sphericity = none.scale = none.straightness = 0;
  none.normal_regularizer = 0;
  none.regularizer = none.handle = 1e-12;
  return none;
}

void expect_gradient(const Eigen::VectorXd& gradient, const Eigen::VectorXd& at,
                     const std::function<double(const Eigen::VectorXd&)>& energy) {
  ASSERT_GT(gradient.norm(), 1e-8) << "the term is not alive";
  for (Eigen::Index i = 0; i < at.size(); i += 7) {
    Eigen::VectorXd ahead = at, behind = at;
    ahead[i] += kDifference;
    behind[i] -= kDifference;
    const double difference = (energy(ahead) - energy(behind)) / (2 * kDifference);
    ASSERT_NEAR(gradient[i], difference, kTolerance * gradient.norm()) << "unknown " << i;
  }
}

using Weigh = void (*)(ReshapeWeights&);
using LocalTerm = double (*)(const TransformStep::Energy&);

Eigen::VectorXd flat(const Positions& positions) {
  return Eigen::Map<const Eigen::VectorXd>(positions.data(), positions.size());
}
Eigen::VectorXd flat(const Transforms& transforms) {
  return Eigen::Map<const Eigen::VectorXd>(transforms.data(), transforms.size());
}
Positions as_positions(const Eigen::VectorXd& x) { return Eigen::Map<const Positions>(x.data(), x.size() / 3, 3); }
Transforms as_transforms(const Eigen::VectorXd& x) { return Eigen::Map<const Transforms>(x.data(), x.size() / 9, 9); }

/// 2 (A x - b) of the vertex step with these weights, less that of the transform term alone where asked.
Eigen::VectorXd vertex_gradient(const Case& c) {
  VertexSystem vertices = vertex_system(c.rest, c.bonds);
  const auto step = cpu_backend()->transform(c.rest);
  TransformStep::EdgeQuadratics quadratics;
  step->fit_edges(c.transforms, quadratics);
  const Holds handles{{Hold::at(3, c.positions.row(0)), Hold::at(5, c.positions.row(1))}, c.options.weights->handle};
  const Eigen::VectorXd b = assemble(vertices, c.rest, quadratics, c.bonds, {handles});
  return 2 * (vertices.system.times(flat(c.positions)) - b);
}

Eigen::VectorXd vertex_gradient_of_term(Weigh weigh) {
  ReshapeWeights weights = no_weights();
  const Eigen::VectorXd transform_alone = vertex_gradient(Case(weights));
  weigh(weights);
  return vertex_gradient(Case(weights)) - transform_alone;
}

void expect_vertex_term(Weigh weigh, LocalTerm term) {
  ReshapeWeights weights = no_weights();
  weigh(weights);
  const Case c(weights);
  expect_gradient(vertex_gradient_of_term(weigh), flat(c.positions), [&](const Eigen::VectorXd& x) {
    const auto step = cpu_backend()->transform(c.rest);
    TransformStep::EdgeQuadratics quadratics;
    step->fit_edges(c.transforms, quadratics);
    Transforms ignored;
    return term(step->fit_transforms(as_positions(x), ignored));
  });
}

TEST(VertexStepTerms, Transform) {
  const Case c(no_weights());
  expect_gradient(vertex_gradient(c), flat(c.positions), [&](const Eigen::VectorXd& x) {
    const auto step = cpu_backend()->transform(c.rest);
    TransformStep::EdgeQuadratics quadratics;
    step->fit_edges(c.transforms, quadratics);
    Transforms ignored;
    return step->fit_transforms(as_positions(x), ignored).transform;
  });
}

TEST(VertexStepTerms, Scale) {
  expect_vertex_term([](ReshapeWeights& w) { w.scale = 3; }, [](const TransformStep::Energy& e) { return e.scale; });
}

TEST(VertexStepTerms, Sphericity) {
  expect_vertex_term([](ReshapeWeights& w) { w.sphericity = 3; },
                     [](const TransformStep::Energy& e) { return e.sphericity; });
}

double target_length(const Case& c, Eigen::Index edge) {
  double total = 0;
  for (const int t : c.edges.triangles[static_cast<int>(edge)]) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> transform(c.transforms.row(t).data());
    total += (transform * c.rest.edge_vectors.row(edge).transpose()).norm();
  }
  return total / c.edges.triangles[static_cast<int>(edge)].size();
}

TEST(VertexStepTerms, Normal) {
  const Weigh weigh = [](ReshapeWeights& w) { w.normal = 3; };
  ReshapeWeights weights = no_weights();
  weigh(weights);
  const Case c(weights);
  expect_gradient(vertex_gradient_of_term(weigh), flat(c.positions), [&](const Eigen::VectorXd& x) {
    const Positions vectors = edge_vectors(as_positions(x), c.edges);
    double total = 0;
    for (Eigen::Index t = 0; t < c.rest.triangles.rows(); ++t) {
      for (int k = 0; k < 3; ++k) {
        const int e = c.rest.triangle_edges(t, k);
        const double rest_length = c.rest.edge_vectors.row(e).norm();
        const double weight = std::max(1.0, std::pow(rest_length / c.rest.mean_edge_length, 2));
        const double tilt = c.rest.normals.row(t).dot(vectors.row(e)) / target_length(c, e);
        total += 3 * weight * rest_length / c.rest.mean_edge_length * tilt * tilt;
      }
    }
    return total;
  });
}

TEST(VertexStepTerms, Straightness) {
  const Weigh weigh = [](ReshapeWeights& w) { w.straightness = 3; };
  ReshapeWeights weights = no_weights();
  weigh(weights);
  const Case c(weights);
  expect_gradient(vertex_gradient_of_term(weigh), flat(c.positions), [&](const Eigen::VectorXd& x) {
    const Positions p = as_positions(x);
    const StraightTriple& triple = c.bonds.straight.front();
    return 3 * ((p.row(triple.before) - p.row(triple.middle)) / target_length(c, triple.edge_before) -
                (p.row(triple.middle) - p.row(triple.after)) / target_length(c, triple.edge_after))
                   .squaredNorm();
  });
}

TEST(VertexStepTerms, Handle) {
  const Weigh weigh = [](ReshapeWeights& w) { w.handle = 3; };
  const Case c(no_weights());
  const Positions targets = c.positions.topRows(2);
  expect_gradient(vertex_gradient_of_term(weigh), flat(c.positions), [&](const Eigen::VectorXd& x) {
    const Positions p = as_positions(x);
    return 3 * ((p.row(3) - targets.row(0)).squaredNorm() + (p.row(5) - targets.row(1)).squaredNorm());
  });
}

/// 2 (A T - b) of the transform step.
Eigen::VectorXd transform_gradient(const Case& c) {
  const auto step = cpu_backend()->transform(c.rest);
  TransformStep::EdgeQuadratics quadratics;
  step->fit_edges(c.transforms, quadratics);
  Transforms b;
  step->fit_transforms(c.positions, b);
  return 2 * (transform_system(c.rest).times(flat(c.transforms)) - flat(b));
}

void expect_transform_term(Weigh weigh, LocalTerm term, ReshapeSolver solver = ReshapeSolver::published) {
  ReshapeWeights weights = no_weights();
  const Eigen::VectorXd transform_alone = transform_gradient(Case(weights, solver));
  weigh(weights);
  const Case c(weights, solver);
  expect_gradient(transform_gradient(c) - transform_alone, flat(c.transforms), [&](const Eigen::VectorXd& x) {
    const auto step = cpu_backend()->transform(c.rest);
    TransformStep::EdgeQuadratics quadratics;
    step->fit_edges(as_transforms(x), quadratics);
    Transforms ignored;
    return term(step->fit_transforms(c.positions, ignored));
  });
}

TEST(TransformStepTerms, Transform) {
  const Case c(no_weights());
  expect_gradient(transform_gradient(c), flat(c.transforms), [&](const Eigen::VectorXd& x) {
    const Positions vectors = edge_vectors(c.positions, c.edges);
    const Transforms transforms = as_transforms(x);
    double total = 0;
    for (Eigen::Index t = 0; t < c.rest.triangles.rows(); ++t) {
      const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> transform(transforms.row(t).data());
      for (int k = 0; k < 3; ++k) {
        const int e = c.rest.triangle_edges(t, k);
        total += (transform * c.rest.edge_vectors.row(e).transpose() - vectors.row(e).transpose()).squaredNorm() /
                 c.rest.mean_edge_length;
      }
    }
    return total;
  });
}

TEST(TransformStepTerms, Normal) {
  expect_transform_term([](ReshapeWeights& w) { w.normal = 3; },
                        [](const TransformStep::Energy& e) { return 3 * e.transform_normal; });
}

TEST(TransformStepTerms, Connect) {
  expect_transform_term([](ReshapeWeights& w) { w.connect = 3; },
                        [](const TransformStep::Energy& e) { return e.connect; });
}

TEST(TransformStepTerms, Similarity) {
  expect_transform_term([](ReshapeWeights& w) { w.similarity = 3; },
                        [](const TransformStep::Energy& e) { return e.similarity; });
}

TEST(TransformStepTerms, Sphericity) {
  expect_transform_term([](ReshapeWeights& w) { w.sphericity = 3; },
                        [](const TransformStep::Energy& e) { return e.transform_sphericity; });
}

TEST(TransformStepTerms, Regularizer) {
  expect_transform_term([](ReshapeWeights& w) { w.regularizer = 3; },
                        [](const TransformStep::Energy& e) { return e.regularizer; });
}

TEST(TransformStepTerms, NormalRegularizer) {
  expect_transform_term([](ReshapeWeights& w) { w.normal_regularizer = 3; },
                        [](const TransformStep::Energy& e) { return e.regularizer; });
}

// Scaled to the mesh's resolution, matrix and energy alike.
TEST(TransformStepTerms, OfTheSteadySolver) {
  using Energy = TransformStep::Energy;
  const std::pair<Weigh, LocalTerm> terms[] = {
      {[](ReshapeWeights& w) { w.connect = 3; }, [](const Energy& e) { return e.connect; }},
      {[](ReshapeWeights& w) { w.similarity = 3; }, [](const Energy& e) { return e.similarity; }},
      {[](ReshapeWeights& w) { w.sphericity = 3; }, [](const Energy& e) { return e.transform_sphericity; }},
      {[](ReshapeWeights& w) { w.regularizer = 3; }, [](const Energy& e) { return e.regularizer; }},
      {[](ReshapeWeights& w) { w.normal_regularizer = 3; }, [](const Energy& e) { return e.regularizer; }}};
  for (const auto& [weigh, term] : terms) expect_transform_term(weigh, term, ReshapeSolver::steady);
}

}  // namespace
}  // namespace swage
