#include "multilevel.h"

#include <gtest/gtest.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <chrono>

#include "element_graphs.h"
#include "plan.h"
#include "rests.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

Eigen::VectorXd waves(Eigen::Index size) {
  return Eigen::VectorXd::NullaryExpr(size, [](Eigen::Index i) { return std::sin(0.3 * static_cast<double>(i)); });
}

/// As the header's sum reads.
Eigen::VectorXd product_with(const ElementGraph& graph, const Eigen::VectorXd& x) {
  const int width = 3 * graph.rows;
  Eigen::VectorXd result(x.size());
  for (Eigen::Index t = 0; t < graph.own.rows(); ++t) {
    Eigen::MatrixXd own(width, width);
    for (int i = 0, k = 0; i < width; ++i) {
      for (int j = 0; j <= i; ++j) own(i, j) = own(j, i) = static_cast<double>(graph.own(t, k++));
    }
    result.segment(t * width, width) = own * x.segment(t * width, width);
  }
  for (size_t p = 0; p < graph.pairs.size(); ++p) {
    const Eigen::Matrix<double, 1, 6> c = graph.couplings.row(static_cast<Eigen::Index>(p)).cast<double>();
    const Eigen::Matrix3d coupling{{c[0], c[1], c[2]}, {c[1], c[3], c[4]}, {c[2], c[4], c[5]}};
    const auto [i, j] = graph.pairs[p];
    for (int r = 0; r < width; r += 3) {
      const Eigen::Vector3d pull = coupling * (x.segment<3>(i * width + r) - x.segment<3>(j * width + r));
      result.segment<3>(i * width + r) += pull;
      result.segment<3>(j * width + r) -= pull;
    }
  }
  return result;
}

TransformStep::Rest steady_rest(const Mesh& mesh, double curvature) {
  return test::rest_of(mesh, curvature, ReshapeSolver::steady);
}

struct Pull {
  TransformStep::EdgeQuadratics quadratics;
  std::vector<Holds> holds;
};

/// Of a vertex step under way.
Pull pull_of(const TransformStep::Rest& rest) {
  Pull pull;
  Transforms transforms = identities(rest.triangles.rows());
  transforms.col(0).array() += 0.5;
  cpu_backend()->transform(rest)->fit_edges(transforms, pull.quadratics);
  pull.holds = {{{Hold::at(0, rest.vertices.row(0)), Hold::at(5, rest.vertices.row(1))}, 1e5}};
  return pull;
}

ElementGraph vertex_graph_of(const TransformStep::Rest& rest) {
  const Pull pull = pull_of(rest);
  return vertex_graph(rest, pull.quadratics, {}, pull.holds);
}

