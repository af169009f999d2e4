// `swage template fit`.
#include <gmock/gmock.h>
#include <signal.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "opencl_device.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/steps.h"
#include "swage/template_fit.h"
#include "templating.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const Arguments kFitBox = Arguments{"--template", "box"} + kQuick;

Eigen::VectorXd values_in(const json& told, const Template& of) {
  Eigen::VectorXd values = of.defaults();
  for (size_t i = 0; i < of.parameters().size(); ++i) {
    values[static_cast<Eigen::Index>(i)] = told["parameters"][of.parameters()[i].name];
  }
  return values;
}

TemplatePose pose_in(const json& told) {
  TemplatePose pose;
  pose.scale = told["pose"]["scale"];
  const auto offset = told["pose"]["offset"].get<std::array<double, 3>>();
  const auto rotation = told["pose"]["rotation"].get<std::array<std::array<double, 3>, 3>>();
  pose.offset = Eigen::Map<const Eigen::RowVector3d>(offset.data());
  for (size_t u = 0; u < 3; ++u)
    pose.rotation.row(static_cast<int>(u)) = Eigen::Map<const Eigen::RowVector3d>(rotation[u].data());
  return pose;
}

/// Root mean square over the mesh's vertices of the distance to the template's surface as it was told.
double miss(const json& told, const Template& of, const Mesh& mesh) {
  FieldValues field;
  const TemplatePose pose = pose_in(told);
  of.field(*cpu_backend())->evaluate(pose.into(mesh.positions), values_in(told, of), FieldDerivatives::in_space, field);
  const Eigen::ArrayXd off = field.values.array() / field.gradients.rowwise().norm().array();
  return std::sqrt(off.square().mean()) / pose.scale;
}

/// How far off the surface of box_obj(), 1 × 1 × 2 from the origin, at most.
double off_the_box(const Positions& points) {
  double most = 0;
  for (const auto& p : points.rowwise()) {
    const Eigen::Vector3d from_middle = (p.transpose() - Eigen::Vector3d(0.5, 0.5, 1)).cwiseAbs();
    const Eigen::Vector3d beyond = from_middle - Eigen::Vector3d(0.5, 0.5, 1);
    const double inside = beyond.maxCoeff(), outside = beyond.cwiseMax(0).norm();
    most = std::max(most, std::abs(inside > 0 ? outside : inside));
  }
  return most;
}

TEST_F(Templating, AFitTellsWhereTheTemplateLies) {
  const json told = report(Arguments{"fit", model_, "--up", "y"} + kFitBox);
  const Template box = shipped_template("box");
  EXPECT_EQ(told["template"], "box");
  EXPECT_EQ(told["template_document"], json::parse(box.text()));
  EXPECT_EQ(told["parameters"].size(), box.parameters().size());
  EXPECT_LT(told["residual"], 0.01);
  EXPECT_LT(miss(told, box, read_mesh(model_).mesh), 0.03);
  const double scale = told["pose"]["scale"];
  EXPECT_NEAR(told["parameters"]["width"], scale, 0.05 * scale);
  EXPECT_NEAR(told["parameters"]["height"], scale, 0.05 * scale);
  EXPECT_NEAR(told["parameters"]["depth"], 2 * scale, 0.05 * scale);
}

TEST_F(Templating, AReportOfAFit) {
  const json told = report(Arguments{"fit", model_} + kFitBox + Arguments{"--threads", "2"});
  expect_keys(told, {"command",    "version",        "input",        "vertices",
                     "triangles",  "components",     "method",       "template",
                     "parameters", "pose",           "residual",     "largest",
                     "excess",     "at_bound",       "backend",      "device",
                     "precision",  "threads",        "iterations",   "stop",
                     "energy",     "energy_by_term", "handle_error", "normal_error_deg",
                     "seconds",    "peak_memory_mb", "warnings",     "template_document"});
  EXPECT_EQ(told["command"], "template fit");
  EXPECT_EQ(told["input"], model_);
  EXPECT_EQ(told["vertices"], 56);
  EXPECT_EQ(told["threads"], 2);
  EXPECT_GT(told["iterations"], 3);
  EXPECT_EQ(told["handle_error"], told["largest"]);
  EXPECT_GE(told["largest"], told["residual"]);
  EXPECT_LT(told["normal_error_deg"]["mean"], 10);
  EXPECT_GE(told["seconds"]["total"], told["seconds"]["solve"]);
  for (const char* name : {"twist", "width"}) EXPECT_THAT(told["at_bound"].dump(), testing::Not(HasSubstr(name)));
}

