// `swage template list`, `show` and `mesh`.
#include <gmock/gmock.h>

#include <sstream>

#include "opencl_device.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/template.h"
#include "templating.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A ball of two parameters, in a file.
const char* const kBall = R"({"version": 1, "name": "ball", "description": "Round.", "up": "z",
  "parameters": [{"name": "radius", "default": 1, "min": 0.5, "max": 2, "group": "size", "description": "Of it."},
                 {"name": "height", "default": 0, "min": -1, "max": 1}],
  "nodes": [{"id": "ball", "type": "sphere", "radius": "radius"},
            {"id": "placed", "type": "translate", "of": "ball", "by": [0, 0, "height"]}], "root": "placed"})";

struct TemplateFile : Templating {
  TemplateFile() { write_text(ball_, kBall); }
  std::string ball_ = file("ball.json");
};

TEST_F(Templating, AreListed) {
  const std::string table = out_of({"list"});
  const json told = report({"list"});
  EXPECT_EQ(told["command"], "template list");
  ASSERT_EQ(told["templates"].size(), shipped_templates().size());
  for (size_t i = 0; i < shipped_templates().size(); ++i) {
    const Template of = shipped_template(shipped_templates()[i]);
    EXPECT_EQ(told["templates"][i]["name"], shipped_templates()[i]);
    EXPECT_EQ(told["templates"][i]["parameters"], of.parameters().size());
    EXPECT_EQ(told["templates"][i]["description"], of.description());
    EXPECT_THAT(table, HasSubstr(std::to_string(of.parameters().size()) + " parameters  " + of.description()));
  }
  EXPECT_EQ(out_of({"list", "--json", file("list.json")}), table);
  EXPECT_EQ(json::parse(read_text(file("list.json"))), told);
}

TEST_F(Templating, AreShown) {
  for (const std::string& name : shipped_templates()) {
    const Template of = shipped_template(name);
    const json told = report({"show", name});
    const std::string table = out_of({"show", name});
    EXPECT_THAT(table, HasSubstr(of.description()));
    ASSERT_EQ(told["parameters"].size(), of.parameters().size());
    for (size_t i = 0; i < of.parameters().size(); ++i) {
      const TemplateParameter& parameter = of.parameters()[i];
      EXPECT_EQ(told["parameters"][i], (json{{"name", parameter.name},
                                             {"value", parameter.value},
                                             {"default", parameter.value},
                                             {"min", parameter.least},
                                             {"max", parameter.most},
                                             {"group", parameter.group},
                                             {"description", parameter.description}}));
      EXPECT_THAT(table, HasSubstr("  " + parameter.name + " "));
      EXPECT_THAT(table, HasSubstr(parameter.description));
    }
    EXPECT_EQ(out_of({"show", name, "--text"}), of.text());
  }
}

TEST_F(TemplateFile, IsShown) {
  const json told = report({"show", ball_});
  EXPECT_EQ(told["template"], ball_);
  EXPECT_EQ(told["name"], "ball");
  EXPECT_EQ(told["up"], "z");
  EXPECT_EQ(told["parameters"][1]["min"], -1);
  EXPECT_THAT(out_of({"show", ball_}), HasSubstr("ball: Round. z is up."));
  write_text(file("again.json"), out_of({"show", ball_, "--text"}));
  EXPECT_EQ(report({"show", file("again.json")})["parameters"], told["parameters"]);
}

TEST_F(TemplateFile, ValuesAreSetOneAfterTheOther) {
  const auto radius = [&](const Arguments& settings) -> double {
    return report(Arguments{"show", ball_} + settings)["parameters"][0]["value"];
  };
  EXPECT_EQ(radius({"--set", "radius=1.5"}), 1.5);
  EXPECT_EQ(radius({"--set", " radius = 1.5"}), 1.5);
  EXPECT_EQ(radius({"--set", "radius*=1.5"}), 1.5);
  EXPECT_EQ(radius({"--set", "radius+=-0.25"}), 0.75);
  EXPECT_EQ(radius({"--set", "radius=5e-1", "height=0.5", "radius*=3"}), 1.5);
  EXPECT_EQ(radius({"--set", "radius*=3", "--set", "radius=0.5"}), 0.5);
  EXPECT_EQ(radius({"--set", "radius=7", "--beyond"}), 7);
  EXPECT_THAT(out_of({"show", ball_, "--set", "radius=1.25"}), HasSubstr("radius        1.25       0.5 to 2"));
}

