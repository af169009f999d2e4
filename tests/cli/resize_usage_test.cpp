// What `swage resize` refuses, and how it is interrupted.
#include <gmock/gmock.h>
#include <signal.h>

#include <algorithm>

#include "resizing.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"

namespace swage::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class ResizeUsage : public Resizing {
 protected:
  /// Refused with this code and one line that says this; nothing is written.
  void expect(int code, const std::string& says, const Arguments& arguments, const std::string& mesh = "") const {
    SCOPED_TRACE(testing::PrintToString(arguments));
    const std::vector<std::string> before = names_in(folder_.path());
    const std::string model = read_text(model_);
    const Outcome outcome = run(with_model(arguments, mesh.empty() ? model_ : mesh));
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("swage: error: "));
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names_in(folder_.path()), before);
    EXPECT_TRUE(read_text(model_) == model);
  }

  static Arguments with_model(Arguments arguments, const std::string& mesh) {
    arguments.insert(arguments.begin(), {"resize", mesh});
    return arguments;
  }

  std::string out = file("out.obj");
};

TEST_F(ResizeUsage, AFactorOrSizeIsThreeNumbers) {
  for (const char* scale : {"2", "2,1", "2,1,1,1", ""}) expect(2, "three values", {"--scale", scale, "-o", out});
  for (const char* bad : {"0", "-1", "nan", "inf", "1e-7", "2e6", "two", "1 1", "2x", "--"}) {
    const std::string scale = std::string("1,") + bad + ",1";
    expect(2, "--scale " + scale + ": '" + bad + "' is not a factor from 1e-6 to 1e6", {"--scale", scale, "-o", out});
  }
  for (const char* bad : {"0", "-3", "nan", "inf", "big"}) {
    const std::string size = std::string("1,2,") + bad;
    expect(2, "--size " + size + ": '" + bad + "' is not a size above 0", {"--size", size, "-o", out});
  }
  expect(2, "--size", {"--size", "1,1", "-o", out});
  expect(3, "model.obj: --size 1e8,-,-: along x the model is 4 long", {"--size", "1e8,-,-", "-o", out});
  expect(3, "along z", {"--size", "-,-,1e-7", "-o", out});
}

TEST_F(ResizeUsage, OptionsThatDoNotGoTogether) {
  const auto with = [&](Arguments more) {
    more.insert(more.end(), {"--scale", "2,1,1", "-o", out});
    return more;
  };
  expect(2, "--size", with({"--size", "1,1,1"}));
  expect(2, "--keep-weight is for --keep size", with({"--keep-weight", "2"}));
  expect(2, "--keep-weight is for --keep size", with({"--keep-weight", "2", "--keep", "shape"}));
  expect(2, "--keep", with({"--keep", "colour"}));
  for (const char* weight : {"0", "-1", "nan"})
    expect(2, "--keep-weight", with({"--keep", "size", "--keep-weight", weight}));
  expect(2, "--anchor middle: 'middle' is not low, center or high", with({"--anchor", "middle"}));
  expect(2, "--anchor low,high", with({"--anchor", "low,high"}));
  expect(2, "'' is not low", with({"--anchor", "low,,high"}));
  for (const char* grid : {"4", "1001", "-3", "0"}) expect(2, "5 to 1000 cells", with({"--grid", grid}));
  for (const char* grid : {"1.5", "many", "10,10"}) expect(2, "--grid", with({"--grid", grid}));
  expect(2, "'0' is not a number of cells", with({"--grid", "0,5,5"}));
  expect(2, "no whole number", with({"--grid", "5,5.5,5"}));
  expect(3, "model.obj: Resize: options.cells", with({"--grid", "1000,1000,1000"}));
  for (const char* angle : {"-1", "181", "nan"}) expect(2, "--crease-angle", with({"--crease-angle", angle}));
  expect(2, "--sideways", with({"--sideways"}));
}

TEST_F(ResizeUsage, ThereIsSomethingToDoAndToWrite) {
  expect(2, "nothing to write", {"--scale", "2,1,1"});
  expect(2, "nothing to write", {});
  expect(2, "-o is of a result: say of what size with --scale", {"-o", out});
  expect(2, "--grid-after is of a result", {"--grid-after", file("grid.ply")});
  expect(2, "--view, --up and --picture-size are for pictures", {"--scale", "2,1,1", "-o", out, "--up", "z"});
  expect(2, "MESH", {}, "--quiet");
}

TEST_F(ResizeUsage, FilesAreOfTheirKindAndDifferent) {
  const auto with = [&](Arguments more) {
    more.insert(more.end(), {"--scale", "2,1,1", "--scale", "3,1,1"});
    return more;
  };
  expect(2, "use .obj", with({"-o", file("out.fbx")}));
  expect(2, "make it first", with({"-o", file("none/out.obj")}));
  expect(2, "name a .ply file", with({"--vulnerability", file("v.obj")}));
  expect(2, "name a .ply file", with({"--grid-before", file("v.txt")}));
  expect(2, "name a .ply file", with({"--grid-after", "-"}));
  expect(2, "make it first", with({"--grid-after", file("none/g.ply")}));
  expect(2, "several results do not go to stdout", with({"-o", "-"}));
  expect(2, "both name", with({"--vulnerability", file("a.ply"), "--grid-before", file("a.ply")}));
  expect(2, "both name", with({"-o", file("a.ply"), "--grid-before", file("a_2.ply")}));
  expect(2, "both name", with({"-o", file("a.ply"), "--grid-after", file("a.ply")}));
  expect(2, "both name", with({"-o", file("a.obj"), "--json", file("./a_1.obj")}));
  expect(2, "both name", {"--scale", "2,1,1", "-o", "-", "--json", "-"});
  write_text(file("model_1.obj"), read_text(model_));
  expect(2, "MESH both name", with({"-o", model_}), file("model_1.obj"));
  write_mesh(file("model.ply"), box());
  expect(2, "MESH both name", {"--vulnerability", file("model.ply")}, file("model.ply"));
  if (!can_render()) return;
  for (const char* option : {"--picture", "--grid-picture", "--vulnerability-picture"}) {
    expect(2, std::string(option) + " p.jpg: name a .png file", with({option, "p.jpg"}));
    expect(2, "make it first", with({option, file("none/p.png")}));
    expect(2, "--picture-size 10x10", with({option, file("p.png"), "--picture-size", "10x10"}));
    expect(2, "--view 1,2", with({option, file("p.png"), "--view", "1,2"}));
  }
  expect(2, "both name", with({"--picture", file("p.png"), "--grid-picture", file("p.png")}));
}

