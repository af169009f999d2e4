// What `swage stylize` writes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "measures.h"
#include "opencl_device.h"
#include "program.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/style.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

Mesh askew(Mesh mesh) {
  mesh.positions *= Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 0.4, 0.3).normalized()).toRotationMatrix();
  return mesh;
}

/// A ball turned so that no axis of a style is one of its own.
class Stylizing : public testing::Test {
 protected:
  Stylizing() { write_mesh(ball_, askew(sphere(1, 2))); }

  Outcome stylize(const Arguments& more) const {
    Arguments arguments{"stylize", ball_, "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  json report(Arguments more) const {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = stylize(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.code == 0 ? json::parse(outcome.out) : json();
  }

  /// The OBJ that comes of it.
  std::string result(Arguments more) const {
    more.insert(more.end(), {"-o", "-"});
    const Outcome outcome = stylize(more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.out;
  }

  Mesh mesh_of(const Arguments& more) const {
    write_text(folder_ / "read_back.obj", result(more));
    return read_mesh(folder_ / "read_back.obj").mesh;
  }

  TempFolder folder_;
  std::string ball_ = folder_ / "ball.obj";
};

double angle(const json& report, const char* when) { return report["target_angle_deg"][when]["mean"]; }

TEST_F(Stylizing, OnlyVerticesAndNormalsChange) {
  const std::string box = folder_ / "box.obj";
  write_text(box, box_obj());
  const Outcome outcome = run({"stylize", box, "--style", "octahedron", "-o", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const std::vector<std::string> before = lines(box_obj()), after = lines(outcome.out);
  ASSERT_EQ(before.size(), after.size());
  int changed = 0;
  for (size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    ++changed;
    const bool may_change = before[i].starts_with("v ") || before[i].starts_with("vn ");
    EXPECT_TRUE(may_change) << before[i] << " became " << after[i];
  }
  EXPECT_GT(changed, 20);
}

TEST_F(Stylizing, EveryPresetDrawsNormalsNearer) {
  for (const char* preset : {"tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron", "prism3", "prism6",
                             "bipyramid8", "rounded-cube"}) {
    const json told = report({"--style", preset, "--lambda", "5"});
    EXPECT_LT(angle(told, "after"), 0.8 * angle(told, "before")) << preset;
    EXPECT_EQ(told["style"], preset);
    EXPECT_EQ(told["method"], preset == std::string("rounded-cube") ? "sphere" : "closest");
  }
}

TEST_F(Stylizing, AFileIsAStyleAsAPresetIs) {
  const std::string cube = folder_ / "die.obj";
  write_mesh(cube, style_shape(StyleShape::cube));
  EXPECT_TRUE(result({"--style", cube}) == result({"--style", "cube"}));
  EXPECT_EQ(report({"--style", cube})["style"], "die");
}

TEST_F(Stylizing, TheTargetIsAsAskedFor) {
  const std::string cube = result({"--style", "rounded-cube"});
  EXPECT_TRUE(cube == result({"--style", "rounded-cube", "--target", "sphere"}));
  EXPECT_TRUE(cube != result({"--style", "rounded-cube", "--target", "closest"}));
  const Outcome many = run({"stylize", ball_, "--style", "rounded-cube", "--target", "closest", "-o", "-"});
  EXPECT_THAT(many.err, HasSubstr("--target sphere follows the whole shape"));
}

TEST_F(Stylizing, TargetsAreLookedUpAgainUnlessTheyMayNotBe) {
  write_mesh(ball_, askew(torus(1, 0.4, 24, 12)));
  const std::string again = result({"--style", "icosahedron"});
  EXPECT_TRUE(again == result({"--style", "icosahedron", "--dynamic"}));
  EXPECT_TRUE(again != result({"--style", "icosahedron", "--no-dynamic"}));
  EXPECT_EQ(report({"--style", "cube"})["dynamic"], true);
  EXPECT_EQ(report({"--style", "cube", "--no-dynamic"})["dynamic"], false);
}

TEST_F(Stylizing, MoreWeightIsNearerToTheStyle) {
  double last = 1e9;
  for (const char* lambda : {"0", "0.1", "1", "10"}) {
    const json told = report({"--style", "cube", "--lambda", lambda});
    EXPECT_LT(angle(told, "after"), last) << lambda;
    last = angle(told, "after");
  }
  EXPECT_LT((mesh_of({"--style", "cube", "--lambda", "0"}).positions - read_mesh(ball_).mesh.positions).norm(), 1e-9);
  EXPECT_TRUE(result({"--style", "cube"}) == result({"--style", "cube", "--lambda", "1"}));
}

TEST_F(Stylizing, EnergiesAndPassesAreAsAskedFor) {
  const std::string arap = result({"--style", "cube", "--energy", "arap"});
  EXPECT_TRUE(arap == result({"--style", "cube"}));
  for (const char* energy : {"farap", "acap"}) {
    EXPECT_TRUE(arap != result({"--style", "cube", "--energy", energy}));
    EXPECT_EQ(report({"--style", "cube", "--energy", energy})["regulariser"], energy);
  }
  const json two = report({"--style", "cube", "--iterations", "2"});
  EXPECT_EQ(two["iterations"], 2);
  EXPECT_EQ(two["stop"], "pass limit");
}

TEST_F(Stylizing, DevelopableUnrollsMore) {
  write_mesh(ball_, askew(sphere(1, 3)));
  const json told = report({"--developable", "--tau", "0", "--iterations", "60"});
  EXPECT_EQ(told["method"], "developable");
  EXPECT_EQ(told["regulariser"], "farap");
  EXPECT_EQ(told["lambda"], 1000);
  EXPECT_EQ(told["developable_area"]["before"], 0);
  EXPECT_GT(told["developable_area"]["after"], 0.2);
  const std::string usual = result({"--developable", "--iterations", "5"});
  EXPECT_TRUE(usual == result({"--developable", "--iterations", "5", "--tau", "0.25"}));
  EXPECT_TRUE(usual != result({"--developable", "--iterations", "5", "--tau", "2"}));
}

TEST_F(Stylizing, PolycubesAreBoxes) {
  const json cube = report({"--polycube"}), prism = report({"--polycube", "--style", "prism6"});
  EXPECT_EQ(cube["method"], "polycube");
  EXPECT_EQ(cube["style"], "polycube");
  EXPECT_EQ(prism["style"], "prism6");
  EXPECT_EQ(cube["regulariser"], "farap");
  EXPECT_EQ(cube["lambda"], 10);
  for (const json& told : {cube, prism}) EXPECT_LT(angle(told, "after"), 0.4 * angle(told, "before"));
  EXPECT_TRUE(result({"--polycube"}) == result({"--polycube", "--style", "cube"}));
  EXPECT_EQ(report({"--polycube", "--iterations", "1"})["iterations"], 1);
}

TEST_F(Stylizing, WeightsAreAsAskedFor) {
  // Squeezed, so that triangles are obtuse.
  Mesh mesh = read_mesh(ball_).mesh;
  mesh.positions.col(2) *= 0.2;
  write_mesh(ball_, mesh);
  const std::string usual = result({"--style", "cube"});
  EXPECT_TRUE(usual == result({"--style", "cube", "--weights", "cotangent"}));
  for (const char* weights : {"clamped", "intrinsic"}) {
    EXPECT_TRUE(usual != result({"--style", "cube", "--weights", weights})) << weights;
  }
}

TEST_F(Stylizing, AsPublishedTakesTheNearestVertexAndThePapersScale) {
  const Arguments sphere{"--style", "rounded-cube", "--iterations", "5"};
  const Arguments acap{"--style", "cube", "--energy", "acap", "--iterations", "5"};
  const Arguments arap{"--style", "cube", "--iterations", "5"};
  const auto published = [&](Arguments arguments) {
    arguments.emplace_back("--published");
    return result(arguments);
  };
  EXPECT_TRUE(published(sphere) != result(sphere));
  EXPECT_TRUE(published(acap) != result(acap));
  EXPECT_TRUE(published(arap) == result(arap));
}

TEST_F(Stylizing, AThresholdStandsForTau) {
  const Arguments developable{"--developable", "--iterations", "5"};
  const auto with = [&](const std::string& threshold) {
    Arguments arguments = developable;
    arguments.insert(arguments.end(), {"--threshold", threshold});
    return result(arguments);
  };
  EXPECT_TRUE(with("1e-9") != with("1e-1"));
  EXPECT_TRUE(with("1e-1") != result(developable));
}

TEST_F(Stylizing, HandlesArrive) {
  const Mesh rest = read_mesh(ball_).mesh;
  const Mesh mesh = mesh_of({"--style", "cube", "--pin", "0-4", "--move", "7=0,0,0.25"});
  EXPECT_LT((mesh.positions - rest.positions).topRows(5).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((mesh.positions.row(7) - rest.positions.row(7) - Eigen::RowVector3d(0, 0, 0.25)).norm(), 1e-9);
  EXPECT_LT(report({"--style", "cube", "--pin", "0-4", "--move", "7=0,0,0.25"})["handle_error"], 1e-9);
  Gesture gesture;
  for (int v = 0; v < 5; ++v) gesture.add(v, rest.positions.row(v).transpose());
  gesture.add(7, rest.positions.row(7).transpose() + Eigen::Vector3d(0, 0, 0.25));
  write_gestures(folder_ / "pull.deform", {gesture}, rest.positions);
  const Mesh by_file = mesh_of({"--style", "cube", "--gesture", folder_ / "pull.deform"});
  EXPECT_LT((by_file.positions - mesh.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(Stylizing, AReportHasItsKeysAndAddsUp) {
  const json told = report({"--style", "cube", "--lambda", "3", "--threads", "2"});
  for (const char* key : {"command",
                          "version",
                          "input",
                          "vertices",
                          "triangles",
                          "components",
                          "method",
                          "style",
                          "regulariser",
                          "lambda",
                          "dynamic",
                          "backend",
                          "device",
                          "precision",
                          "threads",
                          "iterations",
                          "stop",
                          "energy",
                          "energy_by_term",
                          "passes",
                          "target_angle_deg",
                          "developable_area",
                          "triangle_quality",
                          "handle_error",
                          "normal_error_deg",
                          "flipped_triangles",
                          "new_self_intersections",
                          "seconds",
                          "memory_mb_by_part",
                          "peak_memory_mb",
                          "warnings"}) {
    EXPECT_TRUE(told.contains(key)) << key;
    EXPECT_FALSE(told.value(key, json()).is_null()) << key;
  }
  EXPECT_EQ(told["command"], "stylize");
  EXPECT_EQ(told["vertices"], 162);
  EXPECT_EQ(told["triangles"], 320);
  EXPECT_EQ(told["handle_error"], 0);
  ASSERT_EQ(told["passes"].size(), told["iterations"]);
  for (const json& pass : told["passes"]) {
    const double energy = pass["energy"], shape = pass["shape"], normals = pass["normals"];
    EXPECT_NEAR(energy, shape + 3 * normals, 1e-9 * energy);
  }
  EXPECT_EQ(told["passes"].back()["energy"], told["energy"]);
  for (const char* when : {"before", "after"}) {
    const json& angles = told["target_angle_deg"][when];
    EXPECT_LE(angles["mean"], angles["percentile_95"]);
    EXPECT_LE(angles["percentile_95"], angles["max"]);
    EXPECT_GT(told["triangle_quality"][when]["mean"], 0.5);
    EXPECT_LE(told["triangle_quality"][when]["least_angle_deg"], told["triangle_quality"][when]["low_angle_deg"]);
  }
}

TEST_F(Stylizing, AnglesInAReportAreThoseOfTheResult) {
  const Arguments how{"--style", "cube", "--energy", "farap"};
  const Mesh mesh = mesh_of(how);
  const Positions vectors = area_vectors(mesh.positions, mesh.triangles);
  double sum = 0;
  for (const auto& vector : vectors.rowwise()) {
    // To the nearest axis, which is the target but for triangles that changed sides in the last pass.
    sum += vector.norm() * std::acos(std::min(1.0, vector.cwiseAbs().maxCoeff() / vector.norm()));
  }
  const double mean = sum / vectors.rowwise().norm().sum() * 180 / M_PI;
  EXPECT_NEAR(angle(report(how), "after"), mean, 0.02);
}

TEST_F(Stylizing, TheSameFromAnyThreadsAndOnADevice) {
  EXPECT_TRUE(result({"--style", "cube", "--threads", "1"}) == result({"--style", "cube", "--threads", "2"}));
  if (!opencl_or_skip(Precision::single)) return;
  const Mesh here = mesh_of({"--style", "cube", "--no-dynamic", "--backend", "cpu"});
  for (const char* precision : {"single", "double"}) {
    if (precision == std::string("double") && !opencl_devices().front().computes_twice) continue;
    const Mesh there = mesh_of({"--style", "cube", "--no-dynamic", "--backend", "opencl", "--precision", precision});
    EXPECT_LT((here.positions - there.positions).cwiseAbs().maxCoeff(), 1e-3) << precision;
    EXPECT_EQ(report({"--style", "cube", "--backend", "opencl", "--precision", precision})["precision"], precision);
  }
}

TEST_F(Stylizing, InterruptedInAPassNothingIsWritten) {
  if (!Terminal::exists()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  const TempFolder out;
  write_mesh(ball_, sphere(1, 6));
  Terminal terminal;
  const Running running = start({"stylize", ball_, "--style", "icosahedron", "--lambda", "20", "-o", out / "result.obj",
                                 "--json", out / "report.json"},
                                "/dev/null", terminal.path());
  ASSERT_TRUE(terminal.wait_for("pass "));
  kill(running.process, SIGINT);
  EXPECT_EQ(running.wait(), 130);
  EXPECT_EQ(names_in(out.path()), std::vector<std::string>{});
}

}  // namespace
}  // namespace swage::test
