// Steps whose device's memory is not the host's, against the reference.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "carried.h"
#include "element_pairs.h"
#include "opencl_steps.h"
#include "own_context.h"
#include "plan.h"
#include "rests.h"
#include "shapes.h"

namespace swage {
namespace {

class Apart : public testing::TestWithParam<Precision> {
 protected:
  void SetUp() override { context_ = test::context_apart_or_skip(GetParam()); }
  double tolerance() const { return GetParam() == Precision::single ? 2e-5 : 1e-12; }

  template <typename Matrix>
  void expect_near(const Matrix& matrix, const Matrix& expected) const {
    ASSERT_EQ(matrix.rows(), expected.rows());
    if (expected.size() == 0) return;
    EXPECT_LT((matrix - expected).cwiseAbs().maxCoeff(), tolerance() * expected.cwiseAbs().maxCoeff());
  }

  SharedContext context_;
};

TEST_P(Apart, TransformsAreTheReferences) {
  if (!context_) return;
  for (const auto& [name, rest] : test::rest_families()) {
    SCOPED_TRACE(name);
    const Transforms transforms =
        identities(rest.triangles.rows()) + 0.1 * Transforms::Random(rest.triangles.rows(), 9);
    const Positions positions = rest.vertices * Eigen::Vector3d(1.2, 0.9, 1.1).asDiagonal();
    const auto step = opencl_transform(context_, rest), reference = cpu_backend()->transform(rest);
    TransformStep::EdgeQuadratics quadratics, expected;
    Transforms sides, expected_sides;
    step->fit_edges(transforms, quadratics);
    reference->fit_edges(transforms, expected);
    expect_near(quadratics.blocks, expected.blocks);
    expect_near(quadratics.right_hand_sides, expected.right_hand_sides);
    expect_near(quadratics.target_lengths, expected.target_lengths);
    const TransformStep::Energy energy = step->fit_transforms(positions, sides);
    const TransformStep::Energy expected_energy = reference->fit_transforms(positions, expected_sides);
    expect_near(sides, expected_sides);
    EXPECT_NEAR(energy.transform, expected_energy.transform, tolerance() * expected_energy.transform);
    EXPECT_NEAR(energy.scale, expected_energy.scale, tolerance() * expected_energy.scale);
    EXPECT_NEAR(energy.sphericity, expected_energy.sphericity, tolerance() * expected_energy.sphericity);
  }
}

TEST_P(Apart, ProductsAreTheReferences) {
  if (!context_) return;
  for (const auto& [name, rest] : test::rest_families()) {
    SCOPED_TRACE(name);
    const Transforms transforms = Transforms::Random(rest.triangles.rows(), 9);
    Transforms product, expected;
    opencl_coupling(context_, rest)->apply(transforms, product);
    cpu_backend()->coupling(rest)->apply(transforms, expected);
    expect_near(product, expected);
  }
}

/// Where several rotations are equally good either will do: what counts is tr Sᵀ M.
void expect_as_good(const test::PairsCase& of, const Transforms& result, const Transforms& expected, double tolerance) {
  ASSERT_EQ(result.rows(), expected.rows()) << of.name;
  for (Eigen::Index i = 0; i < result.rows(); ++i) {
    const Eigen::Matrix3d M = test::covariance(of, i), S = test::matrix(result, i), best = test::matrix(expected, i);
    const double size = test::covariance_size(of, i) * best.norm();
    ASSERT_NEAR(S.cwiseProduct(M).sum(), best.cwiseProduct(M).sum(), tolerance * size) << of.name << ", element " << i;
    ASSERT_NEAR(S.determinant(), best.determinant(), 100 * tolerance * std::pow(best.norm(), 3)) << of.name;
  }
}

TEST_P(Apart, RotationsAndSimilaritiesAreAsGoodAsTheReferences) {
  if (!context_) return;
  const double loss = GetParam() == Precision::single ? 1e-5 : 1e-9;  // As steps/rotation_test.cpp.
  for (const test::PairsCase& of : test::pairs_cases()) {
    Transforms result, expected;
    opencl_rotation(context_, of.rest)->fit(of.positions, of.targets, result);
    cpu_backend()->rotation(of.rest)->fit(of.positions, of.targets, expected);
    expect_as_good(of, result, expected, loss);
    if (of.rest.normals.rows() != 0) continue;  // The scale is of the edges alone.
    opencl_similarity(context_, of.rest)->fit(of.positions, of.targets, result);
    cpu_backend()->similarity(of.rest)->fit(of.positions, of.targets, expected);
    expect_as_good(of, result, expected, 10 * loss);
  }
}

TEST_P(Apart, OnlyWhatChangesCrosses) {
  if (!context_) return;
  const TransformStep::Rest rest = test::rest_of(test::torus());
  const auto step = opencl_transform(context_, rest);
  const Transforms transforms = identities(rest.triangles.rows());
  const std::size_t before = context_->traffic().uploaded;
  TransformStep::EdgeQuadratics quadratics;
  Transforms sides;
  step->fit_edges(transforms, quadratics);
  step->fit_transforms(rest.vertices, sides);
  // In single precision with what rounding took from the positions.
  const auto size = static_cast<std::size_t>(GetParam() == Precision::single ? 4 : 8);
  const auto positions = static_cast<std::size_t>(rest.vertices.size()) * (GetParam() == Precision::single ? 2 : 1);
  EXPECT_EQ(context_->traffic().uploaded - before, size * (static_cast<std::size_t>(transforms.size()) + positions));
}

TEST_P(Apart, CarriesAsTheReference) {
  if (!context_) return;
  for (const test::GridCase& of : test::grid_cases()) {
    CarryStep::Rest rest = test::carried_rest(of.mesh);
    expect_touched(*opencl_carry(context_, rest), of);
    if (of.name == "outside") continue;  // Far outside maps have no digits left.
    const Eigen::RowVector3d corner = of.shape.corner;
    const AxisValues sizes = rest_vertices(of.shape).rowwise() - corner;
    const AxisValues grid = (sizes * Eigen::RowVector3d(2, 0.7, 1).asDiagonal()).rowwise() + corner;
    Positions carried, expected;
    opencl_carry(context_, rest)->carry(of.shape, grid, carried);
    cpu_backend()->carry(rest)->carry(of.shape, grid, expected);
    // Of the grid's own size, far from the origin no more but for what doubles have there.
    EXPECT_LT((carried - expected).cwiseAbs().maxCoeff(),
              tolerance() * of.shape.size.maxCoeff() + 1e-15 * corner.cwiseAbs().maxCoeff())
        << of.name;
  }
}

TEST_P(Apart, SlippagesAreTheReferencesFarAwayToo) {
  if (!context_) return;
  for (const double off : {0.0, 1e6}) {
    const Mesh mesh = test::transformed(test::torus(), 1e-3, {off, -off, off});
    const CarryStep::Rest rest = test::carried_rest(mesh);
    AxisValues means, expected;
    opencl_carry(context_, rest)->slippage({0, mesh.triangles.rows()}, means);
    cpu_backend()->carry(rest)->slippage({0, mesh.triangles.rows()}, expected);
    expect_near(means, expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, Apart, testing::Values(Precision::single, Precision::twice),
                         [](const auto& of) { return of.param == Precision::single ? "single" : "twice"; });

}  // namespace
}  // namespace swage
