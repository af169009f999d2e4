// What `swage reshape` writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"
#include "rays_embree.h"
#include "remesher.h"
#include "swage/mesh_io.h"
#include "tetrahedra.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A box whose top is pulled up by 0.5.
class Reshaping : public testing::Test {
 protected:
  void SetUp() override {
    write_text(box_, box_obj());
    write_text(folder_ / "pull.deform", R"([{"label": "pull", "displacements": {"0": [0, 0, 0]}}])");
  }

  Outcome reshape(const Arguments& more) const {
    Arguments arguments{"reshape", box_.string(), "--pin", "z<=0", "--move", "z>=2=0,0,0.5", "--remesh", "never"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  TempFolder folder_;
  std::filesystem::path box_ = folder_ / "box.obj";
  std::filesystem::path result_ = folder_ / "result.obj";
};

bool is_moving(const std::string& line) { return line.starts_with("v ") || line.starts_with("vn "); }

TEST_F(Reshaping, OnlyVerticesAndNormalsChange) {
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  const std::vector<std::string> before = lines(read_text(box_)), after = lines(read_text(result_));
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    ++changed;
    EXPECT_TRUE(is_moving(before[i]) && is_moving(after[i])) << before[i] << " became " << after[i];
  }
  EXPECT_GT(changed, 8);
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"box.obj", "pull.deform", "result.obj"}));
}

TEST_F(Reshaping, HandlesArrive) {
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  const Positions rest = read_mesh(box_).mesh.positions, now = read_mesh(result_).mesh.positions;
  int moved = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    if (rest(v, 2) != 0 && rest(v, 2) != 2) continue;
    const Eigen::RowVector3d target = rest.row(v) + Eigen::RowVector3d(0, 0, rest(v, 2) == 2 ? 0.5 : 0);
    EXPECT_LT((now.row(v) - target).norm(), 1e-3) << "vertex " << v;
    moved += rest(v, 2) == 2;
  }
  EXPECT_EQ(moved, 16);
}