TEST_F(TemplateFile, SettingsThatAreNotUnderstood) {
  const auto refuse = [&](const std::string& setting, const std::string& says) {
    for (const char* command : {"show", "mesh"}) {
      Arguments arguments{command, ball_, "--set", setting};
      if (command == std::string("mesh")) arguments.insert(arguments.end(), {"-o", file("out.obj")});
      expect(2, "--set " + setting + ": " + says, arguments);
    }
  };
  for (const char* setting : {"radius", "", "=1", "*=1", "+=2"}) refuse(setting, "write NAME=VALUE");
  for (const char* value : {"", "a", "1x", "nan", "inf", "1,,2", "1,b"}) {
    refuse(std::string("radius=") + value, std::string("'") + value + "' is no number");
  }
  refuse("width=1", "template ball: there is no parameter 'width'; there are radius, height");
  refuse("radius=0.49", "radius would be 0.49, and is from 0.5 to 2 (--beyond");
  refuse("height*=1e9,1", "give one value here");
  refuse("radius*=2.5", "radius would be 2.5, and is from 0.5 to 2");
  refuse("radius=1,1.5", "give one value here");
  expect(2, "--set radius*=1e300: radius is no longer finite",
         {"show", ball_, "--beyond", "--set", "radius=1e300", "radius*=1e300"});
}

TEST_F(TemplateFile, TemplatesThatAreNotThere) {
  for (const Arguments& rest : {Arguments{"show"}, {"mesh", "-o", file("out.obj")}}) {
    const auto with = [&](const std::string& name) {
      Arguments arguments = rest;
      arguments.insert(arguments.begin() + 1, name);
      return arguments;
    };
    expect(2, "there is no template 'sofa'; there are airplane, box", with("sofa"));
    expect(2, "or name a .json file", with(""));
    expect(3, file("missing.json"), with(file("missing.json")));
    std::string bad = kBall;
    bad.replace(bad.find("\"sphere\""), 8, "\"globe\"");
    write_text(file("bad.json"), bad);
    expect(3, "bad.json: nodes[0].type: ", with(file("bad.json")));
    write_text(file("half.json"), std::string(kBall).substr(0, 90));
    expect(3, "half.json: line 2", with(file("half.json")));
    expect(2, "TEMPLATE", {rest.front()});
  }
}

