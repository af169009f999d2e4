// Built programs on disk: used, shared, and never in the way.
#include "program_cache.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "kernel.h"
#include "own_context.h"
#include "swage/error.h"

namespace swage {
namespace {

using std::filesystem::path;
using Bytes = ProgramCache::Bytes;

class ProgramCacheTest : public testing::Test {
 protected:
  ~ProgramCacheTest() override { std::filesystem::remove_all(folder_.parent_path().parent_path()); }

  std::vector<path> files() const {
    std::vector<path> found;
    if (!std::filesystem::exists(folder_)) return found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) found.push_back(entry.path());
    return found;
  }
  std::string content() const {
    std::ifstream file(files().at(0), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite(const std::string& bytes) const { std::ofstream(files().at(0), std::ios::binary) << bytes; }

  const path folder_ = path(testing::TempDir()) / ("swage-cache-" + std::to_string(getpid())) / "deep" / "down";
  const ProgramCache cache_{folder_};
  const Bytes program_{0, 1, 2, 255, 10, 13, 0};
};

TEST_F(ProgramCacheTest, GivesBackWhatItKept) {
  EXPECT_FALSE(cache_.find("key"));
  cache_.keep("key", program_);
  EXPECT_EQ(cache_.find("key"), program_);
  EXPECT_FALSE(cache_.find("another"));
}

TEST_F(ProgramCacheTest, AFileOfAnotherKeyIsNotTaken) {
  cache_.keep("key", program_);
  const path theirs = files().at(0);
  cache_.keep("another", {1});
  for (const path& file : files()) {
    if (file != theirs) std::filesystem::copy_file(theirs, file, std::filesystem::copy_options::overwrite_existing);
  }
  EXPECT_FALSE(cache_.find("another"));
}

TEST_F(ProgramCacheTest, ADamagedEntryIsNone) {
  cache_.keep("key", program_);
  const std::string whole = content();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    overwrite(whole.substr(0, size));
    EXPECT_FALSE(cache_.find("key")) << "cut at " << size;
    std::string flipped = whole;
    flipped[size] = static_cast<char>(flipped[size] ^ 4);
    overwrite(flipped);
    EXPECT_FALSE(cache_.find("key")) << "flipped at " << size;
  }
  overwrite(whole + "more");
  EXPECT_FALSE(cache_.find("key"));
  cache_.keep("key", program_);
  EXPECT_EQ(cache_.find("key"), program_);
}

TEST_F(ProgramCacheTest, AFolderThatCannotBeMadeIsNoError) {
  const path file = path(testing::TempDir()) / ("swage-file-" + std::to_string(getpid()));
  std::ofstream(file) << "not a folder";
  const ProgramCache cache(file / "inside");
  cache.keep("key", program_);
  EXPECT_FALSE(cache.find("key"));
  std::filesystem::remove(file);
}

TEST_F(ProgramCacheTest, AReadOnlyFolderIsNoError) {
  std::filesystem::create_directories(folder_);
  chmod(folder_.c_str(), 0500);
  cache_.keep("key", program_);
  // Root may write anywhere.
  EXPECT_EQ(cache_.find("key").has_value(), geteuid() == 0);
  chmod(folder_.c_str(), 0700);
}

TEST_F(ProgramCacheTest, NoFolderKeepsNothing) {
  const ProgramCache none;
  none.keep("key", program_);
  EXPECT_FALSE(none.keeps());
  EXPECT_FALSE(none.find("key"));
}

TEST_F(ProgramCacheTest, ManyWritersLeaveOneWholeEntry) {
  const Bytes large(1 << 20, 7);
  std::vector<std::thread> writers;
  for (int k = 0; k < 8; ++k) {
    writers.emplace_back([&] {
      for (int i = 0; i < 5; ++i) {
        cache_.keep("key", large);
        EXPECT_EQ(cache_.find("key"), large);
      }
    });
  }
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(files().size(), 1);
}

constexpr const char* kDouble = "kernel void twice(const int count, global scalar* x) { x[get_global_id(0)] *= 2; }";

/// Runs a program that a context of its own built through the cache.
void expect_runs(const ProgramCache& cache) {
  const auto context = test::context_or_skip(Precision::single, cache);
  if (!context) return;
  const Queue queue(context);
  Kernel twice(queue, context->program("twice.cl", kDouble), "twice");
  Reals values(queue, Eigen::VectorXd::Ones(64));
  EXPECT_THROW(twice.launch(64, values, values), Unavailable);
  EXPECT_THROW(twice.launch(64, 0.5), Unavailable);
  twice.launch(64, values);
  Eigen::VectorXd back(64);
  values.download(back);
  EXPECT_EQ(back, Eigen::VectorXd::Constant(64, 2));
}

TEST_F(ProgramCacheTest, AContextBuildsFromIt) {
  expect_runs(cache_);
  if (IsSkipped()) return;
  ASSERT_EQ(files().size(), 1);
  const auto written = std::filesystem::last_write_time(files()[0]);
  expect_runs(cache_);
  EXPECT_EQ(std::filesystem::last_write_time(files()[0]), written);
}

TEST_F(ProgramCacheTest, ContextsBuildFromItAtOnce) {
  if (!test::opencl_or_skip(Precision::single)) return;
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k) threads.emplace_back([&] { expect_runs(cache_); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(files().size(), 1);
}

TEST_F(ProgramCacheTest, ADamagedProgramIsBuiltAgain) {
  expect_runs(cache_);
  if (IsSkipped()) return;
  const std::string whole = content();
  overwrite(whole.substr(0, whole.size() / 2));
  expect_runs(cache_);
  EXPECT_EQ(content(), whole);
}

TEST_F(ProgramCacheTest, AProgramThatTheDriverRefusesIsBuiltAgain) {
  expect_runs(cache_);
  if (IsSkipped()) return;
  const std::string whole = content();
  const std::size_t start = whole.find('\n') + 1, end = whole.find(kDouble) + std::strlen(kDouble) + 1;
  cache_.keep(whole.substr(start, end - start), {1, 2, 3});
  ASSERT_EQ(files().size(), 1);
  ASSERT_LT(content().size(), whole.size());
  expect_runs(cache_);
  EXPECT_EQ(content(), whole);
}

}  // namespace
}  // namespace swage
