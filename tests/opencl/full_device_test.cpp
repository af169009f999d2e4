// Steps on a device whose memory is in use: refused in words, and possible again once there is room.
#include <gtest/gtest.h>

#include "element_pairs.h"
#include "opencl_steps.h"
#include "own_context.h"
#include "rests.h"
#include "shapes.h"
#include "swage/error.h"

namespace swage {
namespace {

template <typename Make>
void expect_refused_while_full(const Make& make) {
  const auto context = test::context_or_skip();
  if (!context) return;
  auto claim = context->claim(context->device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>() - 4096);
  try {
    make(context);
    FAIL() << "a step in 4096 bytes";
  } catch (const Unavailable& refused) {
    EXPECT_NE(std::string(refused.what()).find("cpu backend"), std::string::npos) << refused.what();
  }
  claim.reset();
  EXPECT_NO_THROW(make(context));
}

TEST(FullDevice, RefusesRotations) {
  expect_refused_while_full(
      [](const SharedContext& context) { opencl_rotation(context, test::triangle_pairs(test::torus())); });
}

TEST(FullDevice, RefusesSimilarities) {
  expect_refused_while_full(
      [](const SharedContext& context) { opencl_similarity(context, test::triangle_pairs(test::torus())); });
}

TEST(FullDevice, RefusesTransforms) {
  expect_refused_while_full(
      [](const SharedContext& context) { opencl_transform(context, test::rest_of(test::torus())); });
}

TEST(FullDevice, RefusesCouplings) {
  expect_refused_while_full(
      [](const SharedContext& context) { opencl_coupling(context, test::rest_of(test::torus())); });
}

}  // namespace
}  // namespace swage
