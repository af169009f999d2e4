// Kernels build, run over exactly their elements, and are explained where they do not build.
#include "kernel.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "own_context.h"
#include "swage/backend.h"
#include "swage/error.h"

namespace swage {
namespace {

using test::context_or_skip;

constexpr const char* kScale = R"(
kernel void scale(const int count, global const scalar* from, const scalar factor, const int add, global scalar* to) {
  const int i = (int)get_global_id(0);
  if (i >= count) return;
  to[i] = factor * from[i] + add;
}
)";

constexpr const char* kCount = R"(
kernel void count_up(const int count, global int* visits) {
  const int i = (int)get_global_id(0);
  if (i >= count) return;
  visits[i] += 1;
}
)";

class KernelTest : public testing::TestWithParam<Precision> {
 protected:
  void SetUp() override { context_ = context_or_skip(GetParam()); }
  std::shared_ptr<Context> context_;
};

TEST_P(KernelTest, TakesItsArguments) {
  const Queue queue(context_);
  Kernel scale(queue, context_->program("scale.cl", kScale), "scale");
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(1001, 0, 1000);
  const Reals from(queue, values);
  Reals to(queue, 1001);
  scale.launch(1001, from, 0.5, 3, to);
  Eigen::VectorXd back(1001);
  to.download(back);
  EXPECT_EQ(back, (values * 0.5).array().operator+(3).matrix());
}

TEST_P(KernelTest, VisitsEachElementOnce) {
  const Queue queue(context_);
  Kernel count_up(queue, context_->program("count.cl", kCount), "count_up");
  for (const int count : {0, 1, 63, 64, 65, 1000003}) {
    const Ints visits(queue, Eigen::VectorXi::Zero(count + 100));
    count_up.launch(count, visits);
    Eigen::VectorXi back(count + 100);
    visits.download(back);
    EXPECT_EQ(back.head(count), Eigen::VectorXi::Ones(count)) << count;
    EXPECT_EQ(back.tail(100), Eigen::VectorXi::Zero(100)) << count;
  }
}

TEST_P(KernelTest, TheLogNamesFileAndLine) {
  try {
    context_->program("broken.cl", "\n\nkernel void broken(global scalar* x) { x[0] = nowhere; }\n");
    FAIL() << "built";
  } catch (const Unavailable& refused) {
    // Not all drivers heed #line.
    const bool is_told = opencl_devices().front().kind == "cpu";
    EXPECT_NE(std::string(refused.what()).find(is_told ? "kernels/broken.cl:3:" : "kernels/broken.cl:"),
              std::string::npos)
        << refused.what();
    EXPECT_NE(std::string(refused.what()).find("nowhere"), std::string::npos) << refused.what();
  }
}

TEST_P(KernelTest, ABrokenProgramIsRefusedAgain) {
  for (int i = 0; i < 2; ++i) EXPECT_THROW(context_->program("broken.cl", "kernel void broken("), Unavailable);
}

TEST_P(KernelTest, AnUnknownKernelIsRefusedByName) {
  try {
    Kernel(Queue(context_), context_->program("scale.cl", kScale), "shrink");
    FAIL() << "found";
  } catch (const Unavailable& refused) {
    EXPECT_NE(std::string(refused.what()).find("shrink"), std::string::npos) << refused.what();
  }
}

TEST_P(KernelTest, WrongArgumentsAreRefused) {
  const Queue queue(context_);
  Kernel scale(queue, context_->program("scale.cl", kScale), "scale");
  const Reals values(queue, Eigen::VectorXd::Ones(64));
  EXPECT_THROW(scale.launch(64, values), Unavailable);
  EXPECT_THROW(scale.launch(64, values, 1.0, 1, values, values), Unavailable);
}

TEST_P(KernelTest, ContractionIsOff) {
  constexpr const char* kFused = R"(
kernel void fused(const int count, global const scalar* a, global const scalar* b, global scalar* sum) {
  const int i = (int)get_global_id(0);
  if (i >= count) return;
  sum[i] = a[i] * b[i] - a[i] * b[i];
}
)";
  const Queue queue(context_);
  Kernel fused(queue, context_->program("fused.cl", kFused), "fused");
  const Eigen::VectorXd a = Eigen::VectorXd::Random(4096), b = Eigen::VectorXd::Random(4096);
  Reals sum(queue, 4096);
  fused.launch(4096, Reals(queue, a), Reals(queue, b), sum);
  Eigen::VectorXd back(4096);
  sum.download(back);
  EXPECT_EQ(back, Eigen::VectorXd::Zero(4096));
}

TEST_P(KernelTest, AProgramIsBuiltOnceForAllThreads) {
  std::vector<cl_program> built(8);
  std::vector<std::thread> threads;
  for (cl_program& program : built) {
    threads.emplace_back([&] { program = context_->program("scale.cl", kScale)(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const cl_program program : built) EXPECT_EQ(program, built.front());
  EXPECT_GT(context_->traffic().build_seconds, 0);
}

TEST_P(KernelTest, ThreadsWorkSideBySide) {
  std::vector<Eigen::VectorXd> results(4, Eigen::VectorXd(5000));
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < results.size(); ++k) {
    threads.emplace_back([&, k] {
      const Queue queue(context_);
      const bool scales = k % 2 == 0;
      const auto source = std::string(kScale) + (scales ? "" : "// another program\n");
      Kernel scale(queue, context_->program("scale.cl", source), "scale");
      Reals values(queue, Eigen::VectorXd::Constant(5000, 1));
      for (int i = 0; i < 20; ++i) scale.launch(5000, values, 1.0, static_cast<int>(k), values);
      values.download(results[k]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < results.size(); ++k) {
    EXPECT_EQ(results[k], Eigen::VectorXd::Constant(5000, 1 + 20.0 * static_cast<double>(k)));
  }
}

TEST(Contexts, ThreadsMayMakeThemAtOnce) {
  if (!context_or_skip(Precision::single)) return;
  std::vector<std::thread> threads;
  std::atomic<int> done{0};
  for (int k = 0; k < 8; ++k) {
    threads.emplace_back([&done] {
      const Queue queue(
          std::make_shared<Context>(choose_device("", Precision::single).handle, Precision::single, ProgramCache()));
      Eigen::VectorXd back(9);
      Reals(queue, Eigen::VectorXd::Ones(9)).download(back);
      if (back.sum() == 9) ++done;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, 8);
}

INSTANTIATE_TEST_SUITE_P(Precisions, KernelTest, testing::Values(Precision::single, Precision::twice),
                         [](const auto& of) { return of.param == Precision::single ? "single" : "twice"; });

}  // namespace
}  // namespace swage
