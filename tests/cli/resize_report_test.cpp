// What `swage resize` tells and shows.
#include <gmock/gmock.h>

#include "resizing.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/style_io.h"

namespace swage::test {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

Vector3d vector_of(const json& list) { return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()}; }

const char* const kCommon[] = {"command",     "version", "input",          "vertices",      "triangles",
                               "components",  "method",  "backend",        "device",        "precision",
                               "threads",     "cells",   "cell_count",     "touched_cells", "vulnerability",
                               "protections", "seconds", "peak_memory_mb", "warnings"};
const char* const kOfResult[] = {"factors",
                                 "anchor",
                                 "iterations",
                                 "stop",
                                 "energy",
                                 "energy_by_term",
                                 "smallest_cell_scale",
                                 "shortest_grid_edge",
                                 "kept_scale",
                                 "scales_at_bound",
                                 "edges_at_bound",
                                 "box_before",
                                 "box_after",
                                 "handle_error",
                                 "normal_error_deg",
                                 "flipped_triangles",
                                 "new_self_intersections",
                                 "seconds_by_stage"};

void expect_names(const json& told, const auto& keys) {
  for (const char* key : keys) {
    EXPECT_TRUE(told.contains(key)) << key;
    EXPECT_FALSE(told.value(key, json()).is_null()) << key;
  }
}

TEST_F(Resizing, AReportOfOneResultHasItOnTheTop) {
  const json told = report({"--scale", "2,1,0.5", "--anchor", "high,low,center", "--protect", "component:1:y=0.75",
                            "--release", "x<1", "--threads", "2"});
  expect_names(told, kCommon);
  expect_names(told, kOfResult);
  EXPECT_FALSE(told.contains("results"));
  EXPECT_EQ(told["command"], "resize");
  EXPECT_EQ(told["method"], "keep shape");
  EXPECT_EQ(told["vertices"], 260);
  EXPECT_EQ(told["components"], 2);
  EXPECT_EQ(told["cells"], (json{20, 8, 5}));
  EXPECT_EQ(told["cell_count"], 800);
  EXPECT_EQ(told["factors"], (json{2, 1, 0.5}));
  EXPECT_EQ(told["anchor"], (json{"high", "low", "center"}));
  EXPECT_EQ(told["protections"], (json{"--protect component:1:y=0.75", "--release x<1"}));
  EXPECT_EQ(told["threads"], 2);
  EXPECT_EQ(told["stop"], "energy settled");
  EXPECT_LT((vector_of(told["box_before"]["low"]) - Vector3d(0, 0, 0)).norm(), 1e-9);
  EXPECT_LT((vector_of(told["box_before"]["high"]) - Vector3d(4, 1.6, 1)).norm(), 1e-9);
  EXPECT_LT((vector_of(told["box_after"]["low"]) - Vector3d(-4, 0, 0.25)).norm(), 1e-5);
  EXPECT_LT((vector_of(told["box_after"]["high"]) - Vector3d(4, 1.6, 0.75)).norm(), 1e-5);
  EXPECT_LT(told["handle_error"], 1e-6);
  double sum = 0;
  for (const json& energy : told["energy_by_term"]) sum += energy.get<double>();
  EXPECT_NEAR(told["energy"], sum, 1e-9 * sum);
  for (const char* stage :
       {"vulnerability", "coverage", "grid", "scales", "assembly", "carry", "precompute", "solve"}) {
    EXPECT_GE(told["seconds_by_stage"][stage], 0) << stage;
  }
}

TEST_F(Resizing, ABoxIsToldAsItCame) {
  const Mesh mesh = mesh_of({"--scale", "3,0.7,1", "--anchor", "center"});
  const json told = report({"--scale", "3,0.7,1", "--anchor", "center"});
  const AlignedBox3d box = box_of(mesh.positions);
  EXPECT_LT((vector_of(told["box_after"]["low"]) - box.min()).norm(), 1e-12);
  EXPECT_LT((vector_of(told["box_after"]["high"]) - box.max()).norm(), 1e-12);
}

TEST_F(Resizing, AReportOfSeveralResultsListsThem) {
  const json told = report({"--scale", "2,1,1", "--scale", "0.2,1,4", "-o", file("out.obj"), "--keep", "size"});
  expect_names(told, kCommon);
  ASSERT_EQ(told["results"].size(), 2U);
  for (const char* key : {"factors", "energy", "stop", "box_after"}) EXPECT_FALSE(told.contains(key)) << key;
  for (const json& result : told["results"]) expect_names(result, kOfResult);
  EXPECT_EQ(told["results"][0]["output"], file("out_1.obj"));
  EXPECT_EQ(told["results"][1]["output"], file("out_2.obj"));
  EXPECT_EQ(told["results"][1]["factors"], (json{0.2, 1, 4}));
  const json alone = report({"--scale", "0.2,1,4", "--keep", "size"});
  for (const char* key : {"energy", "smallest_cell_scale", "shortest_grid_edge", "kept_scale", "box_after",
                          "iterations", "normal_error_deg"}) {
    EXPECT_EQ(told["results"][1][key], alone[key]) << key;
  }
  EXPECT_EQ(told["results"][1]["warnings"], alone["warnings"]);
  EXPECT_GT(alone["warnings"].size(), 0U) << "there is no room to keep sizes";
  const double solve = told["seconds"]["solve"], first = told["results"][0]["seconds_by_stage"]["solve"],
               second = told["results"][1]["seconds_by_stage"]["solve"];
  EXPECT_GE(solve, 0.9 * (first + second));
}

