// What edits by templates refuse, above all of fits in files, and how they are interrupted.
#include <gmock/gmock.h>
#include <signal.h>

#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/template.h"
#include "templating.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A fit as it would be of the model, written by hand: the box template lies as the box does.
json fit_of_the_model() {
  const Template of = shipped_template("box");
  json parameters;
  for (const TemplateParameter& parameter : of.parameters()) parameters[parameter.name] = parameter.value;
  parameters["depth"] = 2;
  return {{"template", "box"},
          {"vertices", 56},
          {"triangles", 108},
          {"parameters", parameters},
          {"pose", {{"scale", 1}, {"rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {"offset", {-0.5, -0.5, -1}}}},
          {"template_document", json::parse(of.text())}};
}

struct TemplateUsage : Templating {
  TemplateUsage() { write_text(fit_, fit_of_the_model().dump()); }

  /// By every command that reads a fit.
  void expect_fit(int code, const std::string& says, const std::string& text) const {
    write_text(file("bad.json"), text);
    const std::string bad = file("bad.json"), out = file("out.obj");
    for (const Arguments& arguments : {Arguments{"edit", model_, "--fit", bad, "--set", "width=1", "-o", out},
                                       {"interpolate", model_, "--fit", bad, "--set", "width=1", "-o", out},
                                       {"interpolate", model_, "--fit", fit_, "--to", bad, "-o", out},
                                       {"retarget", model_, model_, "--source-fit", bad, "-o", out},
                                       {"retarget", model_, model_, "--target-fit", bad, "-o", out}}) {
      expect(code, "bad.json: " + says, arguments);
    }
  }
  void expect_fit(const std::string& says, const json& fit) const { expect_fit(3, says, fit.dump()); }

  std::string fit_ = file("fit.json");
  Arguments edit_{"edit", model_, "--fit", fit_, "--set", "width=1.2"};
};

TEST_F(TemplateUsage, AFitWrittenByHandIsTaken) {
  EXPECT_EQ(ask(edit_ + Arguments{"-o", file("out.obj")}).code, 0);
  const Positions positions = read_mesh(file("out.obj")).mesh.positions;
  EXPECT_NEAR(positions.col(0).minCoeff(), -0.1, 0.02);
  EXPECT_NEAR(positions.col(0).maxCoeff(), 1.1, 0.02);
}

TEST_F(TemplateUsage, FitsThatLackSomething) {
  for (const char* key : {"template_document", "parameters", "pose", "vertices", "triangles"}) {
    json fit = fit_of_the_model();
    fit.erase(key);
    expect_fit(std::string(key) + ": is missing; make it anew by swage template fit --json", fit);
  }
  for (const char* key : {"scale", "rotation", "offset"}) {
    json fit = fit_of_the_model();
    fit["pose"].erase(key);
    expect_fit(std::string("pose.") + key + ": is missing", fit);
  }
  json fit = fit_of_the_model();
  fit["parameters"].erase("twist");
  expect_fit("parameters.twist: is missing", fit);
}

TEST_F(TemplateUsage, FitsOfWrongValues) {
  const auto with = [](const char* pointer, const json& value) {
    json fit = fit_of_the_model();
    fit[json::json_pointer(pointer)] = value;
    return fit;
  };
  expect_fit("parameters.width: a finite number is expected, not null", with("/parameters/width", nullptr));
  expect_fit("parameters.width: a finite number is expected, not \"1\"", with("/parameters/width", "1"));
  expect_fit("parameters.girth: the template box has no such parameter", with("/parameters/girth", 1));
  expect_fit("parameters: an object is expected", with("/parameters", json::array()));
  expect_fit("pose: an object is expected", with("/pose", 1));
  expect_fit("pose.scale: is not above 0", with("/pose/scale", 0));
  expect_fit("pose.offset: three numbers are expected", with("/pose/offset", {1, 2}));
  expect_fit("pose.offset[1]: a finite number is expected", with("/pose/offset/1", nullptr));
  expect_fit("pose.rotation: three rows are expected", with("/pose/rotation", {1, 2}));
  expect_fit("pose.rotation[2]: three numbers are expected", with("/pose/rotation/2", 1));
  expect_fit("pose.rotation[0][0]: a finite number is expected", with("/pose/rotation/0/0", "x"));
  expect_fit("pose.rotation: is no rotation", with("/pose/rotation/0/0", 2));
  expect_fit("pose.rotation: is no rotation", with("/pose/rotation/0/0", -1));
  expect_fit("pose.tilt: a pose has scale, rotation and offset", with("/pose/tilt", 1));
  expect_fit("vertices: a count is expected, not -1", with("/vertices", -1));
  expect_fit("triangles: a count is expected, not 1.5", with("/triangles", 1.5));
  expect_fit("template_document: parameters[0].min: is not below max", with("/template_document/parameters/0/min", 9));
  expect_fit("template_document: root", with("/template_document/root", "roof"));
}

TEST_F(TemplateUsage, FitsThatAreNoJson) {
  expect_fit(3, "line 1: not valid JSON; mend it", "");
  expect_fit(3, "line 2: not valid JSON; mend it", "{\n\"parameters\": NaN}");
  expect_fit(3, "an object is expected", "[]");
  expect_fit(3, "template_document: is missing", "{}");
  expect_fit(3, "holds a number beyond double precision; mend it", "{\"vertices\": 1e999}");
  std::string twice = fit_of_the_model().dump();
  twice.insert(1, "\"vertices\": 3, ");
  expect_fit(3, "the key \"vertices\" is there twice in one object; remove one", twice);
  expect(3, "missing.json: cannot be read",
         {"edit", model_, "--fit", file("missing.json"), "--set", "width=1", "-o", file("o.obj")});
  expect(3, "cannot be read", {"edit", model_, "--fit", folder_.path(), "--set", "width=1", "-o", file("o.obj")});
}

TEST_F(TemplateUsage, FitsOfAnotherTemplate) {
  const std::string out = file("out.obj");
  expect(3, "fit.json: template_document: is a fit of another template, box, not of mug",
         edit_ + Arguments{"--template", "mug", "-o", out});
  json changed = fit_of_the_model();
  changed["template_document"]["parameters"][0]["max"] = 5;
  write_text(file("changed.json"), changed.dump());
  const std::string says = "changed.json: template_document: is a fit of another template called box, not of box";
  expect(3, says, {"edit", model_, "--fit", file("changed.json"), "--template", "box", "--set", "width=1", "-o", out});
  expect(3, says, {"interpolate", model_, "--fit", fit_, "--to", file("changed.json"), "-o", out});
  expect(3, says, {"retarget", model_, model_, "--source-fit", fit_, "--target-fit", file("changed.json"), "-o", out});
  // Its own still does.
  EXPECT_EQ(ask({"edit", model_, "--fit", file("changed.json"), "--set", "width=4.5", "-o", out}).code, 0);
}

TEST_F(TemplateUsage, ValuesOutOfTheirBounds) {
  const Arguments out{"-o", file("out.obj")}, edit{"edit", model_, "--fit", fit_};
  expect(2, "--set width=5: width would be 5, and is from 0.2 to 4 (--beyond",
         edit + Arguments{"--set", "width=5"} + out);
  expect(2, "--set depth*=3: depth would be 6", edit + Arguments{"--set", "depth*=3"} + out);
  expect(2, "--set depth+=-3: depth would be -1", edit + Arguments{"--set", "width=1,2", "depth+=-3"} + out);
  expect(2, "depth*=3", Arguments{"interpolate", model_, "--fit", fit_, "--set", "depth*=3"} + out);
  expect(2, "--set depth*=9: depth would be",
         Arguments{"edit", model_, "--template", "box", "--set", "depth*=9"} + kQuick + out);
  EXPECT_EQ(ask(edit + Arguments{"--set", "depth*=2.2", "--beyond"} + out).code, 0);
  const Positions positions = read_mesh(file("out.obj")).mesh.positions;
  EXPECT_NEAR(positions.col(2).maxCoeff() - positions.col(2).minCoeff(), 4.4, 0.05);
}

TEST_F(TemplateUsage, OptionsThatAreNotUnderstood) {
  const Arguments out{"-o", file("out.obj")}, edit = edit_ + out;
  expect(2, "--template is missing", {"edit", model_, "--set", "width=1", "-o", file("out.obj")});
  expect(2, "excludes --samples", edit + Arguments{"--samples", "500"});
  expect(2, "excludes --up", edit + Arguments{"--up", "z"});
  const std::vector<std::pair<std::string, std::vector<std::string>>> bad = {
      {"--tracking", {"0", "-1", "nan"}}, {"--smoothing", {"-1", "2"}}, {"--feature-angle", {"0", "181"}},
      {"--sub-edits", {"-1", "1.5"}},     {"--passes", {"0", "x"}},     {"--tolerance", {"0", "1"}}};
  for (const auto& [option, values] : bad) {
    for (const std::string& value : values) expect(2, option, edit + Arguments{option, value});
  }
  expect(2, "--set width=1,2,3: 3 values, but depth*=1,1.1 has 2: give each one value or as many",
         Arguments{"edit", model_, "--fit", fit_, "--set", "depth*=1,1.1", "width=1,2,3"} + out);
  expect(2, "there is no parameter 'girth'", Arguments{"edit", model_, "--fit", fit_, "--set", "girth=1"} + out);
  for (const char* frames : {"1", "1001", "x"}) {
    expect(2, "--frames",
           Arguments{"interpolate", model_, "--fit", fit_, "--set", "width=1", "--frames", frames} + out);
  }
  expect(2, "where to? name another fit with --to", Arguments{"interpolate", model_, "--fit", fit_} + out);
  expect(2, "give one value here", Arguments{"interpolate", model_, "--fit", fit_, "--set", "width=1,2"} + out);
  expect(2, "--target-up", Arguments{"retarget", model_, model_, "--template", "box", "--target-up", "w"} + out);
  expect(2, "TARGET", Arguments{"retarget", model_, "--template", "box"} + out);
}

TEST_F(TemplateUsage, FilesAreOfTheirKindAndDifferent) {
  const Arguments edit = edit_, two{"edit", model_, "--fit", fit_, "--set", "width=1,2"},
                  steps{"interpolate", model_, "--fit", fit_, "--set", "width=2"},
                  retarget{"retarget", model_, file("target.obj"), "--source-fit", fit_};
  for (const Arguments& command : {edit, steps, retarget}) {
    expect(2, "nothing to write", command);
    expect(2, "use .obj", command + Arguments{"-o", file("out.fbx")});
    expect(2, "make it first", command + Arguments{"-o", file("none/out.obj")});
    expect(2, "fit.json", command + Arguments{"--json", fit_});
    expect(2, "--view requires --picture", command + Arguments{"-o", file("out.obj"), "--view", "1,0,0"});
  }
  expect(2, "do not go to stdout", two + Arguments{"-o", "-"});
  expect(2, "do not go to stdout", steps + Arguments{"-o", "-"});
  expect(2, "both name", edit + Arguments{"-o", "-", "--json", "-"});
  write_text(file("model_1.obj"), read_text(model_));
  expect(2, "MESH and -o both name", {"edit", file("model_1.obj"), "--fit", fit_, "--set", "width=1,2", "-o", model_});
  expect(2, "MESH and -o both name",
         {"interpolate", file("model_1.obj"), "--fit", fit_, "--set", "width=1", "--frames", "3", "-o", model_});
  expect(2, "TARGET and -o both name", retarget + Arguments{"-o", file("target.obj")});
  if (!can_render()) return;
  for (const Arguments& command : {edit, steps, retarget}) {
    expect(2, "p.jpg: name a .png file", command + Arguments{"--picture", file("p.jpg")});
    expect(2, "make it first", command + Arguments{"--picture", file("none/p.png")});
  }
}

TEST_F(TemplateUsage, BadMeshesAreRefusedWithTheirPlace) {
  write_text(file("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  const std::string bad = file("bad.obj"), out = file("out.obj");
  expect(3, "bad.obj: line 4", {"edit", bad, "--fit", fit_, "--set", "width=1", "-o", out});
  expect(3, "bad.obj: line 4", {"interpolate", bad, "--fit", fit_, "--set", "width=1", "-o", out});
  expect(3, "bad.obj: line 4", {"retarget", bad, model_, "--source-fit", fit_, "-o", out});
  expect(3, "bad.obj: line 4", {"retarget", model_, bad, "--source-fit", fit_, "-o", out});
  expect(3, "missing.obj", {"edit", file("missing.obj"), "--fit", fit_, "--set", "width=1", "-o", out});
  write_text(file("line.obj"), "v 0 0 0\nv 1 0 0\nv 3 0 0\nf 1 2 3\n");
  expect(3, "line.obj: fit_template: triangles",
         {"retarget", model_, file("line.obj"), "--source-fit", fit_, "-o", out});
}

TEST_F(TemplateUsage, AFullDiskBehindStdoutEndsAnEdit) {
  for (const char* option : {"-o", "--json"}) {
    const Running running =
        start(Arguments{"template"} + edit_ + Arguments{"--quiet", option, "-"}, "/dev/full", file("err"));
    EXPECT_EQ(running.wait(), 4);
    EXPECT_THAT(read_text(file("err")), HasSubstr("stdout"));
  }
}

TEST_F(TemplateUsage, AnInterruptedEditWritesNothing) {
  if (!Terminal::exists()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  const TempFolder written;
  write_mesh(file("fine.obj"), box({1, 1, 2}, 100));
  for (const Arguments& command :
       {Arguments{"edit", file("fine.obj"), "--fit", fit_, "--set", "width=1.2,1.5,2,2.5"},
        {"interpolate", file("fine.obj"), "--fit", fit_, "--set", "width=2", "--frames", "40"}}) {
    Terminal terminal;
    const Running running =
        start(Arguments{"template"} + command + Arguments{"-o", written / "out.obj", "--json", written / "report.json"},
              "/dev/null", terminal.path());
    ASSERT_TRUE(terminal.wait_for("%"));
    kill(running.process, SIGINT);
    EXPECT_EQ(running.wait(), 130);
    EXPECT_EQ(names_in(written.path()), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace swage::test
