// Arrays cross to the device and back unharmed, in both layouts and precisions, and every byte is counted.
#include "buffer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "own_context.h"
#include "swage/error.h"

namespace swage {
namespace {

using test::context_or_skip;
using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

class BufferTest : public testing::TestWithParam<Precision> {
 protected:
  void SetUp() override { context_ = context_or_skip(GetParam()); }
  std::size_t real_bytes() const { return GetParam() == Precision::single ? 4 : 8; }
  /// What the device can hold of a number.
  Rows3 rounded(const Rows3& values) const {
    return GetParam() == Precision::single ? Rows3(values.cast<float>().cast<double>()) : values;
  }

  std::shared_ptr<Context> context_;
};

TEST_P(BufferTest, MatricesComeBackRoundedAndNoMore) {
  const Queue queue(context_);
  for (const Eigen::Index count : {1, 255, 256, 257, 100003}) {
    const Rows3 values = Rows3::Random(count, 3);
    for (const Layout layout : {Layout::rows, Layout::columns}) {
      const Reals there(queue, values, layout);
      Rows3 back(count, 3);
      there.download(back, layout);
      EXPECT_EQ(back, rounded(values)) << count;
    }
  }
}

TEST_P(BufferTest, ColumnsStandOneAfterTheOther) {
  const Queue queue(context_);
  const Rows3 values = Rows3::Random(1000, 3);
  const Reals there(queue, values, Layout::columns);
  Eigen::VectorXd flat(3000);
  there.download(flat);
  EXPECT_EQ(flat[1], rounded(values)(1, 0));
  EXPECT_EQ(flat[2 * 1000 + 7], rounded(values)(7, 2));
}

TEST_P(BufferTest, RowsStandOneAfterTheOther) {
  const Queue queue(context_);
  const Rows3 values = Rows3::Random(1000, 3);
  const Reals there(queue, values, Layout::rows);
  Eigen::VectorXd flat(3000);
  there.download(flat);
  EXPECT_EQ(flat[7 * 3 + 2], rounded(values)(7, 2));
}

TEST_P(BufferTest, ExpressionsGoUp) {
  const Queue queue(context_);
  const Rows3 values = Rows3::Random(700, 3);
  const Eigen::RowVector3d centre(1, 2, 3);
  const Reals there(queue, (values.rowwise() - centre) * 2);
  Rows3 back(700, 3);
  there.download(back);
  EXPECT_EQ(back, rounded((values.rowwise() - centre) * 2));
}

TEST_P(BufferTest, IntegersComeBack) {
  const Queue queue(context_);
  const Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> values =
      Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>::Random(5000, 2);
  const Ints there(queue, values);
  Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor> back(5000, 2);
  there.download(back);
  EXPECT_EQ(back, values);
}

TEST_P(BufferTest, EveryByteIsCounted) {
  const Queue queue(context_);
  Reals reals(queue, 300);
  EXPECT_EQ(context_->traffic().uploaded, 0);
  reals.upload(Rows3::Zero(100, 3));
  reals.upload(Rows3::Zero(50, 3));
  const Ints ints(queue, Eigen::VectorXi::Zero(17));
  Eigen::VectorXd back(20);
  reals.download(back);
  EXPECT_EQ(context_->traffic().uploaded, 450 * real_bytes() + 17 * 4);
  EXPECT_EQ(context_->traffic().downloaded, 20 * real_bytes());
}

TEST_P(BufferTest, NothingIsAllowed) {
  const Queue queue(context_);
  Reals none(queue, Rows3(0, 3));
  Rows3 back(0, 3);
  none.download(back);
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(context_->traffic().uploaded, 0);
}

TEST_P(BufferTest, BeyondTheEndIsRefused) {
  const Queue queue(context_);
  Reals reals(queue, 10);
  EXPECT_THROW(reals.upload(Eigen::VectorXd::Zero(11)), std::out_of_range);
  Eigen::VectorXd back(11);
  EXPECT_THROW(reals.download(back), std::out_of_range);
}

TEST_P(BufferTest, MoreThanTheDeviceHoldsIsRefusedInWords) {
  const Queue queue(context_);
  const auto largest = context_->device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  try {
    const Reals reals(queue, static_cast<Eigen::Index>(largest / real_bytes() + 1));
    FAIL() << "an array above the largest";
  } catch (const Unavailable& refused) {
    EXPECT_NE(std::string(refused.what()).find("cpu backend"), std::string::npos) << refused.what();
  }
}

// Nothing is written to these arrays, so that they cost no memory.
TEST_P(BufferTest, MoreThanTheDeviceHoldsInAllIsRefusedInWords) {
  const Queue queue(context_);
  const auto largest = context_->device().getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  const auto memory = context_->device().getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  const auto many = static_cast<Eigen::Index>(std::min<std::size_t>(largest, 1 << 30) / real_bytes());
  std::vector<Reals> held;
  std::string words;
  for (std::size_t sum = 0; sum <= 2 * memory && words.empty(); sum += static_cast<std::size_t>(many) * real_bytes()) {
    try {
      held.emplace_back(queue, many);
    } catch (const Unavailable& refused) {
      words = refused.what();
    }
  }
  EXPECT_NE(words.find("are in use"), std::string::npos) << words;
  EXPECT_LE(held.size() * static_cast<std::size_t>(many) * real_bytes(), memory);
  EXPECT_GT((held.size() + 1) * static_cast<std::size_t>(many) * real_bytes(), memory);
  held.pop_back();
  EXPECT_NO_THROW(held.emplace_back(queue, many));
}

TEST_P(BufferTest, MoreThanIntCountsIsRefused) {
  const Queue queue(context_);
  EXPECT_THROW(Reals(queue, Eigen::Index{1} << 31), Unavailable);
}

INSTANTIATE_TEST_SUITE_P(Precisions, BufferTest, testing::Values(Precision::single, Precision::twice),
                         [](const auto& of) { return of.param == Precision::single ? "single" : "twice"; });

}  // namespace
}  // namespace swage