TEST_F(Templating, ParametersAtABoundAreNamed) {
  write_text(file("cube.json"), R"({"version": 1, "name": "cube", "parameters": [
      {"name": "x", "default": 1, "min": 0.9, "max": 1.1}, {"name": "y", "default": 1, "min": 0.9, "max": 1.1}],
    "nodes": [{"id": "cube", "type": "box", "size": ["x", "y", 1]}], "root": "cube"})");
  write_mesh(file("long.obj"), box({3, 1, 1}, 4));
  const json told = report(Arguments{"fit", file("long.obj"), "--template", file("cube.json"), "--up", "y"} + kQuick);
  EXPECT_EQ(told["parameters"]["x"], 1.1);
  EXPECT_THAT(told["at_bound"].dump(), HasSubstr("\"x\""));
}

TEST_F(Templating, ATableOfTheFitIsPrinted) {
  const std::string table = out_of(Arguments{"fit", model_} + kFitBox);
  const Template of = shipped_template("box");
  for (const TemplateParameter& parameter : of.parameters()) {
    EXPECT_THAT(table, HasSubstr("  " + parameter.name + " "));
  }
  EXPECT_EQ(out_of(Arguments{"fit", model_, "--json", file("fit.json")} + kFitBox), table);
  EXPECT_THAT(out_of(Arguments{"fit", model_, "-o", "-"} + kFitBox), HasSubstr("\nv "));
}

TEST_F(Templating, AFittedSurfaceLiesInTheMeshsPlace) {
  out_of(Arguments{"fit", model_, "-o", file("surface.ply"), "--resolution", "40"} + kFitBox);
  const Mesh surface = read_mesh(file("surface.ply")).mesh;
  EXPECT_GT(surface.triangles.rows(), 1000);
  EXPECT_LT(off_the_box(surface.positions), 0.1);
  EXPECT_NEAR(volume(surface), 2, 0.1);
}

TEST_F(Templating, WhatIsUpIsAsked) {
  // The same but for its axes: from y up to z up.
  Mesh mesh = box({1, 2.5, 0.6}, 4);
  write_mesh(file("y_up.obj"), mesh);
  const Positions old = mesh.positions;
  mesh.positions << old.col(0), -old.col(2), old.col(1);
  write_mesh(file("z_up.obj"), mesh);
  const auto height = [&](const char* name, const char* up) {
    const json told = report(Arguments{"fit", file(name), "--up", up} + kFitBox);
    return told["parameters"]["height"].get<double>() / told["pose"]["scale"].get<double>();
  };
  EXPECT_NEAR(height("y_up.obj", "y"), 2.5, 0.1);
  EXPECT_NEAR(height("z_up.obj", "z"), 2.5, 0.1);
  EXPECT_GT(std::abs(height("z_up.obj", "y") - 2.5), 0.3);
  EXPECT_LT(report(Arguments{"fit", file("z_up.obj"), "--up", "auto"} + kFitBox)["residual"], 0.01);
}

