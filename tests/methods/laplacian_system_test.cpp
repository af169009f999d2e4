// The vertices' system of local-global methods: its solutions solve it.
#include "laplacian_system.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <Eigen/Dense>

#include "flat.h"
#include "shapes.h"
#include "spokes_and_rims.h"

namespace swage::test {
namespace {

LaplacianSystem system_of(const Mesh& mesh) {
  return LaplacianSystem(vertex_elements(mesh, flat_triangles(mesh.positions, mesh.triangles)).pairs);
}

HeldPoints held(const Mesh& mesh, const std::vector<int>& fixed) {
  HeldPoints points;
  points.fixed = fixed;
  points.fixed_targets = 2 * mesh.positions(fixed, Eigen::all);
  return points;
}

TEST(LaplacianSystem, EqualsADenseSolveWithFixedAndSoftPoints) {
  const Mesh mesh = torus(1, 0.4, 12, 8);
  const LaplacianSystem system = system_of(mesh);
  HeldPoints points = held(mesh, {0, 7, 40});
  points.soft = {{{3, 4, 5}, {0.5, 0.2, 0.3}, 2.5}, {{60, 60, 60}, {1, 0, 0}, 10}};
  points.soft_targets = (Positions(2, 3) << 1, 2, 3, -1, 0, 1).finished();
  const Positions sides = (3 * mesh.positions).array().sin();
  const Positions solution = HeldLaplacian(system, points).solve(sides, points);

  // sum of w (f · x - target)² and the quadratic of the laplacian are stationary in what is free.
  Eigen::MatrixXd matrix = system.laplacian();
  Eigen::MatrixXd right = sides;
  for (size_t i = 0; i < points.soft.size(); ++i) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(matrix.rows());
    for (int k = 0; k < 3; ++k) row[points.soft[i].vertices[static_cast<size_t>(k)]] += points.soft[i].factors[k];
    matrix += points.soft[i].weight * row * row.transpose();
    right += points.soft[i].weight * row * points.soft_targets.row(static_cast<Eigen::Index>(i));
  }
  for (size_t i = 0; i < points.fixed.size(); ++i) {
    matrix.row(points.fixed[i]).setZero();
    matrix(points.fixed[i], points.fixed[i]) = 1;
    right.row(points.fixed[i]) = points.fixed_targets.row(static_cast<Eigen::Index>(i));
  }
  EXPECT_LT((solution - matrix.partialPivLu().solve(right)).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(LaplacianSystem, OfManyVerticesIsSolvedToRoundingByAnyNumberOfThreads) {
  const Mesh mesh = torus(1, 0.4, 240, 160);
  const LaplacianSystem system = system_of(mesh);
  const HeldPoints points = held(mesh, {0, 9000});
  const HeldLaplacian factored(system, points);
  const Positions sides = 1e-4 * (3 * mesh.positions).array().sin();
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const Positions solution = factored.solve(sides, points);
  omp_set_num_threads(3);
  EXPECT_EQ(solution, factored.solve(sides, points));
  omp_set_num_threads(threads);
  Positions residual = system.laplacian() * solution - sides;
  residual(points.fixed, Eigen::all) = solution(points.fixed, Eigen::all) - points.fixed_targets;
  EXPECT_LT(residual.cwiseAbs().maxCoeff(), 1e-12 * solution.cwiseAbs().maxCoeff() * 8);
}

}  // namespace
}  // namespace swage::test
