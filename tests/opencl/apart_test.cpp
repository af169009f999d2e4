// Steps whose device's memory is not the host's, against the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

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

TEST_P(Apart, RotationsAndSimilaritiesAreTheReferences) {
  if (!context_) return;
  const Mesh mesh = test::transformed(test::torus(), 3, {100, 20, 3});
  const PairsRest rest = test::triangle_pairs(mesh);
  const Positions moved = mesh.positions.array() + 0.3 * (2 * mesh.positions.array()).sin();
  Transforms result, expected;
  opencl_rotation(context_, rest)->fit(moved, Positions(0, 3), result);
  cpu_backend()->rotation(rest)->fit(moved, Positions(0, 3), expected);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), GetParam() == Precision::single ? 1e-3 : 1e-5);
  opencl_similarity(context_, rest)->fit(moved, Positions(0, 3), result);
  cpu_backend()->similarity(rest)->fit(moved, Positions(0, 3), expected);
  EXPECT_LT((result - expected).cwiseAbs().maxCoeff(), GetParam() == Precision::single ? 1e-3 : 1e-5);
}

TEST_P(Apart, ArraysOfOtherSizesAreRefusedInAnyMemory) {
  if (!context_) return;
  const TransformStep::Rest rest = test::rest_of(test::torus());
  const Eigen::Index count = rest.triangles.rows();
  for (const SharedContext& context : {context_, test::context_or_skip(GetParam())}) {
    Transforms result;
    TransformStep::EdgeQuadratics quadratics;
    for (const Eigen::Index wrong : {Eigen::Index{0}, count - 1, count + 1}) {
      EXPECT_THROW(opencl_coupling(context, rest)->apply(identities(wrong), result), std::out_of_range);
      EXPECT_THROW(opencl_transform(context, rest)->fit_edges(identities(wrong), quadratics), std::out_of_range);
    }
    const PairsRest pairs = test::triangle_pairs(test::torus());
    const Positions few = pairs.vertices.topRows(pairs.vertices.rows() - 1);
    EXPECT_THROW(opencl_rotation(context, pairs)->fit(few, Positions(0, 3), result), std::out_of_range);
  }
}

INSTANTIATE_TEST_SUITE_P(Precisions, Apart, testing::Values(Precision::single, Precision::twice),
                         [](const auto& of) { return of.param == Precision::single ? "single" : "twice"; });

}  // namespace
}  // namespace swage
