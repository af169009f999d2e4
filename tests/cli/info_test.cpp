// What `swage info` finds in meshes made for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesh_index.h"
#include "program.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json info(const std::filesystem::path& path) {
  const Outcome outcome = run({"info", path.string(), "--json", "-"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return json::parse(outcome.out);
}

json info(const Mesh& mesh) {
  const TempFolder folder;
  write_mesh(folder / "mesh.obj", mesh);
  return info(folder / "mesh.obj");
}

json info_of_obj(const std::string& text) {
  const TempFolder folder;
  write_text(folder / "mesh.obj", text);
  return info(folder / "mesh.obj");
}

/// All that can be wrong is 0 but for these.
void expect_wrong_only(const json& facts, const std::map<std::string, int>& wrong) {
  for (const char* name : {"boundary_edges", "boundary_loops", "non_manifold_edges", "non_manifold_vertices",
                           "inconsistent_edges", "degenerate_triangles", "duplicate_triangles", "duplicate_vertices",
                           "isolated_vertices", "self_intersections"}) {
    const auto expected = wrong.find(name);
    EXPECT_EQ(facts[name], expected == wrong.end() ? 0 : expected->second) << name;
    EXPECT_TRUE(expected != wrong.end() || !facts["first"].contains(name)) << name;
  }
}

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(Info, AGoodMeshHasNothingWrong) {
  const json facts = info(box({1, 2, 3}, 4));
  expect_wrong_only(facts, {});
  EXPECT_EQ(facts["components"], 1);
  EXPECT_EQ(facts["triangles"], 192);
  EXPECT_NEAR(facts["volume"].get<double>(), 6, 1e-12);
  EXPECT_NEAR(facts["diagonal"].get<double>(), std::sqrt(14.0), 1e-12);
  EXPECT_EQ(facts["box"], json({{0, 0, 0}, {1, 2, 3}}));
  EXPECT_EQ(facts["reshape"]["solves"], true);
}

TEST(Info, EdgesAreMeasured) {
  const json facts = info_of_obj(kTetrahedron);
  const double mean = (3 + 3 * std::sqrt(2.0)) / 6;
  EXPECT_NEAR(facts["edge_length"]["mean"].get<double>(), mean, 1e-12);
  EXPECT_NEAR(facts["edge_length"]["min_to_mean"].get<double>(), 1 / mean, 1e-12);
  EXPECT_NEAR(facts["edge_length"]["max_to_mean"].get<double>(), std::sqrt(2.0) / mean, 1e-12);
  EXPECT_NEAR(facts["smallest_angle_deg"].get<double>(), 45, 1e-9);
}

TEST(Info, ASheetIsOpen) {
  const json facts = info(sheet(5));
  expect_wrong_only(facts, {{"boundary_edges", 20}, {"boundary_loops", 1}});
  EXPECT_TRUE(facts["volume"].is_null());
  EXPECT_EQ(facts["reshape"]["solves"], true);
  EXPECT_THAT(facts["reshape"]["words"].get<std::string>(), HasSubstr("remeshed stand-in"));
}

TEST(Info, TwoSheetsHaveTwoLoops) {
  const json facts = info(joined(sheet(2), transformed(sheet(2), 1, {5, 0, 0})));
  expect_wrong_only(facts, {{"boundary_edges", 16}, {"boundary_loops", 2}});
  EXPECT_EQ(facts["components"], 2);
}

TEST(Info, SeveralPartsAreJoined) {
  const json facts = info(joined(sphere(1, 2), transformed(sphere(1, 2), 1, {5, 0, 0})));
  expect_wrong_only(facts, {});
  EXPECT_EQ(facts["components"], 2);
  EXPECT_EQ(facts["reshape"]["solves"], true);
  EXPECT_THAT(facts["reshape"]["words"].get<std::string>(), HasSubstr("2 components are held together"));
}

TEST(Info, AThirdTriangleAtAnEdge) {
  const json facts = info_of_obj(kTetrahedron + "v 3 3 3\nf 1 2 5\n");
  expect_wrong_only(
      facts, {{"boundary_edges", 2}, {"boundary_loops", 1}, {"non_manifold_edges", 1}, {"self_intersections", 1}});
  EXPECT_EQ(facts["first"]["non_manifold_edges"], json({0, 1}));
  EXPECT_EQ(facts["first"]["self_intersections"], json({2, 4})) << "it leaves through the face across";
  EXPECT_EQ(facts["reshape"]["solves"], true);
}

TEST(Info, TwoFansAtAVertex) {
  const json facts = info_of_obj(kTetrahedron + "v -1 0 0\nv 0 -1 0\nv 0 0 -1\nf 1 6 5\nf 1 5 7\nf 5 6 7\nf 6 1 7\n");
  expect_wrong_only(facts, {{"non_manifold_vertices", 1}});
  EXPECT_EQ(facts["components"], 1);
}

TEST(Info, ATriangleTheWrongWayRound) {
  const json facts = info_of_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 3 4\n");
  expect_wrong_only(facts, {{"inconsistent_edges", 3}});
  EXPECT_TRUE(facts["volume"].is_null());
}

TEST(Info, InsideOut) {
  const json facts = info_of_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  expect_wrong_only(facts, {});
  EXPECT_NEAR(facts["volume"].get<double>(), -1.0 / 6, 1e-12);
}

TEST(Info, ATriangleWithoutArea) {
  // The edge 1-2 is split at 5 on one side, and a flat triangle closes the gap.
  const json facts = info_of_obj(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0.5 0 0\n"
      "f 1 3 5\nf 5 3 2\nf 1 5 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  // The halves of the edge touch the triangle that has all of it.
  expect_wrong_only(facts, {{"degenerate_triangles", 1}, {"self_intersections", 2}});
  EXPECT_EQ(facts["first"]["degenerate_triangles"], 2);
  EXPECT_EQ(facts["reshape"]["solves"], true);
  EXPECT_THAT(facts["reshape"]["words"].get<std::string>(), HasSubstr("1 triangles without area"));
}

TEST(Info, AFaceWithAVertexTwice) {
  const json facts = info_of_obj(kTetrahedron + "f 1 2 2\n");
  expect_wrong_only(facts, {{"degenerate_triangles", 1}});
  EXPECT_EQ(facts["warnings"].size(), 1);
}

TEST(Info, ThingsTwice) {
  const json facts = info_of_obj(kTetrahedron + "v 0 0 1\nf 2 3 4\n");
  expect_wrong_only(facts, {{"duplicate_triangles", 1},
                            {"duplicate_vertices", 1},
                            {"isolated_vertices", 1},
                            {"non_manifold_edges", 3},
                            {"self_intersections", 1}});
  EXPECT_EQ(facts["first"]["duplicate_triangles"], 4);
  EXPECT_EQ(facts["first"]["self_intersections"], json({2, 4}));
  EXPECT_EQ(facts["components"], 1);
}

TEST(Info, RealMeshesAreCountedAsOthersCountedThem) {
  if (!has_shared()) GTEST_SKIP() << "no shared meshes";
  const std::map<std::string, std::string> columns = {{"tris", "triangles"},
                                                      {"comps", "components"},
                                                      {"boundary", "boundary_edges"},
                                                      {"nm_edges", "non_manifold_edges"},
                                                      {"nm_verts", "non_manifold_vertices"},
                                                      {"misoriented", "inconsistent_edges"},
                                                      {"dup_verts", "duplicate_vertices"},
                                                      {"isolated_verts", "isolated_vertices"},
                                                      {"welded_comps", "welded_components"}};
  int compared = 0;
  for (const ListedMesh& listed : listed_meshes()) {
    if (listed.letter() > 'C') continue;
    const json facts = info(listed.path);
    for (const auto& [column, name] : columns)
      EXPECT_EQ(facts[name], listed.number(column)) << listed.name << ' ' << name;
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(Info, PartsThatCrossAndTheirFirstTriangles) {
  const Mesh crossed = joined(box({1, 1, 1}, 2), transformed(box({1, 1, 1}, 2), 1, {0.3, 0.2, 0.1}));
  const json facts = info(crossed);
  EXPECT_GT(facts["self_intersections"], 20);
  EXPECT_EQ(facts["self_intersections_complete"], true);
  EXPECT_LT(facts["first"]["self_intersections"][0], 48);
  EXPECT_GE(facts["first"]["self_intersections"][1], 48);
  EXPECT_EQ(info(box({1, 1, 1}, 2))["first"], json::object());
}

TEST(Info, PartsThatTouchAreOneOnceWelded) {
  const json facts = info(joined(box({1, 1, 1}, 2), transformed(box({1, 1, 1}, 2), 1, {1, 1, 1})));
  expect_wrong_only(facts, {{"duplicate_vertices", 1}});
  EXPECT_EQ(facts["components"], 2);
  EXPECT_EQ(facts["welded_components"], 1);
}

TEST(Info, Needles) {
  // One of 2 triangles is a needle.
  const json facts = info_of_obj("v 0 0 0\nv 1 0 0\nv 0.5 0.8 0\nv 0.5 -0.04 0\nf 1 2 3\nf 2 1 4\n");
  EXPECT_EQ(facts["needle_fraction"], 0.5);
  EXPECT_NEAR(facts["smallest_angle_deg"].get<double>(), 4.574, 1e-3);
  EXPECT_GT(facts["low_angle_deg"], facts["smallest_angle_deg"]);
}

TEST(Info, AllAtOnePointIsToldWithoutRatios) {
  const TempFolder folder;
  write_text(folder / "point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  const Outcome outcome = run({"info", (folder / "point.obj").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex("mean edge +0\n"));
  EXPECT_THAT(outcome.out, testing::Not(HasSubstr("nan")));
}

TEST(Info, TheTableSaysTheSameInWords) {
  const TempFolder folder;
  write_mesh(folder / "sheet.obj", sheet(5));
  const Outcome outcome = run({"info", (folder / "sheet.obj").string(), "--json", (folder / "facts.json").string()});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, testing::ContainsRegex("boundary edges +20\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("boundary loops +1\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("first, counted from 0 +boundary edges 0-1\n"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("self intersections +0\n"));
  EXPECT_THAT(outcome.out, HasSubstr("reshape solves a remeshed stand-in"));
  EXPECT_EQ(json::parse(read_text(folder / "facts.json"))["boundary_edges"], 20);
}

}  // namespace
}  // namespace swage::test