TEST_F(Resizing, WarningsAreToldWithWhatTheyAreOf) {
  const Outcome outcome = run({"resize", model_, "--grid", "20", "--keep", "size", "--scale", "0.2,1,4", "--scale",
                               "1,1,1", "-o", file("out.obj")});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.err, HasSubstr("swage: warning: 0.2 × 1 × 4: along x, "));
  EXPECT_THAT(outcome.err, HasSubstr("20 x 8 x 5 cells, 0.2 × 1 × 4: "));
  EXPECT_THAT(resize({"--keep", "size", "--scale", "0.2,1,4", "-o", file("out.obj")}).err, "") << "quiet";
}

TEST_F(Resizing, ModelsAreLookedAtWithoutATarget) {
  const json told = report({"--vulnerability", file("v.ply"), "--grid-before", file("g.ply")});
  expect_names(told, kCommon);
  for (const char* key : {"factors", "results", "energy"}) EXPECT_FALSE(told.contains(key)) << key;
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"g.ply", "model.obj", "v.ply"}));
}

TEST_F(Resizing, TheVulnerabilityOfTrianglesIsWritten) {
  const json told = report({"--vulnerability", file("v.ply")});
  const Mesh rest = read_mesh(model_).mesh, written = read_mesh(file("v.ply")).mesh;
  EXPECT_EQ(written.positions, rest.positions);
  EXPECT_EQ(written.triangles, rest.triangles);
  const std::map<std::string, Eigen::VectorXd> faces = face_values(file("v.ply"));
  EXPECT_EQ(faces.size(), 9U);
  for (const char* axis : {"x", "y", "z"}) {
    const auto& theta = faces.at(std::string("vulnerability_") + axis);
    const auto &slippage = faces.at(std::string("slippage_") + axis),
               &curvature = faces.at(std::string("curvature_") + axis);
    EXPECT_LT((theta.array() - (slippage.array() * (1e-4 + curvature.array())).min(1)).abs().maxCoeff(), 1e-12);
    EXPECT_LT(theta.head(192).maxCoeff(), 0.01) << "the bar";
    EXPECT_GT(theta.tail(320).mean(), 0.8) << "the ball";
    const json& statistics = told["vulnerability"]["faces"][axis];
    EXPECT_NEAR(statistics["mean"], theta.mean(), 1e-12);
    EXPECT_NEAR(statistics["max"], theta.maxCoeff(), 1e-12);
    EXPECT_NEAR(statistics["share_above_half"], static_cast<double>((theta.array() > 0.5).count()) / 512, 1e-12);
  }
}

