// `swage stylize` by captures, normals and normal maps, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "measures.h"
#include "png_bytes.h"
#include "program.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"
#include "swage/style_io.h"

namespace swage::test {
namespace {

using nlohmann::json;
using std::numbers::pi;
using testing::HasSubstr;

std::uint32_t straight(int, int) { return 0x8080FFFF; }

/// A globe painted with its own normals; of `height` rows.
std::string globe_png(int height) {
  return rgba_png(2 * height, height, [&](int x, int y) {
    const double down = pi * (y + 0.5) / height, around = pi * (x + 0.5) / height - pi;
    return colour_of(std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around));
  });
}

/// The same as two discs, transparent beside them.
std::string discs_png(int height) {
  return rgba_png(2 * height, height, [&](int x, int y) -> std::uint32_t {
    const double sign = x < height ? 1 : -1;
    const double a = 2 * (x % height + 0.5) / height - 1, b = 1 - 2 * (y + 0.5) / height;
    if (a * a + b * b > 1) return 0;
    return colour_of(sign * a, b, sign * std::sqrt(1 - a * a - b * b));
  });
}

/// A sheet whose texture coordinates are x and y, as OBJ.
std::string sheet_obj(int cells) {
  const Mesh mesh = sheet(cells);
  std::ostringstream out;
  for (const auto& p : mesh.positions.rowwise()) out << "v " << p << "\nvt " << p[0] << ' ' << p[1] << '\n';
  out << "g cloth\n";
  for (const Eigen::RowVector3i t : mesh.triangles.rowwise()) {
    out << 'f';
    for (const int v : t) out << ' ' << v + 1 << '/' << v + 1;
    out << '\n';
  }
  return out.str();
}

class StyleFilesProgram : public testing::Test {
 protected:
  StyleFilesProgram() {
    write_mesh(folder_ / "ring.obj", torus(1, 0.4, 24, 12));
    write_text(folder_ / "sheet.obj", sheet_obj(24));
    write_text(folder_ / "straight.png", rgba_png(16, 16, straight));
    write_text(folder_ / "globe.png", globe_png(64));
    write_text(folder_ / "discs.png", discs_png(64));
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  Outcome stylize(const std::string& mesh, const Arguments& more) const {
    Arguments arguments{"stylize", file(mesh), "--quiet", "-o", file("result.obj")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  Positions result(const std::string& mesh, const Arguments& more) const {
    const Outcome outcome = stylize(mesh, more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_mesh(file(outcome.code == 0 ? "result.obj" : mesh)).mesh.positions;
  }

  double moved(const std::string& mesh, const Arguments& more) const {
    const Positions rest = read_mesh(file(mesh)).mesh.positions;
    return (result(mesh, more) - rest).rowwise().norm().maxCoeff() / box_diagonal(rest);
  }

  TempFolder folder_;
};

class WithPictures : public StyleFilesProgram {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
};

TEST_F(WithPictures, ACaptureOfEachPointItselfMovesNothingMuch) {
  EXPECT_LT(moved("ring.obj", {"--capture", file("globe.png")}), 0.01);
  EXPECT_LT(moved("ring.obj", {"--capture", file("globe.png"), "--capture-layout", "equirectangular"}), 0.01);
  EXPECT_LT(moved("ring.obj", {"--capture", file("discs.png"), "--capture-layout", "hemispheres"}), 0.01);
  EXPECT_GT(moved("ring.obj", {"--style", "cube"}), 0.02) << "for comparison";
}

TEST_F(StyleFilesProgram, ACaptureMayBeAMesh) {
  // Each normal turned: the shape turns as they do.
  const Mesh ball = sphere(2, 3);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << ball.positions.rows();
  for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) out << "\nproperty double " << name;
  out << "\nelement face " << ball.triangles.rows() << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Eigen::RowVector3d p : ball.positions.rowwise()) out << p << ' ' << p * turn.transpose() << '\n';
  for (const auto& t : ball.triangles.rowwise()) out << "3 " << t << '\n';
  write_text(file("ball.ply"), out.str());
  const Positions rest = read_mesh(file("ring.obj")).mesh.positions;
  const Positions turned = result("ring.obj", {"--capture", file("ball.ply"), "--lambda", "10"});
  const Positions due = rest * turn.transpose();
  EXPECT_LT((turned.rowwise() - turned.row(0) - (due.rowwise() - due.row(0))).rowwise().norm().maxCoeff(), 0.02);
}

TEST_F(StyleFilesProgram, NormalsAreTheMeshsOwn) {
  const Mesh mesh = read_mesh(file("ring.obj")).mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Positions normals = unit_normals(mesh.positions, mesh.triangles) * turn.transpose();
  write_face_values(file("normals.ply"), mesh,
                    {{"nx", normals.col(0)}, {"ny", normals.col(1)}, {"nz", normals.col(2)}});
  const Positions turned =
      result("ring.obj", {"--normals", file("normals.ply"), "--lambda", "10", "--energy", "farap"});
  EXPECT_LT((unit_normals(turned, mesh.triangles) - normals).rowwise().norm().maxCoeff(), 0.02);
}

TEST_F(WithPictures, AStraightNormalMapMovesNothing) {
  EXPECT_LT(moved("sheet.obj", {"--normal-map", file("straight.png")}), 1e-9);
  EXPECT_LT(moved("sheet.obj", {"--normal-map", file("straight.png"), "--normal-space", "object"}), 1e-9);
}

TEST_F(WithPictures, ANormalMapIsRelief) {
  const auto slope = [](double at) { return 0.5 * std::sin(12 * at); };
  write_text(file("waves.png"), rgba_png(128, 128, [&](int, int y) {
               // Up is where v grows, and rows go down.
               const Eigen::Vector3d normal = Eigen::Vector3d(0, -slope(1 - (y + 0.5) / 128), 1).normalized();
               return colour_of(normal[0], normal[1], normal[2]);
             }));
  const Positions rest = read_mesh(file("sheet.obj")).mesh.positions;
  // h' = slope, so that h = -0.5 / 12 cos(12 y).
  const auto fits = [&](const Arguments& more) {
    Arguments arguments{"--normal-map", file("waves.png"), "--lambda", "30"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Eigen::VectorXd is = result("sheet.obj", arguments).col(2);
    const Eigen::VectorXd due = (rest.col(1).array() * 12).cos() * (-0.5 / 12);
    const Eigen::VectorXd from = is.array() - is.mean(), to = due.array() - due.mean();
    return from.dot(to) / to.squaredNorm();
  };
  EXPECT_NEAR(fits({}), 1, 0.25);
  EXPECT_NEAR(fits({"--green", "up"}), 1, 0.25);
  EXPECT_NEAR(fits({"--green", "down"}), -1, 0.25);
  EXPECT_NEAR(fits({"--normal-space", "object"}), 1, 0.25);
  EXPECT_THAT(read_text(file("result.obj")), HasSubstr("\ng cloth\n"));
}

struct BadStyle {
  Arguments arguments;  ///< "@" stands for the folder.
  std::string says;
};

class StylizeRefuses : public StyleFilesProgram {
 protected:
  void expect(int code, const std::vector<BadStyle>& refusals) const {
    for (const BadStyle& refusal : refusals) {
      Arguments arguments = refusal.arguments;
      arguments.insert(arguments.begin(), "stylize");
      for (std::string& argument : arguments) {
        const size_t at = argument.find('@');
        if (at != std::string::npos) argument.replace(at, 1, folder_.path().string());
      }
      SCOPED_TRACE(testing::PrintToString(arguments));
      const std::vector<std::string> before = names_in(folder_.path());
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.code, code) << outcome.err;
      EXPECT_THAT(outcome.err, testing::StartsWith("swage: error: "));
      EXPECT_THAT(outcome.err, HasSubstr(refusal.says));
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(names_in(folder_.path()), before);
    }
  }
};

TEST_F(StylizeRefuses, WrongUsage) {
  expect(
      2,
      {
          {{"@/ring.obj", "-o", "@/r.obj"}, "name a style with --style, --capture"},
          {{"@/ring.obj", "--style", "cube"}, "nothing to write"},
          {{"@/ring.obj", "--style", "teapot", "-o", "@/r.obj"}, "--style teapot: give a mesh"},
          {{"@/ring.obj", "--style", "teapot", "-o", "@/r.obj"}, "octahedron, dodecahedron"},
          {{"@/ring.obj", "--style", "prism2", "-o", "@/r.obj"}, "--style prism2"},
          {{"@/ring.obj", "--style", "prism999999999999", "-o", "@/r.obj"}, "--style prism9999"},
          {{"@/ring.obj", "--style", "cube", "--developable", "-o", "@/r.obj"}, "--developable"},
          {{"@/ring.obj", "--style", "cube", "--developable", "-o", "@/r.obj"}, "--style"},
          {{"@/ring.obj", "--style", "cube", "--capture", "@/globe.png", "-o", "@/r.obj"}, "--capture"},
          {{"@/ring.obj", "--normals", "@/n.ply", "--normal-map", "@/globe.png", "-o", "@/r.obj"}, "--normal-map"},
          {{"@/ring.obj", "--developable", "--target", "closest", "-o", "@/r.obj"}, "--target requires --style"},
          {{"@/ring.obj", "--developable", "--dynamic", "-o", "@/r.obj"}, "--dynamic requires --style"},
          {{"@/ring.obj", "--style", "cube", "--target", "nearest", "-o", "@/r.obj"}, "--target"},
          {{"@/ring.obj", "--style", "cube", "--target", "sphere", "--dynamic", "-o", "@/r.obj"}, "--dynamic"},
          {{"@/ring.obj", "--style", "rounded-cube", "--no-dynamic", "-o", "@/r.obj"}, "--target closest"},
          {{"@/ring.obj", "--polycube", "--developable", "-o", "@/r.obj"}, "--polycube"},
          {{"@/ring.obj", "--polycube", "--energy", "arap", "-o", "@/r.obj"}, "--energy"},
          {{"@/ring.obj", "--polycube", "--style", "cube", "--target", "sphere", "-o", "@/r.obj"}, "--target sphere"},
          {{"@/ring.obj", "--style", "cube", "--weights", "fair", "-o", "@/r.obj"}, "--weights"},
          {{"@/ring.obj", "--developable", "--weights", "intrinsic", "-o", "@/r.obj"}, "--weights intrinsic"},
          {{"@/ring.obj", "--style", "cube", "--tau", "0.1", "-o", "@/r.obj"}, "--tau requires --developable"},
          {{"@/ring.obj", "--developable", "--tau", "0.1", "--threshold", "1e-3", "-o", "@/r.obj"}, "--threshold"},
          {{"@/ring.obj", "--polycube", "--published", "-o", "@/r.obj"}, "--published"},
          {{"@/ring.obj", "--style", "cube", "--published", "--accelerate", "-o", "@/r.obj"}, "--published"},
          {{"@/ring.obj", "--developable", "--tau", "-0.1", "-o", "@/r.obj"}, "--tau"},
          {{"@/ring.obj", "--style", "cube", "--capture-layout", "hemispheres", "-o", "@/r.obj"}, "--capture"},
          {{"@/ring.obj", "--capture", "@/b.ply", "--capture-layout", "hemispheres", "-o", "@/r.obj"}, "b.ply"},
          {{"@/ring.obj", "--style", "cube", "--green", "up", "-o", "@/r.obj"}, "--normal-map"},
          {{"@/sheet.obj", "--normal-map", "@/straight.png", "--normal-space", "object", "--green", "down", "-o",
            "@/r.obj"},
           "--normal-space object"},
          {{"@/ring.obj", "--style", "cube", "--lambda", "-1", "-o", "@/r.obj"}, "0 to"},
          {{"@/ring.obj", "--style", "cube", "--lambda", "nan", "-o", "@/r.obj"}, "0 to"},
          {{"@/ring.obj", "--style", "cube", "--iterations", "0", "-o", "@/r.obj"}, "--iterations"},
          {{"@/ring.obj", "--style", "cube", "--energy", "warp", "-o", "@/r.obj"}, "arap"},
          {{"@/ring.obj", "--style", "cube", "-o", "@/r.fbx"}, "use .obj"},
          {{"@/ring.obj", "--style", "cube", "-o", "-", "--json", "-"}, "different"},
          {{"@/ring.obj", "--style", "cube", "--picture", "@/p.jpg"}, "name a .png file"},
          {{"@/ring.obj", "--style", "cube", "-o", "@/r.obj", "--pin", "0,,1"}, "--pin 0,,1"},
          {{"@/ring.obj", "--style-sheet", "@/p.png", "--style", "cube"}, "--style-sheet"},
          {{"@/ring.obj", "--style-sheet", "@/p.png", "-o", "@/r.obj"}, "--style-sheet"},
      });
}

TEST_F(StylizeRefuses, BadInput) {
  write_text(file("bare.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  write_text(file("part.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 3/1\nf 2 4 3\n");
  write_text(
      file("plain.ply"),
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
      "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  expect(3, {{{"@/missing.obj", "--style", "cube", "-o", "@/r.obj"}, "missing.obj"},
             {{"@/ring.obj", "--style", "missing.obj", "-o", "@/r.obj"}, "missing.obj"},
             {{"@/ring.obj", "--capture", "@/bare.obj", "-o", "@/r.obj"}, "bare.obj: a capture is a picture"},
             {{"@/ring.obj", "--capture", "@/plain.ply", "-o", "@/r.obj"}, "plain.ply: its vertices have no normals"},
             {{"@/ring.obj", "--normals", "@/plain.ply", "-o", "@/r.obj"}, "plain.ply: neither its vertices"},
             {{"@/ring.obj", "--style", "cube", "--pin", "99999", "-o", "@/r.obj"}, "99999"},
             {{"@/bare.obj", "--normal-map", "@/straight.png", "-o", "@/r.obj"}, "bare.obj: has no texture coord"},
             {{"@/part.obj", "--normal-map", "@/straight.png", "-o", "@/r.obj"}, "part.obj: line 7"}});
}

TEST_F(WithPictures, PicturesThatAreNoCaptureOrMapAreRefused) {
  write_text(file("square.png"), rgba_png(16, 16, straight));
  write_text(file("cut.png"), read_text(file("globe.png")).substr(0, 5000));
  const auto refused = [&](const Arguments& arguments, const std::string& words) {
    const Outcome outcome = stylize("ring.obj", arguments);
    EXPECT_EQ(outcome.code, 3) << words;
    EXPECT_THAT(outcome.err, HasSubstr(words));
    EXPECT_FALSE(std::filesystem::exists(file("result.obj")));
  };
  refused({"--capture", file("square.png")}, "square.png: normal_capture: picture: 16 x 16 pixels");
  refused({"--capture", file("cut.png")}, "cut.png: is a damaged PNG");
  refused({"--capture", file("discs.png")}, "of the sphere has no normal");
  refused({"--capture", file("missing.png")}, "missing.png: there is no such file");
  refused({"--capture", file("ring.obj")}, "ring.obj");
}

TEST_F(StylizeRefuses, WhatCannotBeDone) {
  expect(4, {{{"@/ring.obj", "--style", "@/sheet.obj", "--target", "sphere", "-o", "@/r.obj"}, "closed"},
             {{"@/ring.obj", "--style", "cube", "--quiet", "-o", "/proc/result.obj"}, "/proc/result.obj"}});
}

/// Of a PNG file, by its header.
std::pair<int, int> size_of_png(const std::string& bytes) {
  const auto number = [&](size_t at) {
    return static_cast<unsigned char>(bytes[at + 2]) << 8 | static_cast<unsigned char>(bytes[at + 3]);
  };
  return bytes.size() < 24 ? std::pair(-1, -1) : std::pair(number(16), number(20));
}

TEST_F(WithPictures, APictureShowsBeforeAndAfter) {
  const Arguments how{"--style", "cube", "--picture", file("picture.png"), "--size", "400x200", "--view", "1,1,1"};
  ASSERT_EQ(stylize("ring.obj", how).code, 0);
  const std::string cube = read_text(file("picture.png"));
  EXPECT_EQ(size_of_png(cube), std::pair(400, 200));
  ASSERT_EQ(stylize("ring.obj", how).code, 0);
  EXPECT_TRUE(read_text(file("picture.png")) == cube);
  for (const Arguments& more : {Arguments{"--lambda", "10"}, Arguments{"--heat", "none"}}) {
    Arguments other = how;
    other.insert(other.end(), more.begin(), more.end());
    ASSERT_EQ(stylize("ring.obj", other).code, 0);
    EXPECT_TRUE(read_text(file("picture.png")) != cube) << more[0];
  }
}

TEST_F(WithPictures, ASheetShowsStyles) {
  const Outcome outcome = run({"stylize", file("ring.obj"), "--style-sheet", file("sheet.png"), "--size", "500x300"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(size_of_png(read_text(file("sheet.png"))), std::pair(500, 300));
  EXPECT_THAT(outcome.err, HasSubstr("sheet.png"));
}

TEST_F(StyleFilesProgram, APictureIsMadeOrTheBuildSaysWhyNot) {
  const Outcome outcome = stylize("ring.obj", {"--style", "cube", "--picture", file("picture.png")});
  EXPECT_EQ(outcome.code, can_render() ? 0 : 4);
  EXPECT_EQ(std::filesystem::exists(file("picture.png")), can_render());
  if (!can_render()) {
    EXPECT_THAT(outcome.err, HasSubstr("SWAGE_RENDER"));
  }
}

}  // namespace
}  // namespace swage::test
