// The demo: its chair, its files, and a run of it that is stopped.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "program.h"
#include "swage/mesh_io.h"
#include "swage/render.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

std::vector<std::string> files() {
  std::vector<std::string> names{"gesture.deform", "report.json", "rest.obj", "result.obj"};
  if (can_render()) names.insert(names.begin(), "before_after.png");
  return names;
}

/// The demo, run once.
class Demo : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TempFolder>();
    outcome_ = run({"demo", (*folder_ / "new/folder").string()});
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::filesystem::path file(const std::string& name) { return *folder_ / "new/folder" / name; }

  static inline std::unique_ptr<TempFolder> folder_;
  static inline Outcome outcome_;
};

TEST_F(Demo, WritesAndNamesItsFiles) {
  ASSERT_EQ(outcome_.code, 0) << outcome_.err;
  EXPECT_EQ(names_in(file("")), files());
  for (const std::string& name : files()) EXPECT_THAT(outcome_.out, HasSubstr(file(name).string() + " "));
}

TEST_F(Demo, ShowsAPictureOrTellsWhyNot) {
  if (!can_render()) {
    EXPECT_THAT(outcome_.out, HasSubstr("SWAGE_RENDER"));
    return;
  }
  const std::string png = read_text(file("before_after.png"));
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1A\n");
  EXPECT_GT(png.size(), 20000U) << "an empty sheet packs to less";
}

TEST_F(Demo, TheChairIsAGoodMesh) {
  const json facts = json::parse(run({"info", file("rest.obj").string(), "--json", "-"}).out);
  for (const char* wrong : {"boundary_edges", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges",
                            "degenerate_triangles", "duplicate_triangles", "duplicate_vertices", "isolated_vertices"}) {
    EXPECT_EQ(facts[wrong], 0) << wrong;
  }
  EXPECT_EQ(facts["components"], 1);
  EXPECT_GT(facts["triangles"], 4000);
  EXPECT_LT(facts["triangles"], 8000);
  EXPECT_GT(facts["smallest_angle_deg"], 20);
  EXPECT_LT(facts["edge_length"]["max_to_mean"], 2);
  EXPECT_GT(facts["volume"], 0) << "normals point outward";
}

TEST_F(Demo, TheResultIsWiderAndLower) {
  const Positions rest = read_mesh(file("rest.obj")).mesh.positions;
  const Positions now = read_mesh(file("result.obj")).mesh.positions;
  auto size = [](const Positions& positions) -> Eigen::RowVector3d {
    return positions.colwise().maxCoeff() - positions.colwise().minCoeff();
  };
  EXPECT_NEAR(size(now)[0] - size(rest)[0], 0.18, 0.02);
  EXPECT_NEAR(size(now)[1] - size(rest)[1], -0.135, 0.03);
  EXPECT_NEAR(size(now)[2], size(rest)[2], 0.03);
  EXPECT_NEAR(now.col(1).minCoeff(), 0, 0.003) << "it stands on the floor";
  const json report = json::parse(read_text(file("report.json")));
  EXPECT_LT(report["normal_error_deg"]["mean"], 1);
  EXPECT_LT(report["handle_error"], 0.005);
}

TEST_F(Demo, ItsGestureGivesTheSameResultByHand) {
  const Outcome outcome = run({"reshape", file("rest.obj").string(), "--gesture", file("gesture.deform").string(), "-o",
                               "-", "--threads", "1"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out == read_text(file("result.obj")));
}

TEST(DemoFolder, AFileInTheWayExitsWith4) {
  const TempFolder folder;
  write_text(folder / "taken", "");
  const Outcome outcome = run({"demo", (folder / "taken").string()});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("taken"));
}

/// A reshape of the chair that draws its progress on a terminal.
class Watched : public Demo {
 protected:
  void SetUp() override {
    if (!Terminal::exists()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  }

  Running begin(const Terminal& terminal, const Arguments& more = {}) const {
    Arguments arguments{"reshape", file("rest.obj").string(),      "--gesture", file("gesture.deform").string(),
                        "-o",      (out_ / "result.obj").string(), "--json",    (out_ / "report.json").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return start(arguments, "/dev/null", terminal.path());
  }

  TempFolder out_;
};

TEST_F(Watched, ATerminalShowsProgressAndIsLeftClean) {
  Terminal terminal;
  const Running running = begin(terminal);
  EXPECT_TRUE(terminal.wait_for("%"));
  const std::string all = terminal.rest();
  EXPECT_EQ(running.wait(), 0);
  EXPECT_THAT(all.substr(all.rfind('%')), testing::ContainsRegex("\r +\rswage: info: "));
}

TEST_F(Watched, QuietShowsNoProgress) {
  Terminal terminal;
  const Running running = begin(terminal, {"--quiet"});
  EXPECT_EQ(terminal.rest(), "");
  EXPECT_EQ(running.wait(), 0);
}

TEST_F(Watched, InterruptedInAPassNothingIsWritten) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Terminal terminal;
    const Running running = begin(terminal, {"--solver", "published"});  // The slower one.
    ASSERT_TRUE(terminal.wait_for("pass "));
    kill(running.process, signal);
    EXPECT_EQ(running.wait(), 130);
    EXPECT_EQ(names_in(out_.path()), std::vector<std::string>{});
  }
}

/// Opens a pipe as soon as a program reads from it; -1 where none does for ten seconds.
int open_when_read(const std::filesystem::path& pipe) {
  for (int i = 0; i < 1000; ++i) {
    const int end = open(pipe.c_str(), O_WRONLY | O_NONBLOCK);
    if (end >= 0) return end;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return -1;
}

/// A program that waits for a mesh which is slow to come.
class Waiting : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path mesh = folder_ / "mesh.obj";
    ASSERT_EQ(mkfifo(mesh.c_str(), 0600), 0);
    running_ = start({"reshape", mesh.string(), "--pin", "0", "-o", (folder_ / "result.obj").string()}, "/dev/null",
                     folder_ / "err");
    pipe_ = open_when_read(mesh);
    ASSERT_GE(pipe_, 0);
  }

  TempFolder folder_;
  Running running_;
  int pipe_ = -1;
};

TEST_F(Waiting, InterruptedOnceItReadsOnAndStops) {
  kill(running_.process, SIGINT);
  const std::string mesh = box_obj();
  EXPECT_EQ(write(pipe_, mesh.data(), mesh.size()), static_cast<ssize_t>(mesh.size()));
  close(pipe_);
  EXPECT_EQ(running_.wait(), 130);
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"err", "mesh.obj"}));
}

TEST_F(Waiting, InterruptedTwiceItEndsAtOnce) {
  kill(running_.process, SIGINT);
  kill(running_.process, SIGTERM);
  EXPECT_EQ(running_.wait(), 130);
  close(pipe_);
}

}  // namespace
}  // namespace swage::test
