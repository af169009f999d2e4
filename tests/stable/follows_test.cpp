// Results go with the mesh's unit, place and order.
#include <gtest/gtest.h>

#include <algorithm>

#include "cases.h"
#include "opencl_device.h"
#include "samples.h"
#include "shapes.h"
#include "stylized.h"
#include "swage/stylize.h"

namespace swage::test {
namespace {

class Follows : public testing::TestWithParam<Case> {};

constexpr double kRounded = 1e-3;  // Of D: where the mesh itself is rounded to single precision.

void expect_follows(const Case& of, const std::shared_ptr<Backend>& backend) {
  if (!backend) return;
  const bool is_single = backend->precision() == Precision::single;
  const Positions plain = of.solved(backend);
  for (const Writing& other : other_writings()) {
    const Positions result = of.solve(Written(of.mesh, other), backend);
    double tolerance = other.offset == 0 ? of.follows : of.far;
    if (is_single) tolerance = std::max({tolerance, of.single, sees_rounded(*backend) ? kRounded : 0.0});
    EXPECT_LT(apart(of, plain, result), tolerance) << other.name;
  }
}

TEST_P(Follows, OnTheReference) { expect_follows(GetParam(), cpu_backend()); }
TEST_P(Follows, OnADeviceInDouble) { expect_follows(GetParam(), opencl_or_skip(Precision::twice)); }
TEST_P(Follows, OnADeviceInSingle) { expect_follows(GetParam(), opencl_or_skip(Precision::single)); }

INSTANTIATE_TEST_SUITE_P(Of, Follows, testing::ValuesIn(cases()), name_of);

/// But for its place: a corner of the first triangle is what stays in it.
TEST(StylizeFollows, WithoutHandles) {
  const Mesh mesh = askew(torus(1, 0.4, 16, 8));
  StylizeOptions options;
  options.pass_limit = 2000;
  options.movement = 1e-10;
  const auto solved = [&](const Written& written) {
    const Mesh& of = written.mesh();
    const Positions result = written.back(stylize(of.positions, of.triangles, cube_normals(), 1, options).positions);
    return Positions(result.rowwise() - result.colwise().mean());
  };
  EXPECT_LT(far_apart(solved(Written(mesh)), solved(Written(mesh, {"shuffled", 1, 0, 3}))), 1e-6);
}

/// The points at which a template is compared with a mesh.
TEST(SurfaceSamples, FollowTheOrder) {
  const Mesh mesh = torus(1, 0.4, 16, 8);
  const Mesh shuffled = Written(mesh, {"shuffled", 1, 0, 3}).mesh();
  EXPECT_LT(far_apart(surface_samples(mesh, 500, 1), surface_samples(shuffled, 500, 1)), 1e-12);
}

}  // namespace
}  // namespace swage::test