TEST_F(Reshaping, StdoutHoldsWhatAFileWould) {
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  const Outcome outcome = reshape({"-o", "-"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, read_text(result_));
}

TEST_F(Reshaping, TheInputMayBeOverwritten) {
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  ASSERT_EQ(reshape({"-o", box_.string()}).code, 0);
  EXPECT_EQ(read_text(box_), read_text(result_));
}

TEST_F(Reshaping, OtherFormatsHoldTheSamePositions) {
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  const Positions expected = read_mesh(result_).mesh.positions;
  for (const char* name : {"result.ply", "result.OFF"}) {
    ASSERT_EQ(reshape({"-o", (folder_ / name).string()}).code, 0);
    EXPECT_EQ(read_mesh(folder_ / name).mesh.positions, expected) << name;
  }
}

TEST_F(Reshaping, AReportHasItsKeys) {
  const Outcome outcome = reshape({"--json", "-", "--threads", "2"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json report = json::parse(outcome.out);
  for (const char* key : {"command",        "version",
                          "input",          "vertices",
                          "triangles",      "components",
                          "method",         "solver",
                          "backend",        "device",
                          "threads",        "iterations",
                          "best_iteration", "stop",
                          "energy",         "handle_error",
                          "energy_by_term", "handle_error_unfinished",
                          "finalised",      "normal_error_deg",
                          "seconds",        "peak_memory_mb",
                          "traffic",        "warnings",
                          "paths",          "memory_mb_by_part"}) {
    EXPECT_TRUE(report.contains(key)) << key;
    EXPECT_FALSE(report.value(key, json()).is_null()) << key;
  }
  EXPECT_EQ(report["vertices"], 56);
  EXPECT_EQ(report["triangles"], 108);
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["input"], box_.string());
  EXPECT_EQ(report["method"], "slippage");
  EXPECT_LT(report["best_iteration"], report["iterations"]);
  EXPECT_GT(report["peak_memory_mb"], 1);
  EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(Reshaping, TheLinearSolverIsAsAskedAndToldWithItsReason) {
  for (const char* solver : {"factor", "multigrid"}) {
    const json report = json::parse(reshape({"--json", "-", "--linear-solver", solver}).out);
    EXPECT_EQ(report["paths"]["transform_step"], solver + std::string(": as asked"));
    EXPECT_EQ(report["paths"]["start"], "rest: no coarse start asked for");
  }
  EXPECT_EQ(reshape({"--linear-solver", "lu"}).code, 2);
  const Outcome refused = reshape({"--json", "-", "--linear-solver", "multigrid", "--solver", "published"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--linear-solver"), std::string::npos) << refused.err;
}

TEST_F(Reshaping, TheMethodsToCompareWithMeetTheHandlesAndReport) {
  for (const char* method : {"poisson", "arap", "arap-volume", "conformal"}) {
    const Outcome outcome = reshape({"--json", "-", "-o", result_.string(), "--method", method});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json report = json::parse(outcome.out);
    EXPECT_EQ(report["method"], method);
    EXPECT_FALSE(report.contains("solver"));
    EXPECT_LT(report["handle_error"], 1e-9) << method;
    EXPECT_EQ(report["stop"], "moved") << method;
    EXPECT_GT(report["memory_mb_by_part"]["factor"], 0);
    EXPECT_NE(read_mesh(result_).mesh.positions, read_mesh(box_).mesh.positions);
    const json soft = json::parse(reshape({"--json", "-", "--method", method, "--handle-weight", "1"}).out);
    EXPECT_GT(soft["handle_error"], 1e-6) << method;
  }
}

TEST_F(Reshaping, OptionsThatAMethodHasNoUseForAreRefused) {
  for (const Arguments& unused : std::vector<Arguments>{{"--solver", "published"},
                                                        {"--linear-solver", "factor"},
                                                        {"--no-finalise"},
                                                        {"--feature-angle", "90"},
                                                        {"--straight", "auto"}}) {
    Arguments arguments{"--json", "-", "--method", "arap"};
    arguments.insert(arguments.end(), unused.begin(), unused.end());
    const Outcome outcome = reshape(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find(unused[0] + " "), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(reshape({"--json", "-", "--handle-weight", "10"}).code, 2);
  EXPECT_EQ(reshape({"--json", "-", "--method", "arap", "--handle-weight", "0"}).code, 2);
  EXPECT_EQ(reshape({"--json", "-", "--method", "laplace"}).code, 2);
}

TEST_F(Reshaping, AReportAddsUp) {
  const json report = json::parse(reshape({"--json", "-"}).out);
  double energy = 0, seconds = 0;
  for (const auto& [term, value] : report["energy_by_term"].items()) energy += value.get<double>();
  EXPECT_NEAR(report["energy"].get<double>(), energy, 1e-9 * energy);
  for (const char* part : {"read", "precompute", "solve", "write"}) {
    EXPECT_GE(report["seconds"][part], 0) << part;
    seconds += report["seconds"][part].get<double>();
  }
  EXPECT_LE(seconds, report["seconds"]["total"].get<double>() + 1e-3);
}

TEST_F(Reshaping, ErrorsInAReportAreThoseOfTheResult) {
  ASSERT_EQ(reshape({"-o", result_.string(), "--json", (folder_ / "report.json").string()}).code, 0);
  const json report = json::parse(read_text(folder_ / "report.json"));
  const Positions rest = read_mesh(box_).mesh.positions, now = read_mesh(result_).mesh.positions;
  double farthest = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    if (rest(v, 2) != 0 && rest(v, 2) != 2) continue;
    const Eigen::RowVector3d target = rest.row(v) + Eigen::RowVector3d(0, 0, rest(v, 2) == 2 ? 0.5 : 0);
    farthest = std::max(farthest, (now.row(v) - target).norm());
  }
  EXPECT_NEAR(report["handle_error"].get<double>(), farthest / std::sqrt(6.0), 1e-9);
  // A box pulled along its axis keeps its normals.
  EXPECT_LT(report["normal_error_deg"]["max"], 1);
  EXPECT_LE(report["normal_error_deg"]["mean"], report["normal_error_deg"]["percentile_95"]);
  EXPECT_LE(report["normal_error_deg"]["percentile_95"], report["normal_error_deg"]["max"]);
  EXPECT_EQ(report["flipped_triangles"], 0);
}

TEST_F(Reshaping, AReportCountsNewSelfIntersections) {
  EXPECT_EQ(json::parse(reshape({"--json", "-"}).out)["new_self_intersections"], 0);
  // One side of the box through the other.
  const Outcome through = run({"reshape", box_.string(), "--pin", "z<=0", "--pin", "z>=2&x>=1", "--move",
                               "z>=2&x<=0=3,0,0", "--remesh", "never", "--json", "-"});
  EXPECT_GT(json::parse(through.out)["new_self_intersections"], 0) << through.err;
}

TEST_F(Reshaping, ACoarseMeshIsSolvedByAStandInUnlessItMayNotBe) {
  const Outcome outcome = run({"reshape", box_.string(), "--pin", "z<=0", "--move", "z>=2=0,0,0.5", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json report = json::parse(outcome.out), as_given = json::parse(reshape({"--json", "-"}).out);
  EXPECT_THAT(report["paths"]["mesh"].get<std::string>(),
              HasSubstr(has_cgal() && has_embree() ? "stand-in: remeshed to" : "as given, badly shaped as it is"));
  EXPECT_LT(report["handle_error"], 0.01);
  EXPECT_EQ(report["vertices"], 56);
  EXPECT_EQ(as_given["paths"]["mesh"], "as given");
}

TEST_F(Reshaping, AScaffoldIsWrittenWhereThereIsOne) {
  const std::string tetrahedra = (folder_ / "scaffold.mesh").string();
  const Outcome one_part = reshape({"-o", result_.string(), "--scaffold-mesh", tetrahedra});
  EXPECT_EQ(one_part.code, 4);
  EXPECT_THAT(one_part.err, HasSubstr("no scaffold was made, components: one; leave it out"));
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"box.obj", "pull.deform"}));

  write_text(box_, box_obj() + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 57 59 58\nf 57 58 60\nf 58 59 60\nf 59 57 60\n");
  const Outcome two_parts = reshape({"-o", result_.string(), "--scaffold-mesh", tetrahedra});
  if (has_tetgen()) {
    EXPECT_EQ(two_parts.code, 0) << two_parts.err;
    EXPECT_THAT(read_text(tetrahedra), testing::StartsWith("MeshVersionFormatted"));
  } else {
    EXPECT_EQ(two_parts.code, 4);
    EXPECT_THAT(two_parts.err, HasSubstr("SWAGE_TETGEN"));
  }
}

TEST_F(Reshaping, AGestureFileDoesWhatTheLineDoes) {
  const MeshFile box = read_mesh(box_);
  json displacements;
  for (Eigen::Index v = 0; v < box.mesh.positions.rows(); ++v) {
    const double z = box.mesh.positions(v, 2);
    if (z == 0 || z == 2) displacements[std::to_string(v)] = {0, 0, z == 2 ? 0.5 / std::sqrt(6.0) : 0};
  }
  const json gestures = {{{"label", "other"}, {"displacements", {{"0", {0, 0, 0}}}}},
                         {{"label", "pull:up"}, {"displacements", displacements}}};
  write_text(folder_ / "two.deform", gestures.dump());
  ASSERT_EQ(reshape({"-o", result_.string()}).code, 0);
  const std::string by_file = (folder_ / "by_file.obj").string();
  const std::string gesture = (folder_ / "two.deform").string() + ":pull:up";
  ASSERT_EQ(run({"reshape", box_.string(), "--gesture", gesture, "-o", by_file, "--remesh", "never"}).code, 0);
  const Positions expected = read_mesh(result_).mesh.positions;
  EXPECT_LT((read_mesh(by_file).mesh.positions - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Reshaping, AFileWithOneGestureNeedsNoLabel) {
  const std::string gesture = (folder_ / "pull.deform").string();
  for (const std::string& choice : {gesture, gesture + ":pull"}) {
    const Outcome outcome = run({"reshape", box_.string(), "--gesture", choice, "-o", result_.string()});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Positions moved = read_mesh(result_).mesh.positions - read_mesh(box_).mesh.positions;
    EXPECT_LT(moved.cwiseAbs().maxCoeff(), 1e-12) << "one anchor moves nothing";
  }
}

TEST_F(Reshaping, IdenticalHandlesMayMeet) {
  const Outcome outcome = reshape({"--pin", "z<=0&x<=0", "--move", "z>=2&y<=0=0,0,0.5", "-o", result_.string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(Reshaping, ThreadsDoNotChangeTheResult) {
  const Outcome one = reshape({"-o", "-", "--threads", "1"}), two = reshape({"-o", "-", "--threads", "2"});
  EXPECT_EQ(one.code, 0);
  EXPECT_EQ(one.out, two.out);
}

TEST_F(Reshaping, CommonOptionsStandBeforeOrAfterTheCommand) {
  const Outcome before = run({"--threads", "1", "--quiet", "reshape", box_.string(), "--pin", "0", "--json", "-"});
  ASSERT_EQ(before.code, 0) << before.err;
  EXPECT_EQ(json::parse(before.out)["threads"], 1);
  EXPECT_EQ(before.err, "");
}

TEST_F(Reshaping, QuietLogsErrorsOnly) {
  EXPECT_THAT(reshape({"-o", result_.string()}).err, HasSubstr("passes"));
  EXPECT_EQ(reshape({"-o", result_.string(), "--quiet"}).err, "");
}

TEST_F(Reshaping, WarningsOfTheFileAreInTheReport) {
  write_text(box_, box_obj() + "f 1 2 2\n");
  const Outcome outcome = reshape({"--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["warnings"].size(), 1);
  EXPECT_THAT(outcome.err, HasSubstr("swage: warning: "));
}

TEST_F(Reshaping, CurvatureAndChainsAreTaken) {
  std::string flat, chain = "0 1\n";
  for (int t = 0; t < 108; ++t) flat += "0 0\n";
  write_text(folder_ / "box.fk", flat);
  write_text(folder_ / "box.straight", chain);
  const Outcome outcome = reshape({"-o", "-", "--curvature", (folder_ / "box.fk").string(), "--straight",
                                   (folder_ / "box.straight").string(), "--feature-angle", "100", "--no-finalise"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace swage::test
