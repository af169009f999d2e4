// What the program says and how it exits when it is not used as it should be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "factor.h"
#include "program.h"
#include "rays_embree.h"
#include "remesher.h"
#include "tetrahedra.h"

namespace swage::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

struct Refusal {
  Arguments arguments;
  std::string says;
};

/// A folder with a good mesh in it, and refusals in which "@" stands for that folder.
class Usage : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "box.obj", box_obj());
    write_text(folder_ / "two.deform", R"([{"label": "a", "displacements": {"0": [0, 0, 0], "7": [0, 0, 0.1]}},
                                           {"label": "b", "displacements": {"0": [0, 0, 0], "9": [0.1, 0, 0]}}])");
  }

  Arguments in_folder(Arguments arguments) const {
    for (std::string& argument : arguments) {
      const size_t at = argument.find('@');
      if (at != std::string::npos) argument.replace(at, 1, folder_.path().string());
    }
    return arguments;
  }

  /// The program refuses with this code and one line that says this, and writes nothing.
  void expect(int code, const Refusal& refusal, const std::vector<std::string>& environment = {}) const {
    SCOPED_TRACE(testing::PrintToString(refusal.arguments));
    const std::vector<std::string> before = names_in(folder_.path());
    const Outcome outcome = run(in_folder(refusal.arguments), environment);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_THAT(outcome.err, StartsWith("swage: error: "));
    EXPECT_THAT(outcome.err, HasSubstr(refusal.says));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names_in(folder_.path()), before);
  }

  TempFolder folder_;
};

TEST_F(Usage, WithoutArgumentsHelpIsPrinted) {
  const Outcome outcome = run({});
  EXPECT_EQ(outcome.code, 2);
  for (const char* command : {"reshape", "stylize", "resize", "info", "demo"})
    EXPECT_THAT(outcome.err, HasSubstr(command));
  EXPECT_EQ(outcome.out, "");
}

TEST_F(Usage, HelpAndVersionOnEveryLevel) {
  for (const Arguments& level : {Arguments{}, {"reshape"}, {"stylize"}, {"resize"}, {"info"}, {"demo"}}) {
    Arguments help = level, version = level;
    help.push_back("--help");
    version.push_back("--version");
    const Outcome helped = run(help), told = run(version);
    EXPECT_EQ(helped.code, 0);
    EXPECT_THAT(helped.out, HasSubstr("--threads"));
    EXPECT_EQ(helped.err, "");
    EXPECT_EQ(told.code, 0);
    EXPECT_THAT(told.out, StartsWith("swage 0."));
    EXPECT_THAT(told.out, testing::ContainsRegex("OpenMP O(N|FF)"));
    EXPECT_THAT(told.out, HasSubstr(has_cholmod() ? "CHOLMOD ON" : "CHOLMOD OFF"));
    EXPECT_THAT(told.out, HasSubstr(has_embree() ? "Embree ON" : "Embree OFF"));
    EXPECT_THAT(told.out, HasSubstr(has_cholmod() ? "licence: GPL-3.0-or-later" : "licence: MIT"));
    EXPECT_THAT(told.out, HasSubstr(has_tetgen() ? "TetGen ON" : "TetGen OFF"));
    EXPECT_THAT(told.out, HasSubstr(has_cgal() ? "CGAL ON" : "CGAL OFF"));
    EXPECT_EQ(told.out.find("swage-remesh") != std::string::npos, has_cgal());
    // A program of its own: its licence is not the program's.
    EXPECT_EQ(told.out.find("AGPL") != std::string::npos, has_tetgen());
    EXPECT_THAT(told.out, testing::Not(testing::ContainsRegex("\nlicence: [^\n]*AGPL")));
  }
}

