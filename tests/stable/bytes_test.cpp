// The same bytes again and again.
#include <gtest/gtest.h>
#include <omp.h>

#include "cases.h"
#include "opencl_device.h"

namespace swage::test {
namespace {

constexpr int kRuns = 20;

class Bytes : public testing::TestWithParam<Case> {};

TEST_P(Bytes, AreTheSameOnOneThreadAndTwo) {
  const Case& of = GetParam();
  const int threads = omp_get_max_threads();
  const Positions first = of.solved();
  for (int run = 1; run < kRuns; ++run) {
    omp_set_num_threads(1 + run % 2);
    ASSERT_EQ(of.solved(), first) << "run " << run;
  }
  omp_set_num_threads(threads);
}

TEST_P(Bytes, AreTheSameOnADevice) {
  const std::shared_ptr<Backend> backend = opencl_or_skip();
  if (!backend) return;
  const Case& of = GetParam();
  const Positions first = of.solved(backend);
  for (int run = 1; run < kRuns; ++run) ASSERT_EQ(of.solved(backend), first) << "run " << run;
}

INSTANTIATE_TEST_SUITE_P(Of, Bytes, testing::ValuesIn(cases()), name_of);

}  // namespace
}  // namespace swage::test
