// Kernels built by several processes at once, or by one that is killed over it: the next run finds a usable cache.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "opencl_device.h"
#include "program.h"

namespace swage::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class ColdStart : public testing::Test {
 protected:
  void SetUp() override {
    if (!opencl_or_skip()) return;
    write_text(folder_ / "box.obj", box_obj());
    ASSERT_EQ(start("expected").wait(), 0) << read_text(folder_ / "expected.err");
    expected_ = read_text(folder_ / "expected.obj");
  }

  /// A run with a cache of its own, or the usual.
  Running start(const std::string& name, const std::string& cache = "") const {
    const Arguments arguments{
        "reshape", (folder_ / "box.obj").string(),       "--pin",     "0",     "--move", "55=0.1,0,0",
        "-o",      (folder_ / (name + ".obj")).string(), "--backend", "opencl"};
    std::vector<std::string> environment;
    for (const char* of : {"XDG_CACHE_HOME=", "POCL_CACHE_DIR="}) {
      if (!cache.empty()) environment.push_back(of + (folder_ / cache).string());
    }
    return test::start(arguments, folder_ / (name + ".out"), folder_ / (name + ".err"), environment);
  }

  void expect_good(const std::string& name, const Running& run) const {
    EXPECT_EQ(run.wait(), 0) << read_text(folder_ / (name + ".err"));
    EXPECT_THAT(read_text(folder_ / (name + ".err")), Not(HasSubstr("warning"))) << name;
    EXPECT_EQ(read_text(folder_ / (name + ".obj")), expected_) << name;
  }

  TempFolder folder_;
  std::string expected_;
};

TEST_F(ColdStart, KilledWhileBuildingLeavesAUsableCache) {
  if (IsSkipped()) return;
  int killed = 0;
  for (const int milliseconds : {100, 200, 300, 400, 600, 800, 1000, 1300, 1600}) {
    const Running run = start("killed", "cache");
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(run.process, SIGKILL);
    killed += run.wait() == 1000 + SIGKILL ? 1 : 0;
  }
  EXPECT_GT(killed, 0);
  expect_good("after", start("after", "cache"));
}

TEST_F(ColdStart, SeveralProcessesBuildAtOnce) {
  if (IsSkipped()) return;
  std::vector<Running> runs;
  for (int k = 0; k < 4; ++k) runs.push_back(start("run" + std::to_string(k), "cache"));
  for (int k = 0; k < 4; ++k) expect_good("run" + std::to_string(k), runs[static_cast<size_t>(k)]);
  expect_good("after", start("after", "cache"));
}

TEST_F(ColdStart, OurCacheOrTheDriversMayBeLost) {
  if (IsSkipped()) return;
  expect_good("cold", start("cold", "cache"));
  expect_good("warm", start("warm", "cache"));
  std::error_code none_of_ours;
  std::filesystem::rename(folder_ / "cache" / "swage", folder_ / "ours", none_of_ours);
  expect_good("drivers", start("drivers", "cache"));
  std::filesystem::remove_all(folder_ / "cache");
  std::filesystem::create_directory(folder_ / "cache");
  std::filesystem::rename(folder_ / "ours", folder_ / "cache" / "swage", none_of_ours);
  expect_good("ours", start("ours", "cache"));
}

TEST_F(ColdStart, ACacheFolderThatCannotBeIsWordsOrNoMatter) {
  if (IsSkipped()) return;
  write_text(folder_ / "file", "not a folder");
  const int code = start("refused", "file/cache").wait();
  if (code == 0) {
    EXPECT_EQ(read_text(folder_ / "refused.obj"), expected_);
  } else {
    EXPECT_EQ(code, 4);
    EXPECT_THAT(read_text(folder_ / "refused.err"), HasSubstr("OpenCL"));
  }
}

}  // namespace
}  // namespace swage::test