TEST_F(Usage, WrongUsageExitsWith2) {
  const std::vector<Refusal> refusals = {
      {{"fold", "@/box.obj"}, "fold"},
      {{"reshape"}, "MESH"},
      {{"stylize", "--style", "cube"}, "MESH"},
      {{"info"}, "MESH"},
      {{"reshape", "@/box.obj", "--sideways"}, "--sideways"},
      {{"reshape", "@/box.obj", "@/box.obj", "--pin", "0", "-o", "@/r.obj"}, "box.obj"},
      {{"reshape", "@/box.obj", "-o", "@/r.obj"}, "--pin"},
      {{"reshape", "@/box.obj", "--pin", "0"}, "-o FILE"},
      {{"reshape", "@/box.obj", "--pin", "0", "-o", "-", "--json", "-"}, "different"},
      {{"reshape", "@/box.obj", "--pin", "0", "-o", "@/r.obj", "--json", "@/r.obj"}, "different"},
      {{"reshape", "@/box.obj", "--pin", "0", "-o", "@/r.fbx"}, "use .obj"},
      {{"reshape", "@/box.obj", "--pin", "0", "-o", "@/result"}, "use .obj"},
      {{"reshape", "@/box.obj", "--pin", "0", "-o", "@/none/r.obj"}, "make it first"},
      {{"reshape", "@/box.obj", "--pin", "0", "--json", "@/none/r.json"}, "make it first"},
      {{"reshape", "@/box.obj", "--pin", "0", "--json", "@"}, "folder"},
      {{"info", "@/box.obj", "--json", "@/none/r.json"}, "make it first"},
      {{"reshape", "@/box.obj", "--pin", "0", "--threads", "0", "-o", "@/r.obj"}, "1 to 1024"},
      {{"reshape", "@/box.obj", "--pin", "0", "--threads", "1025", "-o", "@/r.obj"}, "1 to 1024"},
      {{"reshape", "@/box.obj", "--pin", "0", "--threads", "two", "-o", "@/r.obj"}, "1 to 1024"},
      {{"reshape", "@/box.obj", "--pin", "0", "--threads", "1.5", "-o", "@/r.obj"}, "1.5"},
      {{"reshape", "@/box.obj", "--pin", "0", "--feature-angle", "nan", "-o", "@/r.obj"}, "0 to 180"},
      {{"reshape", "@/box.obj", "--pin", "0", "--feature-angle", "181", "-o", "@/r.obj"}, "0 to 180"},
      {{"reshape", "@/box.obj", "--pin", "0", "--method", "laplace", "-o", "@/r.obj"}, "slippage"},
      {{"reshape", "@/box.obj", "--pin", "0", "--solver", "quick", "-o", "@/r.obj"}, "steady"},
      {{"reshape", "@/box.obj", "--pin", "0", "--quiet", "-v", "-o", "@/r.obj"}, "-v"},
      {{"reshape", "@/box.obj", "--pin", "0", "--backend", "abacus", "-o", "@/r.obj"}, "abacus"},
      {{"reshape", "@/box.obj", "--pin", "0", "--backend", "cpu", "--device", "0", "-o", "@/r.obj"}, "--device 0"},
      {{"reshape", "@/box.obj", "--pin", "0,,1", "-o", "@/r.obj"}, "--pin 0,,1"},
      {{"reshape", "@/box.obj", "--pin", "w<3", "-o", "@/r.obj"}, "w<3"},
      {{"reshape", "@/box.obj", "--move", "3", "-o", "@/r.obj"}, "SELECT=dx,dy,dz"},
      {{"reshape", "@/box.obj", "--move", "3=1,2", "-o", "@/r.obj"}, "'1,2'"},
      {{"reshape", "@/box.obj", "--move", "3=1,2,3,4", "-o", "@/r.obj"}, "'1,2,3,4'"},
      {{"reshape", "@/box.obj", "--move", "3=1,2,up", "-o", "@/r.obj"}, "'1,2,up'"},
      {{"reshape", "@/box.obj", "--move", "3=1,2,inf", "-o", "@/r.obj"}, "'1,2,inf'"},
      {{"reshape", "@/box.obj", "--move", "z>=5", "-o", "@/r.obj"}, "'5'"},
  };
  for (const Refusal& refusal : refusals) expect(2, refusal);
}

TEST_F(Usage, BackendOfTheEnvironmentIsADefault) {
  const Arguments arguments{"reshape", "@/box.obj", "--pin", "0", "-o", "@/r.obj"};
  expect(2, {arguments, "SWAGE_BACKEND"}, {"SWAGE_BACKEND=abacus"});
  Arguments chosen = arguments;
  chosen.insert(chosen.end(), {"--backend", "cpu"});
  EXPECT_EQ(run(in_folder(chosen), {"SWAGE_BACKEND=abacus"}).code, 0);
}