TEST_F(ResizeUsage, AResultMayTakeTheModelsPlace) {
  EXPECT_EQ(resize({"--scale", "2,1,1", "-o", model_}).code, 0);
  EXPECT_NEAR(box_of(read_mesh(model_).mesh.positions).sizes()[0], 8, 1e-6);
}

TEST_F(ResizeUsage, ProtectionsThatAreNotUnderstood) {
  const auto protect = [&](const std::string& text) {
    return Arguments{"--scale", "2,1,1", "-o", out, "--protect", text};
  };
  for (const char* text : {"", "=1", ":x", "w<3", "0-9:w", "0-9:", "component:", "x<1:xq", "group:", "box:1,2,3:x",
                           "0-9=", "0-9=a", "x=0.5", "foo:x=1", "@"}) {
    expect(2, std::string("--protect ") + text + ": ", protect(text));
    expect(2, "write SELECT[:axes][=value], such as", protect(text));
  }
  for (const char* text : {"0-9=2", "0-9:x=-0.1", "0-9=nan", "x<=1=1e9"})
    expect(2, "is not from 0 to 1", protect(text));
  expect(2, "--release 0-9=1: ", {"--scale", "2,1,1", "-o", out, "--release", "0-9=1"});
  expect(3, "--protect component:2: Selection: 'component:2'", protect("component:2"));
  expect(3, "--protect group:wheel:x=0.5: Selection: 'group:wheel': no such group", protect("group:wheel:x=0.5"));
  expect(3, "--protect x>5: ", protect("x>5"));
  expect(3, "is outside of the mesh's box", protect("box:5,5,5,6,6,6:x"));
  expect(3, "--protect 0,1: no triangle of", protect("0,1"));
  expect(3, "ids", protect(std::string("@") + file("ids")));
}

TEST_F(ResizeUsage, AProtectionOfTwoMeaningsIsRefusedWithBoth) {
  std::string named = read_text(model_);
  named.replace(named.find("g bar"), 5, "g ball:x");
  write_text(file("named.obj"), named);
  expect(2,
         "'group:ball' and 'group:ball:x' both select something: write 'group:ball & x>=0%:x=0.5' for the first or "
         "'group:ball:x:xyz=0.5' for the second",
         {"--scale", "2,1,1", "-o", out, "--protect", "group:ball:x=0.5"}, file("named.obj"));
}

TEST_F(ResizeUsage, UsageIsCheckedBeforeTheModelIsRead) {
  expect(2, "three values", {"--scale", "2", "-o", out}, file("missing.obj"));
  expect(2, "--protect 0-9:w", {"--scale", "2,1,1", "-o", out, "--protect", "0-9:w"}, file("missing.obj"));
  expect(2, "--grid", {"--scale", "2,1,1", "-o", out, "--grid", "x"}, file("missing.obj"));
}

TEST_F(ResizeUsage, BadModelsAreRefusedWithTheirPlace) {
  write_text(file("bad.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write_text(file("short.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n");
  write_text(file("point.obj"), "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  const Arguments arguments{"--scale", "2,1,1", "-o", out};
  expect(3, "missing.obj", arguments, file("missing.obj"));
  expect(3, "bad.obj: line 4", arguments, file("bad.obj"));
  expect(3, "short.obj: line 5: a face has fewer than three vertices", arguments, file("short.obj"));
  expect(3, "point.obj: Resize: positions: all vertices are at one place", arguments, file("point.obj"));
}

TEST_F(ResizeUsage, AFullDiskBehindStdoutExitsWith4) {
  for (const char* option : {"-o", "--json"}) {
    const Running running =
        start({"resize", model_, "--quiet", "--grid", "10", "--scale", "2,1,1", option, "-"}, "/dev/full", file("err"));
    EXPECT_EQ(running.wait(), 4);
    EXPECT_THAT(read_text(file("err")), HasSubstr("stdout"));
  }
}

TEST_F(ResizeUsage, InterruptedNothingIsWritten) {
  if (!Terminal::exists()) GTEST_SKIP() << "this machine has no pseudo-terminals";
  const TempFolder written;
  for (const char* stage : {"vulnerability", "scales"}) {
    write_mesh(model_, sphere(1, stage == std::string("scales") ? 3 : 7));
    Terminal terminal;
    const Running running =
        start({"resize", model_, "--scale", "3,1,0.2", "--scale", "1,2,1", "--grid", "120", "-o", written / "out.obj",
               "--json", written / "report.json", "--vulnerability", written / "v.ply"},
              "/dev/null", terminal.path());
    ASSERT_TRUE(terminal.wait_for(stage)) << stage;
    kill(running.process, SIGINT);
    EXPECT_EQ(running.wait(), 130) << stage;
    EXPECT_EQ(names_in(written.path()), std::vector<std::string>{});
  }
}

}  // namespace
}  // namespace swage::test