TEST_F(Resizing, TheGridIsWrittenBeforeAndAfter) {
  const Outcome outcome = resize({"--scale", "2,1,1", "--scale", "1,3,1", "--grid-before", file("before.ply"),
                                  "--grid-after", file("after.ply"), "--protect", "x>=3:z=0.5"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Mesh before = read_mesh(file("before.ply")).mesh;
  const std::map<std::string, Eigen::VectorXd> rest = face_values(file("before.ply"));
  EXPECT_EQ(rest.size(), 3U);
  EXPECT_LT((box_of(before.positions).sizes() - Vector3d(4, 1.6, 1)).norm(), 1e-9);
  EXPECT_EQ(rest.at("theta_z").maxCoeff(), 1);
  EXPECT_GT((rest.at("theta_z").array() == 0.5).count(), 100);
  const auto check = [&](const char* name, const Vector3d& sizes, int axis, double factor) {
    const Mesh after = read_mesh(file(name)).mesh;
    const std::map<std::string, Eigen::VectorXd> values = face_values(file(name));
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_LT((box_of(after.positions).sizes() - sizes).norm(), 1e-5);
    EXPECT_EQ(values.size(), 6U);
    for (const char* key : {"theta_x", "theta_y", "theta_z"}) EXPECT_EQ(values.at(key), rest.at(key));
    const Eigen::VectorXd& scale = values.at(std::string("scale_") + "xyz"[axis]);
    EXPECT_GT(scale.minCoeff(), 0);
    EXPECT_LE(scale.minCoeff(), factor);
    EXPECT_GE(scale.maxCoeff(), factor);
  };
  check("after_1.ply", {8, 1.6, 1}, 0, 2);
  check("after_2.ply", {4, 4.8, 1}, 1, 3);
}

/// Pictures are looked at through a reader of PNG that is there for normals: its vectors are colours, -1 to 1.
struct ResizePicture : Resizing {
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
  /// What `arguments` draw with `option`.
  NormalPicture picture(const std::string& option, Arguments arguments, const std::string& size = "600x400") const {
    arguments.insert(arguments.end(), {option, file("p.png"), "--picture-size", size});
    const Outcome outcome = resize(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_normal_picture(file("p.png"));
  }
};

/// Dark violet: vulnerable.
long violet(const NormalPicture& picture) {
  long count = 0;
  for (size_t i = 0; i < picture.normals.size(); i += 3) {
    const float red = picture.normals[i], green = picture.normals[i + 1], blue = picture.normals[i + 2];
    count += red < -0.2F && green < -0.4F && blue > green + 0.2F;
  }
  return count;
}

TEST_F(ResizePicture, ShowsResults) {
  const NormalPicture one = picture("--picture", {"--scale", "2,1,1"});
  EXPECT_EQ(std::pair(one.width, one.height), std::pair(600, 400));
  const NormalPicture two = picture("--picture", {"--scale", "2,1,1", "--scale", "1,2,1"}, "600x300");
  EXPECT_EQ(two.width, 600);
  EXPECT_GT(two.height, 300) << "a row for each";
  std::vector<std::string> seen;
  for (Arguments how : std::vector<Arguments>{{}, {"--view", "1,0.1,0"}, {"--up", "z"}, {"--keep", "size"}}) {
    how.insert(how.end(), {"--scale", "2,1.5,1"});
    picture("--picture", how);
    seen.push_back(read_text(file("p.png")));
    for (size_t k = 0; k + 1 < seen.size(); ++k) EXPECT_FALSE(seen[k] == seen.back()) << k << ' ' << seen.size();
  }
}

TEST_F(ResizePicture, ShowsVulnerability) {
  const NormalPicture found = picture("--vulnerability-picture", {});
  EXPECT_EQ(std::pair(found.width, found.height), std::pair(600, 400));
  EXPECT_GT(violet(found), 500) << "the ball, three times";
  const NormalPicture said = picture("--vulnerability-picture", {"--protect", "x>2:y"});
  EXPECT_GT(said.height, 0);
  EXPECT_GT(violet(said), 2 * violet(found)) << "and cells in which the user has a say";
}

TEST_F(ResizePicture, ShowsTheGrid) {
  const NormalPicture rest = picture("--grid-picture", {}), both = picture("--grid-picture", {"--scale", "2,1,1"});
  EXPECT_EQ(std::pair(both.width, both.height), std::pair(600, 400));
  const long bar = violet(picture("--grid-picture", {"--release", "component:1"}));
  EXPECT_GT(violet(rest), bar + 30) << "lines around the ball";
  EXPECT_GT(violet(both), bar + 30);
  EXPECT_GT(violet(picture("--grid-picture", {"--protect", "x>2"})), violet(rest) + 500);
  picture("--grid-picture", {"--scale", "2,1,1"});
  const std::string usual = read_text(file("p.png"));
  picture("--grid-picture", {"--scale", "2,1,1", "--view", "0.1,1,0.2"});
  EXPECT_FALSE(usual == read_text(file("p.png"))) << "from above";
  picture("--grid-picture", {"--scale", "2,1,1", "--view", "0,0,3"});
  EXPECT_TRUE(usual == read_text(file("p.png"))) << "along z as by itself";
  picture("--grid-picture", {"--scale", "2,1,1", "--view", "0,0,-3"});
  EXPECT_FALSE(usual == read_text(file("p.png"))) << "from behind";
}

TEST_F(ResizePicture, IsOfAnySizeAndView) {
  const std::string flat = file("sheet.obj"), line = file("line.obj");
  write_mesh(flat, sheet(3));
  write_text(line, "v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n");
  for (const char* view : {"1,0,0", "0,1,0", "0,0,1"}) {
    for (const std::string& mesh : {flat, line}) {
      const Outcome outcome =
          resize({"--scale", "2,0.5,1", "--scale", "3,1,1", "--picture", file("p.png"), "--vulnerability-picture",
                  file("v.png"), "--grid-picture", file("g.png"), "--view", view, "--picture-size", "64x64"},
                 mesh);
      EXPECT_EQ(outcome.code, 0) << mesh << ' ' << view << ' ' << outcome.err;
    }
  }
  for (const char* size : {"64x64", "1000x64", "64x1000"}) EXPECT_GT(picture("--grid-picture", {}, size).width, 0);
}

TEST_F(Resizing, APictureIsMadeOrTheBuildSaysWhyNot) {
  const Outcome outcome = resize({"--vulnerability-picture", file("p.png"), "--picture-size", "64x64"});
  EXPECT_EQ(outcome.code, can_render() ? 0 : 4);
  EXPECT_EQ(std::filesystem::exists(file("p.png")), can_render());
  if (!can_render()) {
    EXPECT_THAT(outcome.err, HasSubstr("SWAGE_RENDER"));
  }
}

}  // namespace
}  // namespace swage::test
