// What `swage resize` makes of models.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "opencl_device.h"
#include "resizing.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

const Arguments kTwice{"--scale", "2,1,1"};

/// How much longer than high the ball is.
double aspect(const Mesh& mesh) {
  const Vector3d sizes = ball_in(mesh).sizes();
  return sizes[0] / sizes[1];
}

TEST_F(Resizing, OnlyVerticesAndNormalsChange) {
  write_text(file("box.obj"), box_obj());
  const std::vector<std::string> before = lines(box_obj()), after = lines(result(kTwice, file("box.obj")));
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

TEST_F(Resizing, TheBoxIsTheOneAskedFor) {
  const Mesh rest = read_mesh(model_).mesh;
  const Vector3d sizes = box_of(rest.positions).sizes();
  for (const char* scale : {"1,1,1", "2,1,1", "0.5,3,1", "0.05,1,20"}) {
    std::istringstream text(scale);
    Vector3d factors;
    char comma = 0;
    text >> factors[0] >> comma >> factors[1] >> comma >> factors[2];
    const Mesh mesh = mesh_of({"--scale", scale});
    EXPECT_EQ(mesh.triangles, rest.triangles);
    const AlignedBox3d box = box_of(mesh.positions);
    EXPECT_LT((box.min() - Vector3d(0, 0, 0)).norm(), 1e-6 * sizes.norm()) << scale;
    EXPECT_LT((box.sizes() - sizes.cwiseProduct(factors)).norm(), 1e-6 * sizes.norm()) << scale;
  }
  EXPECT_LT((mesh_of({"--scale", "1,1,1"}).positions - rest.positions).norm(), 1e-9);
}

TEST_F(Resizing, TheBarStretchesAndTheBallStaysRound) {
  EXPECT_NEAR(aspect(mesh_of(kTwice)), 1, 0.05);
  EXPECT_NEAR(aspect(mesh_of({"--scale", "0.5,1,1"})), 1, 0.05);
}

TEST_F(Resizing, ASizeIsAScaleOfTheBox) {
  // The box is 4 x 1.6 x 1.
  EXPECT_TRUE(result({"--size", "8,-,-"}) == result(kTwice));
  EXPECT_TRUE(result({"--size", "8,,1"}) == result(kTwice));
  EXPECT_TRUE(result({"--scale", "2,-,"}) == result(kTwice));
  const Vector3d sizes = box_of(mesh_of({"--size", "3,2,2.5"}).positions).sizes();
  EXPECT_LT((sizes - Vector3d(3, 2, 2.5)).norm(), 1e-6);
}

TEST_F(Resizing, SeveralResultsAreWhatEachIsAlone) {
  const Outcome outcome = resize({"--scale", "2,1,1", "--scale", "1,0.5,3", "--scale", "2,1,1", "-o", file("out.obj")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(names_in(folder_.path()), (std::vector<std::string>{"model.obj", "out_1.obj", "out_2.obj", "out_3.obj"}));
  EXPECT_TRUE(read_text(file("out_1.obj")) == result({"--scale", "2,1,1"}));
  EXPECT_TRUE(read_text(file("out_2.obj")) == result({"--scale", "1,0.5,3"}));
  EXPECT_TRUE(read_text(file("out_3.obj")) == read_text(file("out_1.obj")));
}

TEST_F(Resizing, WhatIsAnchoredStays) {
  const AlignedBox3d rest = box_of(read_mesh(model_).mesh.positions);
  const auto box = [&](const std::string& anchor) {
    return box_of(mesh_of({"--scale", "2,0.5,3", "--anchor", anchor}).positions);
  };
  EXPECT_LT((box("low").min() - rest.min()).norm(), 1e-6);
  EXPECT_LT((box("center").center() - rest.center()).norm(), 1e-6);
  EXPECT_LT((box("high").max() - rest.max()).norm(), 1e-6);
  const AlignedBox3d mixed = box("high, low,center");
  EXPECT_NEAR(mixed.max()[0], rest.max()[0], 1e-6);
  EXPECT_NEAR(mixed.min()[1], rest.min()[1], 1e-6);
  EXPECT_NEAR(mixed.center()[2], rest.center()[2], 1e-6);
}

TEST_F(Resizing, SizeIsKeptOnRequest) {
  const Arguments scale{"--scale", "2,1.5,2"}, keep = scale + Arguments{"--keep", "size"};
  const auto off = [&](const Arguments& arguments) {
    const json told = report(arguments);
    double most = 0;
    for (const double kept : told["kept_scale"]) most = std::max(most, std::abs(kept - 1));
    return most;
  };
  EXPECT_GT(off(scale), 0.2) << "it may grow";
  EXPECT_LT(off(keep), 0.5 * off(scale));
  EXPECT_LT(off(keep + Arguments{"--keep-weight", "100"}), off(keep));
  EXPECT_LT((ball_in(mesh_of(keep)).sizes() - Vector3d(0.6, 0.6, 0.6)).norm(),
            0.6 * (ball_in(mesh_of(scale)).sizes() - Vector3d(0.6, 0.6, 0.6)).norm());
  EXPECT_TRUE(result(keep) == result(keep + Arguments{"--keep-weight", "10"}));
  EXPECT_TRUE(result(scale) == result(scale + Arguments{"--keep", "shape"}));
  EXPECT_EQ(report(keep)["method"], "keep size");
}

TEST_F(Resizing, WhatIsProtectedKeepsItsShape) {
  const Positions rest = read_mesh(model_).mesh.positions;
  Eigen::Index corner = 0;
  (rest.rowwise() - Eigen::RowVector3d(3, 0, 0)).rowwise().norm().minCoeff(&corner);
  const auto end_length = [&](const Arguments& more) {
    const Positions positions = mesh_of(kTwice + more).positions;
    return positions.col(0).maxCoeff() - positions(corner, 0);
  };
  const double free = end_length({}), kept = end_length({"--protect", "x>=3"});
  EXPECT_GT(free, 1.9);
  EXPECT_LT(kept, 0.75 * free);
  EXPECT_GT(aspect(mesh_of(kTwice + Arguments{"--release", "component:1"})), 1.5);
}

TEST_F(Resizing, TheLastSayCounts) {
  const Arguments protect{"--protect", "group:ball"}, release{"--release", "group:ball"};
  const std::string kept = result(kTwice + protect), freed = result(kTwice + release);
  EXPECT_TRUE(kept != freed);
  EXPECT_TRUE(result(kTwice + release + protect) == kept);
  EXPECT_TRUE(result(kTwice + protect + release) == freed);
  EXPECT_TRUE(result(kTwice + protect + release + protect) == kept);
  EXPECT_TRUE(result(kTwice + Arguments{"--protect", "group:ball=0"}) == freed);
}

TEST_F(Resizing, PartsAreSelectedInAnyWords) {
  const std::string freed = result(kTwice + Arguments{"--release", "group:ball"});
  const auto equals = [&](const std::string& select) {
    return result(kTwice + Arguments{"--release", select}) == freed;
  };
  EXPECT_TRUE(equals("component:1"));
  EXPECT_TRUE(equals("98-259"));
  EXPECT_TRUE(equals("group:ball:xyz"));
  EXPECT_TRUE(equals("group:ball & y<=100%"));
  std::string ids;
  for (int v = 98; v < 260; ++v) ids += std::to_string(v) + "\n";
  write_text(file("ids"), ids);
  EXPECT_TRUE(equals(std::string("@") + file("ids")));
  EXPECT_FALSE(equals("group:bar"));
}

/// Of cells that faces touch, by the PLY of the grid at rest.
struct Cells : Resizing {
  Eigen::VectorXd theta(const char* axis, const Arguments& more) const {
    const Outcome outcome = resize(Arguments{"--grid-before", file("grid.ply")} + more);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return face_values(file("grid.ply")).at(std::string("theta_") + axis);
  }
  void expect_only(const std::string& text, const std::string& axes, double value) const {
    for (const char* axis : {"x", "y", "z"}) {
      const Eigen::VectorXd found = theta(axis, {}), counts = theta(axis, {"--protect", text});
      if (axes.find(axis) == std::string::npos) {
        EXPECT_EQ(counts, found) << text << ' ' << axis;
      } else {
        EXPECT_EQ(counts, Eigen::VectorXd::Constant(found.size(), value)) << text << ' ' << axis;
      }
    }
  }
};

TEST_F(Cells, AxesAndValuesAreAsAskedFor) {
  expect_only("x>=0", "xyz", 1);
  expect_only("x>=0=0.25", "xyz", 0.25);
  expect_only("x>=0:y", "y", 1);
  expect_only("x>=0 : xz = 0.5", "xz", 0.5);
  expect_only("box:-1,-1,-1,9,9,9:zy=0", "zy", 0);
  expect_only("0-259:x=1e-1", "x", 0.1);
}

TEST_F(Cells, OfARegionNeedNoVertex) {
  // Between the bar's vertices at x = 2 and 3.
  for (const char* text : {"x>2.2&x<2.8:y", "box:2.2,-9,-9,2.8,9,9:y"}) {
    const Eigen::VectorXd added = theta("y", {"--protect", text}) - theta("y", {});
    EXPECT_GT((added.array() > 0.9).count(), 50) << text;
    EXPECT_LT((added.array() > 0.9).count(), added.size() / 3) << text;
  }
  const auto share = [&](const Arguments& more) -> double {
    return report(more)["vulnerability"]["cells"]["y"]["share_above_half"];
  };
  EXPECT_NEAR(share({"--protect", "x>2.2&x<2.8:y"}) - share({}), 3.0 / 20, 1e-9) << "three layers of twenty";
}

TEST_F(Cells, OfARegionMayBeThoseOfOneFaceOfTheBox) {
  for (const char* text : {"x>=100%", "x<=0%", "z>=100%", "y>=100%", "y<=0"}) {
    const Eigen::VectorXd counts = theta("x", {"--protect", std::string(text) + "=0.3"});
    EXPECT_GT((counts.array() == 0.3).count(), 0) << text;
    EXPECT_LT((counts.array() == 0.3).count(), counts.size() / 2) << text;
  }
}

std::string without_groups(const std::string& obj) {
  std::string text;
  for (const std::string& line : lines(obj))
    if (!line.starts_with("g ")) text += line + "\n";
  return text;
}

TEST_F(Resizing, NamesThatEndLikeAxesOrValuesAreGroupsToo) {
  const auto protecting = [&](const std::string& select, const std::string& bar, const std::string& ball) {
    std::string named = read_text(model_);
    named.replace(named.find("g ball"), 6, std::string("g ") + ball);
    named.replace(named.find("g bar"), 5, std::string("g ") + bar);
    write_text(file("named.obj"), named);
    return without_groups(result(kTwice + Arguments{"--protect", select}, file("named.obj")));
  };
  const std::string kept = protecting("group:ball", "bar", "ball"),
                    along = protecting("group:ball:y=0.2", "bar", "ball");
  EXPECT_TRUE(kept != along);
  EXPECT_TRUE(protecting("group:ball:y", "bar", "ball:y") == kept);
  EXPECT_TRUE(protecting("group:ball:y:xyz", "ball", "ball:y") == kept);
  EXPECT_TRUE(protecting("group:ball=0", "bar", "ball=0") == kept);
  EXPECT_TRUE(protecting("group:y", "bar", "y") == kept);
  EXPECT_TRUE(protecting("group:ball:y=0:y=0.2", "bar", "ball:y=0") == along);
  EXPECT_TRUE(protecting("group:ball & x>=0%:y=0.2", "ball:y", "ball") == along);
}

TEST_F(Resizing, CreasesAreAsAskedFor) {
  // Interior angles are 135 degrees.
  write_mesh(file("prism.obj"), cylinder(0.5, 1, 8, 3));
  const auto mean = [&](const char* angle) -> double {
    return report({"--crease-angle", angle}, file("prism.obj"))["vulnerability"]["faces"]["x"]["mean"];
  };
  EXPECT_LT(mean("150"), 0.01);
  EXPECT_GT(mean("100"), 0.3);
  EXPECT_TRUE(result(kTwice) == result(kTwice + Arguments{"--crease-angle", "150"}));
}

TEST_F(Resizing, TheGridIsAsAskedFor) {
  const auto cells = [&](const Arguments& more) { return report(more)["cells"]; };
  EXPECT_EQ(cells({}), (json{20, 8, 5}));
  EXPECT_EQ(run({"resize", model_, "--json", file("usual.json")}).code, 0);
  EXPECT_EQ(json::parse(read_text(file("usual.json")))["cells"], (json{60, 24, 15}));
  for (const auto& [grid, expected] : std::vector<std::pair<std::string, json>>{
           {"40", {40, 16, 10}}, {"7,9,11", {7, 9, 11}}, {"10,-,3", {10, 5, 3}}, {"-,16,-", {40, 16, 10}}}) {
    const Outcome outcome = run({"resize", model_, "--quiet", "--grid", grid, "--json", "-"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(json::parse(outcome.out)["cells"], expected) << grid;
  }
}

TEST_F(Resizing, TheSameFromAnyThreadsAndOnADevice) {
  EXPECT_TRUE(result(kTwice + Arguments{"--threads", "1"}) == result(kTwice + Arguments{"--threads", "2"}));
  if (!opencl_or_skip(Precision::single)) return;
  const Mesh here = mesh_of(kTwice + Arguments{"--backend", "cpu"});
  for (const char* precision : {"single", "double"}) {
    if (precision == std::string("double") && !opencl_devices().front().computes_twice) continue;
    const Arguments there{"--backend", "opencl", "--precision", precision};
    EXPECT_LT((here.positions - mesh_of(kTwice + there).positions).cwiseAbs().maxCoeff(), 1e-2) << precision;
    EXPECT_EQ(report(there)["backend"], "opencl");
    EXPECT_EQ(report(there)["precision"], precision);
  }
}

}  // namespace
}  // namespace swage::test
