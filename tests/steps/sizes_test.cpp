// Matrices of other sizes than the rest shape's are refused in words, by every backend.
#include <gtest/gtest.h>

#include "element_pairs.h"
#include "opencl_device.h"
#include "plan.h"
#include "refused.h"
#include "rests.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

class Sizes : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { backend_ = GetParam() == std::string("cpu") ? cpu_backend() : test::opencl_or_skip(); }
  std::shared_ptr<Backend> backend_;
};

TEST_P(Sizes, OfTransformsAndPositions) {
  if (!backend_) return;
  const TransformStep::Rest rest = test::rest_of(test::torus());
  const Eigen::Index triangles = rest.triangles.rows(), vertices = rest.vertices.rows();
  const auto transform = backend_->transform(rest);
  const auto coupling = backend_->coupling(rest);
  TransformStep::EdgeQuadratics quadratics;
  Transforms result;
  for (const int off : {-1, 1}) {
    test::expect_refused([&] { transform->fit_edges(identities(triangles + off), quadratics); },
                         "TransformStep::fit_edges: transforms: ");
    test::expect_refused([&] { transform->fit_transforms(Positions::Zero(vertices + off, 3), result); },
                         "TransformStep::fit_transforms: positions: ");
    test::expect_refused([&] { coupling->apply(identities(triangles + off), result); },
                         "CouplingStep::apply: transforms: ");
  }
}

TEST_P(Sizes, OfPairsAndNormals) {
  if (!backend_) return;
  const PairsRest rest = test::with_normals(test::triangle_pairs(test::torus()));
  const Positions few = rest.vertices.topRows(rest.vertices.rows() - 1);
  const auto rotation = backend_->rotation(rest);
  const auto similarity = backend_->similarity(rest);
  Transforms result;
  test::expect_refused([&] { rotation->fit(few, rest.normals, result); }, "RotationStep::fit: positions: ");
  test::expect_refused([&] { rotation->fit(rest.vertices, Positions(0, 3), result); },
                       "RotationStep::fit: targets: 0 rows");
  test::expect_refused([&] { similarity->fit(few, rest.normals, result); }, "SimilarityStep::fit: positions: ");
  test::expect_refused([&] { similarity->fit(rest.vertices, Positions(0, 3), result); },
                       "SimilarityStep::fit: targets: 0 rows");
}

INSTANTIATE_TEST_SUITE_P(Backends, Sizes, testing::Values("cpu", "opencl"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace swage