TEST(ElementGraphs, OfTheTransformStepIsItsMatrix) {
  for (const double curvature : {0.0, 2.0}) {  // Without sphericity and with.
    const TransformStep::Rest rest = steady_rest(test::torus(), curvature);
    const Eigen::VectorXd x = waves(9 * rest.triangles.rows()), expected = transform_system(rest).times(x);
    EXPECT_LT((product_with(transform_graph(rest), x) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST(ElementGraphs, OfTheVertexStepIsItsMatrixButForAnUpperBoundOnSphericity) {
  for (const double curvature : {0.0, 2.0}) {
    const TransformStep::Rest rest = steady_rest(test::torus(), curvature);
    const Pull pull = pull_of(rest);
    VertexSystem vertices = vertex_system(rest, {}, FactorKind::none);
    assemble(vertices, rest, pull.quadratics, {}, pull.holds);
    const ElementGraph graph = vertex_graph(rest, pull.quadratics, {}, pull.holds);
    const Eigen::VectorXd x = waves(rest.vertices.size()), exact = vertices.system.times(x),
                          bound = product_with(graph, x);
    if (curvature == 0) {
      EXPECT_LT((bound - exact).norm(), 1e-6 * exact.norm());
    }
    EXPECT_GE(x.dot(bound), (1 - 1e-6) * x.dot(exact));
  }
}

Eigen::VectorXd solved(const Multilevel& multilevel, const Eigen::VectorXd& side, double tolerance) {
  Eigen::VectorXd solution;
  EXPECT_TRUE(multilevel.solve(side, tolerance, 200, solution).converged);
  return solution;
}

/// What is left of the error, in the matrix's norm.
double left_by(const ElementGraph& graph, double tolerance) {
  const Multilevel multilevel(graph);
  const Eigen::VectorXd solution = waves(graph.own.rows() * 3 * graph.rows);
  const Eigen::VectorXd error = solved(multilevel, product_with(graph, solution), tolerance) - solution;
  return std::sqrt(error.dot(product_with(graph, error)) / solution.dot(product_with(graph, solution)));
}

TEST(Multilevel, SolvesToTheTolerance) {
  const TransformStep::Rest rest = steady_rest(test::sphere(0.5, 4), 2);
  for (const double tolerance : {1e-1, 1e-3}) {
    EXPECT_LT(left_by(transform_graph(rest), tolerance), 3 * tolerance);
    EXPECT_LT(left_by(vertex_graph_of(rest), tolerance), 3 * tolerance);
  }
}

TEST(Multilevel, FewElementsAreSolvedAtOnce) {
  const TransformStep::Rest rest = steady_rest(test::box(), 0);
  const ElementGraph graph = transform_graph(rest);
  ASSERT_LE(graph.own.rows(), 300);
  EXPECT_EQ(Multilevel(graph).levels(), 1);
  EXPECT_LT(left_by(graph, 1e-3), 1e-6);
}

TEST(Multilevel, IterationsHardlyGrowWithTheMesh) {
  std::vector<int> iterations;
  for (const int subdivisions : {4, 6}) {  // 16 times as many.
    const TransformStep::Rest rest = steady_rest(test::sphere(0.5, subdivisions), 2);
    const ElementGraph graph = transform_graph(rest);
    const Eigen::VectorXd side = product_with(graph, waves(9 * rest.triangles.rows()));
    Eigen::VectorXd solution = Eigen::VectorXd::Zero(side.size());
    const Gradients done = Multilevel(graph).improve(
        [&](const Eigen::VectorXd& x, Eigen::VectorXd& y) { y = product_with(graph, x); }, side, 1e-4, 100, solution);
    EXPECT_TRUE(done.converged);
    iterations.push_back(done.iterations);
  }
  EXPECT_LE(iterations[1], iterations[0] + 5);
  EXPECT_LE(iterations[1], 20);
}

TEST(Multilevel, RefilledItIsAsMadeForTheNewValues) {
  const TransformStep::Rest rest = steady_rest(test::sphere(0.5, 4), 2);
  const ElementGraph first = vertex_graph_of(rest);
  ElementGraph second = first;
  second.couplings *= 2;  // Mergers stay the same.
  second.own *= 3;
  Multilevel refilled(first);
  refilled.refill(second);
  const Eigen::VectorXd side = waves(rest.vertices.size());
  EXPECT_EQ(solved(refilled, side, 1e-3), solved(Multilevel(second), side, 1e-3));
  refilled.refill(first);
  EXPECT_EQ(solved(refilled, side, 1e-3), solved(Multilevel(first), side, 1e-3));
}

TEST(Multilevel, TakesRepeatedPairsPairsOfOneAndElementsWithoutAny) {
  ElementGraph graph;
  graph.rows = 1;
  constexpr int kCount = 1000;
  for (int i = 0; i + 1 < kCount / 2; ++i) {
    graph.pairs.emplace_back(i, i + 1);
    graph.pairs.emplace_back(i + 1, i);
    graph.pairs.emplace_back(i, i);
  }
  graph.couplings.setZero(static_cast<Eigen::Index>(graph.pairs.size()), 6);
  for (const int diagonal : {0, 3, 5}) graph.couplings.col(diagonal).setOnes();
  graph.own.setZero(kCount, 6);
  for (const int diagonal : {0, 2, 5}) graph.own.col(diagonal).setConstant(0.01F);
  EXPECT_LT(left_by(graph, 1e-3), 3e-3);
}

#ifdef _OPENMP
TEST(Multilevel, GivesTheSameBytesWithAnyThreads) {
  const ElementGraph graph = transform_graph(steady_rest(test::sphere(0.5, 5), 2));
  const Eigen::VectorXd side = waves(9 * graph.own.rows());
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Eigen::VectorXd alone = solved(Multilevel(graph), side, 1e-3);
  omp_set_num_threads(3);
  EXPECT_EQ(solved(Multilevel(graph), side, 1e-3), alone);
  omp_set_num_threads(threads);
}
#endif

TEST(Multilevel, PollsWhileItIsMadeAndWhileItSolves) {
  const ElementGraph graph = transform_graph(steady_rest(test::sphere(0.5, 4), 2));
  const Poll cancel = [] { throw Cancelled(); };
  EXPECT_THROW(Multilevel(graph, cancel), Cancelled);
  Eigen::VectorXd solution;
  EXPECT_THROW(Multilevel(graph).solve(waves(9 * graph.own.rows()), 1e-3, 50, solution, cancel), Cancelled);
}

// Straight chains are none of its terms, and stiff.
TEST(VertexStep, WhereMultigridFailsAFactorIsMade) {
  const Mesh mesh = test::sheet(60);
  const TransformStep::Rest rest = steady_rest(mesh, 0);
  std::vector<int> chain(50);
  for (int i = 0; i < 50; ++i) chain[static_cast<size_t>(i)] = i + 3;
  const Edges edges = edges_of(mesh.triangles);
  const Bonds bonds{straight_triples({chain}, edges), 1e9};
  Pull pull = pull_of(rest);
  pull.holds[0].points[0].target[2] += 0.3;
  VertexSystem exact = vertex_system(rest, bonds, FactorKind::simplicial);
  VertexSystem loose = vertex_system(rest, bonds, FactorKind::none);
  const Positions expected = place_vertices(exact, rest, pull.quadratics, bonds, pull.holds, rest.vertices);
  const Positions found = place_vertices(loose, rest, pull.quadratics, bonds, pull.holds, rest.vertices);
  EXPECT_TRUE(loose.system.has_factor());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-6);
}

}  // namespace
}  // namespace swage
