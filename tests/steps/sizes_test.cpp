// Matrices of other sizes than the rest shape's are refused in words, by every backend.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "element_pairs.h"
#include "opencl_device.h"
#include "plan.h"
#include "rests.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

using testing::HasSubstr;

class Sizes : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { backend_ = GetParam() == std::string("cpu") ? cpu_backend() : test::opencl_or_skip(); }
  std::shared_ptr<Backend> backend_;
};

template <typename Call>
void expect_refused(const std::string& words, const Call& call) {
  try {
    call();
    ADD_FAILURE() << "taken: " << words;
  } catch (const InvalidInput& refused) {
    EXPECT_THAT(refused.what(), HasSubstr(words));
  }
}

TEST_P(Sizes, OfTransformsAndPositions) {
  if (!backend_) return;
  const TransformStep::Rest rest = test::rest_of(test::torus());
  const Eigen::Index triangles = rest.triangles.rows(), vertices = rest.vertices.rows();
  const auto transform = backend_->transform(rest);
  const auto coupling = backend_->coupling(rest);
  TransformStep::EdgeQuadratics quadratics;
  Transforms result;
  for (const int off : {-1, 1}) {
    expect_refused("TransformStep::fit_edges: transforms: ",
                   [&] { transform->fit_edges(identities(triangles + off), quadratics); });
    expect_refused("TransformStep::fit_transforms: positions: ",
                   [&] { transform->fit_transforms(Positions::Zero(vertices + off, 3), result); });
    expect_refused("CouplingStep::apply: transforms: ", [&] { coupling->apply(identities(triangles + off), result); });
  }
}

TEST_P(Sizes, OfPairsAndNormals) {
  if (!backend_) return;
  const PairsRest rest = test::with_normals(test::triangle_pairs(test::torus()));
  const Positions few = rest.vertices.topRows(rest.vertices.rows() - 1);
  const auto rotation = backend_->rotation(rest);
  const auto similarity = backend_->similarity(rest);
  Transforms result;
  expect_refused("RotationStep::fit: positions: ", [&] { rotation->fit(few, rest.normals, result); });
  expect_refused("RotationStep::fit: targets: 0 rows", [&] { rotation->fit(rest.vertices, Positions(0, 3), result); });
  expect_refused("SimilarityStep::fit: positions: ", [&] { similarity->fit(few, rest.normals, result); });
  expect_refused("SimilarityStep::fit: targets: 0 rows",
                 [&] { similarity->fit(rest.vertices, Positions(0, 3), result); });
}

INSTANTIATE_TEST_SUITE_P(Backends, Sizes, testing::Values("cpu", "opencl"),
                         [](const auto& of) { return std::string(of.param); });

}  // namespace
}  // namespace swage