TEST_F(Templating, AFitIsTheSameAgainAndFromAnyThreads) {
  const auto fit = [&](const Arguments& more, const Arguments& samples = kQuick) {
    const json told = report(Arguments{"fit", model_, "--template", "box"} + samples + more);
    return told["parameters"].dump() + told["pose"].dump() + told["residual"].dump();
  };
  const std::string usual = fit({});
  EXPECT_EQ(fit({"--threads", "1"}), usual);
  EXPECT_EQ(fit({"--seed", "1", "--alpha", "0.3", "--sigmas", "4", "--least-sigma", "0.2", "--fit-iterations", "100",
                 "--up", "auto"}),
            usual);
  for (const Arguments& other : {Arguments{"--seed", "2"},
                                 {"--alpha", "1"},
                                 {"--sigmas", "2"},
                                 {"--least-sigma", "0.5"},
                                 {"--fit-iterations", "2"}}) {
    EXPECT_NE(fit(other), usual) << other.front();
  }
  EXPECT_NE(fit({"--no-turns"}, {"--samples", "500", "--volume-samples", "200"}), usual);
  EXPECT_NE(fit({"--no-turns"}, {"--samples", "400", "--volume-samples", "500"}), usual);
}

TEST_F(Templating, AFitOnADevice) {
  if (!opencl_or_skip(Precision::single)) return;
  const json told = report(Arguments{"fit", model_, "--backend", "opencl"} + kFitBox);
  EXPECT_EQ(told["backend"], "opencl");
  EXPECT_LT(told["residual"], 0.01);
}

TEST_F(Templating, AFitOfManyEvaluationsIsOnADevice) {
  if (!opencl_or_skip(Precision::twice)) return;
  const auto backend = [&](const std::string& iterations) {
    return report({"fit", model_, "--template", "box", "--no-turns", "--samples", "500", "--volume-samples", "0",
                   "--sigmas", "1", "--fit-iterations", iterations})["backend"];
  };
  EXPECT_EQ(backend("100"), "cpu");
  EXPECT_EQ(backend("200"), "opencl");
}

TEST_F(Templating, MeshesThatAreNoCleanSurfaceAreFitted) {
  write_mesh(file("awkward.obj"), awkward());
  write_mesh(file("sheet.obj"), sheet(6));
  write_text(file("lone.obj"), box_obj() + "v 0.5 0.5 1\n");
  write_mesh(file("far.obj"), transformed(box({1, 1, 2}, 3), 1e-3, {1e3, -2e3, 500}));
  for (const char* name : {"awkward.obj", "sheet.obj"}) {
    const json told = report(Arguments{"fit", file(name)} + kFitBox);
    EXPECT_THAT(told["warnings"].dump(), HasSubstr("is not closed and has no inside")) << name;
  }
  for (const char* name : {"lone.obj", "far.obj"}) {
    EXPECT_LT(report(Arguments{"fit", file(name)} + kFitBox)["residual"], 0.01) << name;
  }
}

TEST_F(Templating, AShapeThatIsNotTheTemplatesIsToldOf) {
  write_text(file("ball.json"), R"({"version": 1, "name": "ball", "parameters": [
      {"name": "radius", "default": 1, "min": 0.5, "max": 2}],
    "nodes": [{"id": "ball", "type": "sphere", "radius": "radius"}], "root": "ball"})");
  write_mesh(file("rod.obj"), box({0.2, 0.2, 5}, 4));
  const Outcome outcome =
      run(Arguments{"template", "fit", file("rod.obj"), "--template", file("ball.json"), "--json", file("fit.json")} +
          kQuick);
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("swage: warning: the template is "));
  EXPECT_THAT(json::parse(read_text(file("fit.json")))["warnings"].dump(), HasSubstr("% of the diagonal off"));
}

TEST_F(Templating, APictureOfAFitIsMadeOrTheBuildSaysWhyNot) {
  const Outcome outcome =
      ask(Arguments{"fit", model_, "--picture", file("p.png"), "--picture-size", "600x200"} + kFitBox);
  EXPECT_EQ(outcome.code, can_render() ? 0 : 4);
  EXPECT_EQ(std::filesystem::exists(file("p.png")), can_render());
  if (!can_render()) return;
  const std::string usual = read_text(file("p.png"));
  out_of(Arguments{"fit", model_, "--picture", file("p.png"), "--picture-size", "600x200", "--view", "1,0,0"} +
         kFitBox);
  EXPECT_FALSE(read_text(file("p.png")) == usual);
}

