#include "helper_process.h"

#include <gmock/gmock.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <cerrno>
#include <chrono>
#include <future>
#include <vector>

#include "places.h"
#include "swage/error.h"

namespace swage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string run(const std::string& helper, const std::string& input = {}, const HelperLimits& limits = {},
                const Poll& poll = {}) {
  return run_helper(SWAGE_TEST_HELPERS "/" + helper, input, limits, poll);
}

template <typename Error, typename Call>
std::string message_of(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

std::string many_bytes(size_t count) {
  std::string bytes(count, '\0');
  for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<char>(i * i % 251);
  return bytes;
}

/// Whether no child is left, running or not waited for.
bool all_ended() { return waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(HelperProcess, AnswersWithEveryByte) {
  for (const size_t count : {size_t{0}, size_t{1}, size_t{65536}, size_t{20'000'000}}) {
    const std::string bytes = many_bytes(count);
    EXPECT_TRUE(run("echo", bytes) == bytes) << count;
  }
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, FullPipesOnBothSidesAreNoDeadlock) {
  const std::string answer = run("chatter", many_bytes(3'000'000), {.seconds = 20});
  EXPECT_EQ(answer, std::string(1 << 20, 'x') + "3000000");
}

TEST(HelperProcess, ItsLastLineIsTheMessage) {
  EXPECT_EQ(message_of<Unsolvable>([] { run("crash"); }),
            "crash was ended by signal 11 (Segmentation fault): in the middle of it");
  EXPECT_EQ(message_of<Unsolvable>([] { run("refuse"); }), "refuse failed with status 1: triangles 3 and 7 cross");
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, EndsAtTheTimeLimit) {
  const double seconds = seconds_of([] {
    EXPECT_EQ(message_of<Unsolvable>([] { run("hang", many_bytes(1'000'000), {.seconds = 1}); }),
              "hang did not end within 1 seconds");
  });
  EXPECT_GE(seconds, 1);
  EXPECT_LT(seconds, 3);
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, IsGivenNoMoreMemoryThanAllowed) {
  const HelperLimits limits{.bytes = 200'000'000};
  EXPECT_EQ(run("greedy", "100000000", limits), "ok");
  EXPECT_THAT(message_of<Unsolvable>([&] { run("greedy", "300000000", limits); }), HasSubstr("memory"));
  EXPECT_THAT(message_of<Unsolvable>([] { run("endless", {}, {.bytes = 100'000'000}); }), HasSubstr("more than"));
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, IsCancelled) {
  int asked = 0;
  const double seconds = seconds_of(
      [&] { EXPECT_THROW(run("hang", {}, {}, [&] { ++asked > 3 ? throw Cancelled() : void(); }), Cancelled); });
  EXPECT_EQ(asked, 4);
  EXPECT_LT(seconds, 2);
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, MayAnswerWithoutReading) { EXPECT_EQ(run("careless", many_bytes(20'000'000)), "done\n"); }

TEST(HelperProcess, SeveralAtOnceShareNothing) {
  const std::string inherited = run("descriptors");
  std::vector<std::future<void>> threads;
  for (size_t thread = 0; thread < 4; ++thread) {
    threads.push_back(std::async(std::launch::async, [thread, &inherited] {
      for (size_t turn = 0; turn < 10; ++turn) {
        const std::string bytes = many_bytes(100'000 * (thread + 1) + turn);
        EXPECT_TRUE(run("echo", bytes, {.seconds = 30}) == bytes);
        EXPECT_EQ(run("descriptors", {}, {.seconds = 30}), inherited);
        EXPECT_THROW(run("crash"), Unsolvable);
      }
    }));
  }
  // Held for as long: it must not hold the others' pipes open.
  EXPECT_THROW(run("hang", {}, {.seconds = 2}), Unsolvable);
  for (auto& thread : threads) thread.get();
  EXPECT_TRUE(all_ended());
}

TEST(HelperProcess, RunsWhereSignalsAreIgnored) {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run("echo", "pipe"), "pipe");
  EXPECT_EQ(run("careless", many_bytes(1'000'000)), "done\n");
  signal(SIGPIPE, SIG_DFL);
  signal(SIGCHLD, SIG_DFL);
}

TEST(HelperProcess, NotFoundSaysWhereItWasLookedFor) {
  EXPECT_THAT(message_of<Unavailable>([] { run_helper("swage-none", {}, {}); }),
              AllOf(HasSubstr("swage-none"), HasSubstr("/libexec/swage"), HasSubstr("SWAGE_HELPERS")));
  EXPECT_THAT(message_of<Unavailable>([] { run("none"); }), HasSubstr("No such file"));
}

TEST(HelperProcess, IsFoundInTheFolderTheEnvironmentNames) {
  setenv("SWAGE_HELPERS", SWAGE_TEST_HELPERS, 1);
  EXPECT_EQ(run_helper("echo", "here", {}), "here");
  EXPECT_EQ(helper_folders().front(), SWAGE_TEST_HELPERS);
  unsetenv("SWAGE_HELPERS");
  const auto here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  EXPECT_EQ(helper_folders().at(0), here);
  EXPECT_EQ(helper_folders().at(1), here.parent_path() / "libexec/swage");
  EXPECT_THROW(run_helper("echo", "here", {}), Unavailable);
}

}  // namespace
}  // namespace swage