TEST_F(Usage, UsageIsCheckedBeforeAnyFileIsRead) {
  expect(2, {{"reshape", "@/missing.obj", "--pin", "0,,1", "-o", "@/r.obj"}, "0,,1"});
  expect(2, {{"reshape", "@/missing.obj", "--pin", "0", "-o", "@/r.fbx"}, "use .obj"});
}

TEST_F(Usage, BadInputExitsWith3) {
  write_text(folder_ / "bad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
  write_text(folder_ / "short.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2\n");
  write_text(folder_ / "none.deform", "[]");
  write_text(folder_ / "beyond.deform", R"([{"label": "far", "displacements": {"99999": [0, 0, 1]}}])");
  write_text(folder_ / "short.fk", "1 0\n");
  write_text(folder_ / "chain.straight", "0 1\n0 99999\n");
  write_text(folder_ / "two.obj",
             box_obj(1) + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 9 11 10\nf 9 10 12\nf 10 11 12\nf 11 9 12\n");
  const std::vector<Refusal> refusals = {
      {{"info", "@/missing.obj"}, "missing.obj"},
      {{"info", "@"}, "swage-test"},
      {{"reshape", "@/missing.obj", "--pin", "0", "-o", "@/r.obj"}, "missing.obj"},
      {{"reshape", "@/bad.obj", "--pin", "0", "-o", "@/r.obj"}, "bad.obj"},
      {{"reshape", "@/short.obj", "--pin", "0", "-o", "@/r.obj"},
       "short.obj: line 5: a face has fewer than three vertices"},
      {{"reshape", "@/box.obj", "--pin", "99999", "-o", "@/r.obj"}, "99999"},
      {{"reshape", "@/box.obj", "--pin", "group:roof", "-o", "@/r.obj"}, "roof"},
      {{"reshape", "@/box.obj", "--pin", "x>7", "-o", "@/r.obj"}, "x>7"},
      {{"reshape", "@/box.obj", "--pin", "0-9", "--move", "7=1,0,0", "-o", "@/r.obj"}, "7"},
      {{"reshape", "@/box.obj", "--gesture", "@/two.deform:a", "--pin", "7", "-o", "@/r.obj"}, "7"},
      {{"reshape", "@/box.obj", "--gesture", "@/two.deform", "-o", "@/r.obj"}, "a, b"},
      {{"reshape", "@/box.obj", "--gesture", "@/two.deform:c", "-o", "@/r.obj"}, "a, b"},
      {{"reshape", "@/box.obj", "--gesture", "@/none.deform", "-o", "@/r.obj"}, "none.deform"},
      {{"reshape", "@/box.obj", "--gesture", "@/missing.deform:a", "-o", "@/r.obj"}, "missing.deform"},
      {{"reshape", "@/box.obj", "--gesture", "@/beyond.deform", "-o", "@/r.obj"}, "99999"},
      {{"reshape", "@/box.obj", "--pin", "0", "--curvature", "@/short.fk", "-o", "@/r.obj"}, "short.fk"},
      {{"reshape", "@/box.obj", "--pin", "0", "--straight", "@/chain.straight", "-o", "@/r.obj"}, "99999"},
  };
  for (const Refusal& refusal : refusals) expect(3, refusal);
}

TEST_F(Usage, WhatCannotBeDoneExitsWith4) {
  expect(4, {{"reshape", "@/box.obj", "--pin", "0", "--device", "abacus", "-o", "@/r.obj"}, "OpenCL"});
  // A folder in which nobody can make a file.
  expect(4, {{"reshape", "@/box.obj", "--pin", "0", "--quiet", "-o", "/proc/result.obj"}, "/proc/result.obj"});
}

TEST_F(Usage, AFullDiskBehindStdoutExitsWith4) {
  for (const char* option : {"-o", "--json"}) {
    const Running running =
        start(in_folder({"reshape", "@/box.obj", "--quiet", "--pin", "0", option, "-"}), "/dev/full", folder_ / "err");
    EXPECT_EQ(running.wait(), 4);
    EXPECT_THAT(read_text(folder_ / "err"), HasSubstr("stdout"));
  }
}

}  // namespace
}  // namespace swage::test