TEST_F(Templating, WhatCannotBeFitted) {
  const Arguments fit{"fit", model_, "--template", "box"};
  expect(2, "MESH", {"fit", "--template", "box"});
  expect(2, "--template", {"fit", model_});
  expect(2, "there is no template 'sofa'", {"fit", model_, "--template", "sofa"});
  expect(3, "missing.json", {"fit", model_, "--template", file("missing.json")});
  const std::vector<std::pair<std::string, std::vector<std::string>>> bad = {{"--samples", {"99", "10000001", "many"}},
                                                                             {"--volume-samples", {"-1", "1e8"}},
                                                                             {"--alpha", {"-1", "nan"}},
                                                                             {"--sigmas", {"0", "21", "1.5"}},
                                                                             {"--least-sigma", {"0", "1.1"}},
                                                                             {"--fit-iterations", {"0"}},
                                                                             {"--seed", {"-1", "x"}},
                                                                             {"--up", {"w", "yy", ""}},
                                                                             {"--resolution", {"1"}}};
  for (const auto& [option, values] : bad) {
    for (const std::string& value : values) expect(2, option, fit + Arguments{option, value});
  }
  expect(2, "use .obj", fit + Arguments{"-o", file("out.fbx")});
  expect(2, "make it first", fit + Arguments{"--json", file("none/fit.json")});
  expect(2, "MESH both name", fit + Arguments{"-o", model_});
  expect(2, "both name", fit + Arguments{"-o", "-", "--json", "-"});
  expect(2, "--view requires --picture", fit + Arguments{"--view", "1,0,0"});
  expect(2, "there is no template", {"fit", file("missing.obj"), "--template", "sofa"});
}

TEST_F(Templating, BadMeshesAreRefusedWithTheirPlace) {
  write_text(file("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write_text(file("short.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n");
  write_text(file("point.obj"), "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  write_text(file("line.obj"), "v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n");
  const auto refuse = [&](const std::string& name, const std::string& says) {
    expect(3, says, {"fit", file(name), "--template", "box", "--json", file("fit.json")});
  };
  refuse("missing.obj", "missing.obj");
  refuse("bad.obj", "bad.obj: line 4");
  refuse("short.obj", "short.obj: line 5: a face has fewer than three vertices");
  refuse("point.obj", "point.obj: ");
  refuse("line.obj", "line.obj: fit_template: triangles: none has an area");
}

TEST_F(Templating, AFullDiskBehindStdoutEndsAFit) {
  for (const Arguments& arguments : {Arguments{"--json", "-"}, {"-o", "-"}, {}}) {
    const Running running =
        start(Arguments{"template", "fit", model_, "--quiet"} + kFitBox + arguments, "/dev/full", file("err"));
    EXPECT_EQ(running.wait(), 4);
    EXPECT_THAT(read_text(file("err")), HasSubstr("stdout"));
  }
}

TEST_F(Templating, AnInterruptedFitWritesNothing) {
  if (!Terminal::exists()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  const TempFolder written;
  for (const char* stage : {"starts", "fit"}) {
    Terminal terminal;
    const Running running = start(
        {"template", "fit", model_, "--template", "couch", "--samples", "100000", "--volume-samples",
         stage == std::string("fit") ? "100" : "100000", "--json", written / "fit.json", "-o", written / "surface.obj"},
        "/dev/null", terminal.path());
    ASSERT_TRUE(terminal.wait_for(stage)) << stage;
    kill(running.process, SIGINT);
    EXPECT_EQ(running.wait(), 130) << stage;
    EXPECT_EQ(names_in(written.path()), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace swage::test