TEST_F(TemplateFile, SurfacesAreThoseOfTheLibrary) {
  EXPECT_EQ(out_of({"mesh", "mug", "-o", file("mug.ply"), "--resolution", "40", "--set", "height*=1.2"}), "");
  const Template mug = shipped_template("mug");
  Eigen::VectorXd values = mug.defaults();
  values[mug.parameter("height")] *= 1.2;
  const Mesh expected = template_mesh(mug, values, {40, nullptr}), made = read_mesh(file("mug.ply")).mesh;
  EXPECT_EQ(made.triangles, expected.triangles);
  EXPECT_LT((made.positions - expected.positions).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(TemplateFile, SurfacesAreOfTheirSize) {
  for (const char* name : {"ball.obj", "ball.off", "ball.stl", "ball.ply"}) {
    out_of({"mesh", ball_, "-o", file(name), "--resolution", "30", "--set", "radius=1.5", "height=0.5"});
    const Positions positions = read_mesh(file(name)).mesh.positions;
    const Eigen::VectorXd radii = (positions.rowwise() - Eigen::RowVector3d(0, 0, 0.5)).rowwise().norm();
    EXPECT_LT((radii.array() - 1.5).abs().maxCoeff(), 0.01) << name;
    EXPECT_GT(positions.rows(), 1000) << name;
  }
}

TEST_F(TemplateFile, ASurfaceGoesToStdoutAsObj) {
  const std::string text = out_of({"mesh", ball_, "-o", "-", "--resolution", "12"});
  out_of({"mesh", ball_, "-o", file("ball.obj"), "--resolution", "12"});
  EXPECT_TRUE(text == read_text(file("ball.obj")));
  EXPECT_TRUE(text == out_of({"mesh", ball_, "-o", "-", "--resolution", "12", "--threads", "1"}));
}

TEST_F(TemplateFile, AReportOfASurface) {
  const json told = report({"mesh", ball_, "-o", file("ball.obj"), "--resolution", "20", "--set", "radius=1.5"});
  expect_keys(told,
              {"command", "version", "input", "vertices", "triangles", "components", "method", "template", "parameters",
               "resolution", "backend", "device", "precision", "threads", "seconds", "peak_memory_mb", "warnings"});
  EXPECT_EQ(told["command"], "template mesh");
  EXPECT_EQ(told["input"], ball_);
  EXPECT_EQ(told["parameters"], (json{{"radius", 1.5}, {"height", 0}}));
  EXPECT_EQ(told["components"], 1);
  EXPECT_EQ(told["triangles"], read_mesh(file("ball.obj")).mesh.triangles.rows());
}

TEST_F(TemplateFile, SurfacesAreMadeOnADeviceToo) {
  if (!opencl_or_skip(Precision::single)) return;
  const json told = report({"mesh", ball_, "-o", file("ball.obj"), "--resolution", "20", "--backend", "opencl"});
  EXPECT_EQ(told["backend"], "opencl");
  const Eigen::VectorXd radii = read_mesh(file("ball.obj")).mesh.positions.rowwise().norm();
  EXPECT_LT((radii.array() - 1).abs().maxCoeff(), 0.02);
}

TEST_F(TemplateFile, WhatCannotBeAMesh) {
  const Arguments mesh{"mesh", ball_};
  expect(2, "nothing to write", mesh);
  expect(2, "use .obj", mesh + Arguments{"-o", file("out.fbx")});
  expect(2, "make it first", mesh + Arguments{"-o", file("none/out.obj")});
  expect(2, "different", mesh + Arguments{"-o", "-", "--json", "-"});
  expect(2, "TEMPLATE both name", mesh + Arguments{"--json", ball_});
  for (const char* resolution : {"7", "1025", "many", "20.5"}) {
    expect(2, "--resolution", mesh + Arguments{"-o", file("out.obj"), "--resolution", resolution});
  }
  expect(2, "--picture-size requires --picture", mesh + Arguments{"-o", file("out.obj"), "--picture-size", "64x64"});
  // Larger than where surfaces are looked for.
  expect(4, "no surface", mesh + Arguments{"-o", file("out.obj"), "--beyond", "--set", "radius=1000"});
  expect(2, "excludes --text", {"show", ball_, "--text", "--json", file("a.json")});
}

TEST_F(TemplateFile, APictureIsMadeOrTheBuildSaysWhyNot) {
  const Arguments picture{"mesh",           ball_,     "--resolution", "20",
                          "--picture-size", "300x200", "--picture",    file("ball.png")};
  const Outcome outcome = ask(picture);
  EXPECT_EQ(outcome.code, can_render() ? 0 : 4);
  EXPECT_EQ(std::filesystem::exists(file("ball.png")), can_render());
  if (!can_render()) return;
  const std::string usual = read_text(file("ball.png"));
  for (const Arguments& how : {Arguments{"--view", "1,0.1,0"}, {"--set", "radius=0.5"}}) {
    out_of(picture + how);
    EXPECT_FALSE(read_text(file("ball.png")) == usual) << how.front();
  }
}

TEST_F(Templating, SomethingIsToBeDone) {
  expect(2, "list, show, mesh, fit, edit, retarget or interpolate", {});
  expect(2, "melt", {"melt"});
  for (const Arguments& level : {Arguments{}, {"list"}, {"show"}, {"mesh"}, {"fit"}}) {
    EXPECT_THAT(out_of(level + Arguments{"--help"}), HasSubstr("--threads")) << level.size();
    EXPECT_THAT(out_of(level + Arguments{"--version"}), testing::StartsWith("swage 0."));
  }
  EXPECT_THAT(run({"--help"}).out, HasSubstr("template"));
}

}  // namespace
}  // namespace swage::test
