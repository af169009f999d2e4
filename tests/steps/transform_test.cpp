// The transform step alone, in closed form where there is one.
#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "measures.h"
#include "plan.h"
#include "shapes.h"

namespace swage {
namespace {

TransformStep::Rest rest_of(const Mesh& mesh) {
  return rest_shape({}, mesh, edges_of(mesh.triangles), Curvatures::Constant(mesh.triangles.rows(), 2, 2));
}

Transforms same(const Eigen::Matrix3d& matrix, Eigen::Index count) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rows = matrix;
  return Eigen::Map<const Eigen::Matrix<double, 1, 9>>(rows.data()).replicate(count, 1);
}

TEST(TransformStep, AtRestOnlyTheEdgesPull) {
  const TransformStep::Rest rest = rest_of(test::sphere(0.5, 2));
  const auto step = cpu_backend()->transform(rest);
  TransformStep::EdgeQuadratics quadratics;
  step->fit_edges(identities(rest.triangles.rows()), quadratics);
  EXPECT_TRUE(quadratics.target_lengths.isApprox(rest.edge_vectors.rowwise().norm(), 1e-14));
  Transforms sides;
  const TransformStep::Energy energy = step->fit_transforms(rest.vertices, sides);
  for (const double term :
       {energy.transform, energy.normal, energy.scale, energy.sphericity, energy.connect, energy.similarity,
        energy.transform_normal, energy.transform_sphericity, energy.regularizer}) {
    EXPECT_NEAR(term, 0, 1e-20);
  }
}

TEST(TransformStep, TargetLengthsAreThoseOfTheTransformedEdges) {
  const TransformStep::Rest rest = rest_of(test::box({1, 1, 1}, 3));
  const Eigen::Matrix3d stretch = Eigen::Vector3d(2, 3, 0.5).asDiagonal();
  TransformStep::EdgeQuadratics quadratics;
  cpu_backend()->transform(rest)->fit_edges(same(stretch, rest.triangles.rows()), quadratics);
  const Eigen::VectorXd lengths = (rest.edge_vectors * stretch).rowwise().norm();
  EXPECT_TRUE(quadratics.target_lengths.isApprox(lengths, 1e-14));
  EXPECT_EQ(quadratics.singular, 0);
}

TEST(TransformStep, FlattenedTrianglesAreDampedCountedAndFinite) {
  TransformStep::Rest rest = rest_of(test::box({1, 1, 1}, 2));
  rest.maps_normals = false;
  const auto step = cpu_backend()->transform(rest);
  for (const Eigen::Vector3d& scale : {Eigen::Vector3d(1, 1, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 0),
                                       Eigen::Vector3d(1, 1, 1e-12), Eigen::Vector3d(1e-200, 1, 1)}) {
    TransformStep::EdgeQuadratics quadratics;
    step->fit_edges(same(scale.asDiagonal(), rest.triangles.rows()), quadratics);
    EXPECT_EQ(quadratics.singular, rest.triangles.rows());
    EXPECT_TRUE(quadratics.blocks.allFinite() && quadratics.right_hand_sides.allFinite());
  }
}

TEST(TransformStep, WithMappedNormalsATransformThatFlattensAlongItsNormalIsNotSingular) {
  const TransformStep::Rest rest = rest_of(test::box({1, 1, 1}, 2));
  TransformStep::EdgeQuadratics quadratics;
  cpu_backend()->transform(rest)->fit_edges(
      same(Eigen::Vector3d(1, 1, 0).asDiagonal().toDenseMatrix(), rest.triangles.rows()), quadratics);
  EXPECT_EQ(quadratics.singular, rest.triangles.rows() * 2 / 3);  // But not the two sides normal to z.
  EXPECT_TRUE(quadratics.blocks.allFinite() && quadratics.right_hand_sides.allFinite());
}

TEST(TransformStep, ASmallTransformIsNotASingularOne) {
  const TransformStep::Rest rest = rest_of(test::box({1, 1, 1}, 2));
  TransformStep::EdgeQuadratics quadratics;
  cpu_backend()->transform(rest)->fit_edges(same(1e-6 * Eigen::Matrix3d::Identity(), rest.triangles.rows()),
                                            quadratics);
  EXPECT_EQ(quadratics.singular, 0);
}

// Where a transform takes the normal says nothing of how the surface stretches.
TEST(TransformStep, WithMappedNormalsTheirImagesDoNotMatter) {
  TransformStep::Rest rest = rest_of(test::sphere(0.5, 2));
  ASSERT_TRUE(rest.maps_normals);
  Transforms skewed = same(2 * Eigen::Matrix3d::Identity(), rest.triangles.rows());
  for (Eigen::Index t = 0; t < skewed.rows(); ++t) {
    const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> more = Eigen::Vector3d(0.3, -5, 1) * rest.normals.row(t);
    skewed.row(t) += Eigen::Map<const Eigen::Matrix<double, 1, 9>>(more.data());
  }
  TransformStep::EdgeQuadratics plain, same_stretch;
  const auto step = cpu_backend()->transform(rest);
  step->fit_edges(same(2 * Eigen::Matrix3d::Identity(), rest.triangles.rows()), plain);
  step->fit_edges(skewed, same_stretch);
  EXPECT_LT((plain.blocks - same_stretch.blocks).norm(), 1e-12 * plain.blocks.norm());
  EXPECT_LT((plain.right_hand_sides - same_stretch.right_hand_sides).norm(), 1e-12 * plain.right_hand_sides.norm());
  rest.maps_normals = false;
  cpu_backend()->transform(rest)->fit_edges(skewed, same_stretch);
  EXPECT_GT((plain.blocks - same_stretch.blocks).norm(), 0.01 * plain.blocks.norm());
}

// Stretched just as the transforms say, edges have the same weights by either rule; but those of targets wait for no
// positions, and no positions change them.
TEST(TransformStep, WeightsOfTargetLengthsAreThoseOfEdgesThatReachedThem) {
  TransformStep::Rest rest = rest_of(test::box({1, 2, 0.5}, 3));
  ASSERT_TRUE(rest.weighs_targets);
  const Eigen::Matrix3d stretch = Eigen::Vector3d(2, 3, 1.5).asDiagonal();
  const Transforms transforms = same(stretch, rest.triangles.rows());
  const Positions stretched = rest.vertices * stretch;
  const auto by_targets = cpu_backend()->transform(rest);
  rest.weighs_targets = false;
  const auto by_lengths = cpu_backend()->transform(rest);
  TransformStep::EdgeQuadratics targets, lengths;
  Transforms sides;
  by_lengths->fit_edges(transforms, lengths);
  by_targets->fit_edges(transforms, targets);
  EXPECT_GT((targets.blocks - lengths.blocks).norm(), 0.1 * lengths.blocks.norm());

  by_lengths->fit_transforms(stretched, sides);
  by_lengths->fit_edges(transforms, lengths);
  EXPECT_LT((targets.blocks - lengths.blocks).norm(), 1e-12 * lengths.blocks.norm());
  EXPECT_LT((targets.right_hand_sides - lengths.right_hand_sides).norm(), 1e-12 * lengths.right_hand_sides.norm());
  const double energy = by_lengths->fit_transforms(5 * stretched, sides).transform;
  EXPECT_NEAR(by_targets->fit_transforms(5 * stretched, sides).transform, energy, 1e-12 * energy);
  by_targets->fit_edges(transforms, lengths);
  EXPECT_EQ(lengths.blocks, targets.blocks);
}

TEST(TransformStep, NoTrianglesGiveNothing) {
  const TransformStep::Rest rest = rest_of({Positions::Zero(1, 3), Triangles(0, 3)});
  const auto step = cpu_backend()->transform(rest);
  TransformStep::EdgeQuadratics quadratics;
  step->fit_edges(Transforms(0, 9), quadratics);
  EXPECT_EQ(quadratics.blocks.rows(), 0);
  Transforms sides;
  EXPECT_EQ(step->fit_transforms(rest.vertices, sides).transform, 0);
}

#ifdef _OPENMP
TEST(TransformStep, SumsDoNotDependOnTheThreads) {
  const TransformStep::Rest rest = rest_of(test::sphere(0.5, 6));  // 82 k triangles: worth threads.
  auto energies = [&](int threads) {
    omp_set_num_threads(threads);
    const auto step = cpu_backend()->transform(rest);
    TransformStep::EdgeQuadratics quadratics;
    step->fit_edges(identities(rest.triangles.rows()) * 1.1, quadratics);
    Transforms sides;
    const TransformStep::Energy e = step->fit_transforms(rest.vertices.array().sin().matrix(), sides);
    return std::array{e.transform, e.normal, e.scale, e.sphericity, e.connect, e.similarity, e.regularizer};
  };
  const int threads = omp_get_max_threads();
  const auto alone = energies(1);
  EXPECT_EQ(energies(2), alone);
  EXPECT_EQ(energies(5), alone);
  omp_set_num_threads(threads);
}
#endif

}  // namespace
}  // namespace swage
