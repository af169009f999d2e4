// `swage template edit`, `retarget` and `interpolate`: what becomes of meshes.
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "opencl_device.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/template_edit.h"
#include "templating.h"

namespace swage::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

/// Of boxes, which fit as well lying as standing.
const Arguments kFitting = kQuick + Arguments{"--up", "y"};
/// Where it does not matter whether the mesh comes to rest.
const Arguments kFew{"--passes", "50", "--sub-edits", "1"};

/// With a fit of the box template to the mesh, made once.
struct TemplateEditing : Templating {
  TemplateEditing() {
    static const std::string made = out_of(Arguments{"fit", model_, "--template", "box", "--json", "-"} + kFitting);
    write_text(fit_, made);
  }

  Mesh mesh_of(Arguments arguments) const {
    arguments.insert(arguments.end(), {"-o", "-"});
    write_text(file("back.obj"), out_of(arguments));
    return read_mesh(file("back.obj")).mesh;
  }
  Vector3d sizes_of(const Arguments& arguments) const {
    const Positions positions = mesh_of(arguments).positions;
    return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).transpose();
  }

  std::string fit_ = file("fit.json");
  Arguments edit_{"edit", model_, "--fit", fit_};
};

TEST_F(TemplateEditing, OnlyVerticesAndNormalsChange) {
  const std::vector<std::string> before = lines(box_obj()),
                                 after = lines(out_of(edit_ + Arguments{"--set", "width*=1.5", "twist=20", "-o", "-"}));
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

TEST_F(TemplateEditing, TheMeshFollowsTheParameters) {
  EXPECT_LT((sizes_of(edit_ + Arguments{"--set", "width*=1.5"}) - Vector3d(1.5, 1, 2)).norm(), 0.06);
  EXPECT_LT((sizes_of(edit_ + Arguments{"--set", "height*=0.7", "--set", "depth*=1.2"}) - Vector3d(1, 0.7, 2.4)).norm(),
            0.06);
  EXPECT_LT((sizes_of(edit_ + Arguments{"--set", "width*=1.5", "width*=2", "width*=0.5"}) - Vector3d(1.5, 1, 2)).norm(),
            0.06);
}

TEST_F(TemplateEditing, WithoutAnEditNothingMoves) {
  const Mesh rest = read_mesh(model_).mesh;
  EXPECT_LT((mesh_of(edit_ + Arguments{"--set", "width*=1"}).positions - rest.positions).cwiseAbs().maxCoeff(), 1e-9);
  const Outcome outcome = run(Arguments{"template"} + edit_ + Arguments{"-o", file("out.obj")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("nothing is set with --set: the mesh stays as it is"));
  EXPECT_LT((read_mesh(file("out.obj")).mesh.positions - rest.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(TemplateEditing, AFitOnTheSpotIsTheSame) {
  const std::string set = "width*=1.5";
  const Arguments spot = Arguments{"edit", model_, "--template", "box", "--set", set} + kFitting + kFew;
  EXPECT_TRUE(out_of(spot + Arguments{"-o", "-"}) == out_of(edit_ + Arguments{"--set", set, "-o", "-"} + kFew));
  const json told = report(spot), by_file = report(edit_ + Arguments{"--template", "box", "--set", set} + kFew);
  EXPECT_EQ(told["parameters"], by_file["parameters"]);
  EXPECT_EQ(told["fit"]["residual"], json::parse(read_text(fit_))["residual"]);
  EXPECT_EQ(told["fit"]["backend"], json::parse(read_text(fit_))["backend"]);
  EXPECT_EQ(by_file["fit"], (json{{"file", fit_}}));
}

TEST_F(TemplateEditing, AReportOfOneEdit) {
  const json told = report(edit_ + Arguments{"--set", "width*=1.5", "height+=0.1"});
  expect_keys(told, {"command",
                     "version",
                     "input",
                     "vertices",
                     "triangles",
                     "components",
                     "method",
                     "backend",
                     "device",
                     "precision",
                     "threads",
                     "template",
                     "fit",
                     "pose",
                     "parameters_before",
                     "set",
                     "parameters",
                     "iterations",
                     "stop",
                     "energy",
                     "energy_by_term",
                     "residual",
                     "largest",
                     "handle_error",
                     "normal_error_deg",
                     "flipped_triangles",
                     "new_self_intersections",
                     "seconds",
                     "peak_memory_mb",
                     "warnings",
                     "template_document"});
  EXPECT_EQ(told["command"], "template edit");
  EXPECT_EQ(told["template"], "box");
  EXPECT_EQ(told["set"], "width*=1.5 height+=0.1");
  EXPECT_EQ(told["flipped_triangles"], 0);
  EXPECT_EQ(told["handle_error"], told["largest"]);
  EXPECT_LT(told["largest"], 0.005);
  json expected = json::parse(read_text(fit_))["parameters"];
  EXPECT_EQ(told["parameters_before"], expected);
  expected["width"] = expected["width"].get<double>() * 1.5;
  expected["height"] = expected["height"].get<double>() + 0.1;
  EXPECT_EQ(told["parameters"], expected);
}

TEST_F(TemplateEditing, AnEditGoesOnFromAnothersReport) {
  out_of(edit_ + Arguments{"--set", "width*=1.5", "-o", file("wide.obj"), "--json", file("wide.json")});
  const Arguments again{"edit", file("wide.obj"), "--fit", file("wide.json"), "--set", "height*=1.5"};
  EXPECT_LT((sizes_of(again) - Vector3d(1.5, 1.5, 2)).norm(), 0.08);
}

TEST_F(TemplateEditing, SeveralValuesAreSeveralResults) {
  const Arguments edit = edit_ + kFew;
  const json told = report(edit + Arguments{"--set", "width*=1.2,1.5,2", "height*=1.1", "-o", file("out.obj")});
  EXPECT_EQ(names_in(folder_.path()),
            (std::vector<std::string>{"fit.json", "model.obj", "out_1.obj", "out_2.obj", "out_3.obj"}));
  ASSERT_EQ(told["results"].size(), 3U);
  for (const char* key : {"parameters", "energy", "stop", "set"}) EXPECT_FALSE(told.contains(key)) << key;
  const std::vector<std::string> values{"1.2", "1.5", "2"};
  for (size_t r = 0; r < values.size(); ++r) {
    const json& result = told["results"][r];
    const std::string path = file("out_" + std::to_string(r + 1) + ".obj");
    expect_keys(result, {"set", "parameters", "output", "iterations", "stop", "residual", "largest",
                         "flipped_triangles", "normal_error_deg", "warnings"});
    EXPECT_EQ(result["output"], path);
    EXPECT_EQ(result["set"], "width*=" + values[r] + " height*=1.1");
    EXPECT_TRUE(read_text(path) == out_of(edit + Arguments{"--set", "width*=" + values[r], "height*=1.1", "-o", "-"}))
        << "what each is alone: " << r;
  }
}

TEST_F(TemplateEditing, TheMeshItselfMayBeOverwritten) {
  out_of(edit_ + Arguments{"--set", "width*=1.5", "-o", model_});
  const Positions positions = read_mesh(model_).mesh.positions;
  EXPECT_NEAR(positions.col(0).maxCoeff() - positions.col(0).minCoeff(), 1.5, 0.02);
}

TEST_F(TemplateEditing, OtherFormatsAndMeshesOfTheSamePlace) {
  write_mesh(file("fine.ply"), box({1, 1, 2}, 8));
  for (const char* name : {"out.ply", "out.off", "out.obj"}) {
    out_of({"edit", file("fine.ply"), "--fit", fit_, "--set", "width*=1.5", "-o", file(name)});
    const Mesh mesh = read_mesh(file(name)).mesh;
    EXPECT_EQ(mesh.positions.rows(), 6 * 64 + 2);
    EXPECT_NEAR(mesh.positions.col(0).maxCoeff() - mesh.positions.col(0).minCoeff(), 1.5, 0.02) << name;
  }
  const Outcome outcome =
      run(Arguments{"template", "edit", file("fine.ply"), "--fit", fit_, "--set", "width*=1.5", "-o", file("out.ply")} +
          kFew);
  EXPECT_THAT(outcome.err, HasSubstr("fit.json is of a mesh of 56 vertices and 108 triangles"));
}

TEST_F(TemplateEditing, TheSameFromAnyThreadsAndOnADevice) {
  const Arguments edit = edit_ + kFew + Arguments{"--set", "width*=1.5", "twist=15"}, out{"-o", "-"};
  EXPECT_TRUE(out_of(edit + out + Arguments{"--threads", "1"}) == out_of(edit + out + Arguments{"--threads", "2"}));
  if (!opencl_or_skip(Precision::single)) return;
  const Mesh here = mesh_of(edit + Arguments{"--backend", "cpu"}),
             there = mesh_of(edit + Arguments{"--backend", "opencl"});
  EXPECT_LT((here.positions - there.positions).cwiseAbs().maxCoeff(), 1e-2);
}

TEST_F(TemplateEditing, OptionsOfTheSolveCount) {
  const Arguments set{"--set", "width*=1.1", "twist=5", "-o", "-"};
  const std::string usual = out_of(edit_ + set);
  EXPECT_TRUE(out_of(edit_ + set +
                     Arguments{"--tracking", "1", "--smoothing", "0.1", "--feature-angle", "30", "--sub-edits", "0",
                               "--passes", "1000", "--tolerance", "1e-5"}) == usual);
  for (const Arguments& other : {Arguments{"--tracking", "10"}, {"--passes", "1"}, {"--sub-edits", "1"}}) {
    EXPECT_FALSE(out_of(edit_ + set + other) == usual) << other.front();
  }
}

TEST_F(TemplateEditing, RetargetingIsTheLibrarys) {
  write_mesh(file("target.obj"), transformed(box({2, 1, 1}, 5), 3, {10, 0, -5}));
  const Arguments retarget = Arguments{"retarget", model_, file("target.obj"), "--template", "box"} + kFitting;
  const Mesh made = mesh_of(retarget);
  const MeshFile source = read_mesh(model_), target = read_mesh(file("target.obj"));
  RetargetOptions options;
  options.source.surface_samples = options.target.surface_samples = 400;
  options.source.volume_samples = options.target.volume_samples = 200;
  options.source.turns = options.target.turns = false;
  options.source.up = options.target.up = 'y';
  const RetargetResult expected = swage::retarget(shipped_template("box"), source.mesh.positions, source.mesh.triangles,
                                                  target.mesh.positions, target.mesh.triangles, options);
  EXPECT_LT((made.positions - expected.edit.positions).cwiseAbs().maxCoeff(), 1e-6);
  const Vector3d low = made.positions.colwise().minCoeff(), high = made.positions.colwise().maxCoeff();
  EXPECT_LT((low - Vector3d(10, 0, -5)).norm(), 0.3);
  EXPECT_LT((high - Vector3d(16, 3, -2)).norm(), 0.3);
}

TEST_F(TemplateEditing, RetargetingTakesFitsToo) {
  write_mesh(file("target.obj"), transformed(box({2, 1, 1}, 5), 3, {10, 0, -5}));
  const Arguments retarget = Arguments{"retarget", model_, file("target.obj")} + kFew;
  const std::string usual = out_of(retarget + Arguments{"--template", "box", "-o", "-"} + kFitting);
  out_of(Arguments{"fit", file("target.obj"), "--template", "box", "--json", file("target.json")} + kFitting);
  EXPECT_TRUE(out_of(retarget + Arguments{"--source-fit", fit_, "-o", "-"} + kFitting) == usual);
  EXPECT_TRUE(out_of(retarget + Arguments{"--target-fit", file("target.json"), "-o", "-"} + kFitting) == usual);
  EXPECT_TRUE(out_of(retarget + Arguments{"--source-fit", fit_, "--target-fit", file("target.json"), "-o", "-"}) ==
              usual);
  expect(2, "is of a fit, and both are given",
         retarget + Arguments{"--source-fit", fit_, "--target-fit", file("target.json"), "-o", file("out.obj")} +
             kFitting);
  const json told =
      report(retarget + Arguments{"--source-fit", fit_, "--template", "box", "-o", file("out.obj")} + kFitting);
  expect_keys(told, {"command", "input", "target", "template", "parameters", "pose", "parameters_before", "pose_before",
                     "source_fit", "target_fit", "residual", "largest", "flipped_triangles", "iterations", "stop",
                     "seconds", "warnings", "template_document"});
  EXPECT_EQ(told["command"], "template retarget");
  EXPECT_EQ(told["source_fit"], (json{{"file", fit_}}));
  EXPECT_EQ(told["parameters"], json::parse(read_text(file("target.json")))["parameters"]);
  write_text(file("told.json"), told.dump());
  EXPECT_EQ(
      ask({"edit", file("out.obj"), "--fit", file("told.json"), "--set", "height*=1.1", "-o", file("more.obj")}).code,
      0);
}

TEST_F(TemplateEditing, AnInterpolationBeginsAndEndsAtFits) {
  json to = json::parse(read_text(fit_));
  to["parameters"]["width"] = to["parameters"]["width"].get<double>() * 2;
  write_text(file("to.json"), to.dump());
  const json told = report(
      {"interpolate", model_, "--fit", fit_, "--to", file("to.json"), "--frames", "5", "-o", file("out_%03d.obj")});
  expect_keys(told, {"command", "input", "template", "fit", "to", "pose", "frames", "seconds", "warnings"});
  ASSERT_EQ(told["frames"].size(), 5U);
  EXPECT_EQ(told["frames"][0]["parameters"], json::parse(read_text(fit_))["parameters"]);
  EXPECT_EQ(told["frames"][4]["parameters"], to["parameters"]);
  EXPECT_LT((read_mesh(file("out_001.obj")).mesh.positions - read_mesh(model_).mesh.positions).cwiseAbs().maxCoeff(),
            1e-9);
  for (int f = 0; f < 5; ++f) {
    const std::string path = file("out_00" + std::to_string(f + 1) + ".obj");
    EXPECT_EQ(told["frames"][static_cast<size_t>(f)]["output"], path);
    const Positions positions = read_mesh(path).mesh.positions;
    EXPECT_NEAR(positions.col(0).maxCoeff() - positions.col(0).minCoeff(), 1 + f / 4.0, 0.05) << f;
  }
}

TEST_F(TemplateEditing, FramesAreNumberedSoThatTheySort) {
  const auto names = [&](const std::string& output, const char* frames) {
    const TempFolder out;
    out_of({"interpolate", model_, "--fit", fit_, "--set", "width*=1.1", "--frames", frames, "--passes", "1", "-o",
            out / output});
    return names_in(out.path());
  };
  EXPECT_EQ(names("a.obj", "2"), (std::vector<std::string>{"a_1.obj", "a_2.obj"}));
  EXPECT_EQ(names("a.obj", "11").front(), "a_01.obj");
  EXPECT_EQ(names("a%d.obj", "2"), (std::vector<std::string>{"a1.obj", "a2.obj"}));
  EXPECT_EQ(names("%04d-a.ply", "2"), (std::vector<std::string>{"0001-a.ply", "0002-a.ply"}));
}

TEST_F(TemplateEditing, PicturesAreMadeOrTheBuildSaysWhyNot) {
  write_mesh(file("target.obj"), box({2, 1, 1}, 3));
  for (const Arguments& arguments :
       {edit_ + Arguments{"--set", "width*=1.2,2"},
        Arguments{"retarget", model_, file("target.obj"), "--source-fit", fit_} + kFitting,
        Arguments{"interpolate", model_, "--fit", fit_, "--set", "width*=2", "--frames", "6"}}) {
    const std::string path = file(arguments.front() + ".png");
    const Outcome outcome = ask(arguments + kFew + Arguments{"--picture", path, "--picture-size", "400x200"});
    EXPECT_EQ(outcome.code, can_render() ? 0 : 4) << outcome.err;
    EXPECT_EQ(std::filesystem::exists(path), can_render());
  }
}

}  // namespace
}  // namespace swage::test
