// Gestures, straight chains and curvature files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "places.h"
#include "samples.h"
#include "shapes.h"
#include "swage/curvature.h"
#include "swage/error.h"
#include "swage/handles.h"

namespace swage::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

template <typename Error, typename Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}

TEST(Gesture, RefusesASecondTarget) {
  Gesture gesture;
  gesture.add(4, {1, 2, 3});
  EXPECT_NO_THROW(gesture.add(4, {1, 2, 3}));
  EXPECT_THAT(message_of<InvalidInput>([&] { gesture.add(4, {1, 2, 4}); }), HasSubstr("vertex 4"));
  EXPECT_EQ(gesture.targets.at(4), Eigen::Vector3d(1, 2, 3));
}

// Two boxes and a lone vertex after them.
Mesh three_parts() {
  Mesh mesh = joined(box({1, 1, 1}, 1), box({1, 1, 1}, 2));
  mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
  mesh.positions.bottomRows<1>().setZero();
  return mesh;
}

std::string complaint(const Gesture& gesture, const Mesh& mesh) {
  return message_of<InvalidInput>([&] { check(gesture, mesh.positions, mesh.triangles); });
}

TEST(Gesture, OneHandleIsEnough) {
  const Mesh mesh = three_parts();
  Gesture gesture;
  EXPECT_THAT(complaint(gesture, mesh), HasSubstr("no handles"));
  gesture.add(1, Eigen::Vector3d::Zero());
  EXPECT_NO_THROW(check(gesture, mesh.positions, mesh.triangles));
}

TEST(Gesture, HandlesAreVerticesWithFiniteTargets) {
  const Mesh ball = sphere(1, 1);
  const int count = static_cast<int>(ball.positions.rows());
  for (const int vertex : {-1, count}) {
    Gesture gesture;
    gesture.add(vertex, Eigen::Vector3d::Zero());
    EXPECT_THAT(complaint(gesture, ball), HasSubstr("handle " + std::to_string(vertex)));
  }
  for (const double x : {std::nan(""), std::numeric_limits<double>::infinity(), 2e12}) {
    Gesture gesture;
    gesture.add(7, {0, x, 0});
    EXPECT_THAT(complaint(gesture, ball), HasSubstr("handle 7"));
  }
}

TEST(Gestures, AreReadInUnitsOfTheDiagonal) {
  const TempFolder folder;
  Positions rest(3, 3);
  rest << 1, 1, 1, 4, 5, 1, 2, 2, 1;  // The diagonal is 5.
  write_text(folder / "a.deform", R"([{"displacements": {"2": [0.2, 0, -1], "0": [0, 0.0, 0]}, "label": "one"},
                                      {"label": "two", "displacements": {}}])");
  const std::vector<Gesture> gestures = read_gestures(folder / "a.deform", rest);
  ASSERT_EQ(gestures.size(), 2u);
  EXPECT_EQ(gestures[0].label, "one");
  ASSERT_EQ(gestures[0].targets.size(), 2u);
  EXPECT_EQ(gestures[0].targets.at(2), Eigen::Vector3d(3, 2, -4));
  EXPECT_EQ(gestures[0].targets.at(0), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(gestures[1].label, "two");
}

TEST(Gestures, ComeBackAsWritten) {
  const TempFolder folder;
  const Positions rest = moved_pyramid();
  Gesture first{"first \"quoted\"", {{0, {1, 2, 3}}, {3, rest.row(3)}}},
      second{"zweite \xc3\xa4", {{4, {-1e3, 0, 1e-9}}}};
  write_gestures(folder / "a.deform", {first, second}, rest);
  const std::vector<Gesture> gestures = read_gestures(folder / "a.deform", rest);
  ASSERT_EQ(gestures.size(), 2u);
  EXPECT_EQ(gestures[0].label, first.label);
  EXPECT_EQ(gestures[1].label, second.label);
  EXPECT_EQ(gestures[0].targets.at(3), first.targets.at(3)) << "anchors come back exactly";
  EXPECT_LT((gestures[0].targets.at(0) - first.targets.at(0)).norm(), 1e-14 * 30);
  EXPECT_LT((gestures[1].targets.at(4) - second.targets.at(4)).norm(), 1e-15 * 1e3);
}

TEST(Gestures, RefuseToWriteWhatCannotBeRead) {
  const TempFolder folder;
  const Positions rest = pyramid();
  EXPECT_THROW(write_gestures(folder / "a", {{"a", {{5, {0, 0, 0}}}}}, rest), InvalidInput);
  EXPECT_THROW(write_gestures(folder / "a", {{"a", {{0, {0, std::nan(""), 0}}}}}, rest), InvalidInput);
  EXPECT_THROW(write_gestures(folder / "a", {}, Positions::Zero(2, 3)), InvalidInput);
  EXPECT_THROW(write_gestures(folder / "missing" / "a", {}, rest), UnwritableFile);
}

TEST(Gestures, BadFilesAreRefusedNamingGestureAndVertex) {
  struct BadGesture {
    std::string text;
    std::vector<std::string> words;
  };
  const auto one = [](const std::string& displacements) {
    return R"([{"displacements": )" + displacements + R"(, "label": "pull"}])";
  };
  const std::vector<BadGesture> files = {
      {"", {"JSON"}},
      {"[\n{]", {"line 2", "JSON"}},
      {"{}", {"list of gestures"}},
      {"[]", {"holds no gesture"}},
      {"[3]", {"gesture 1"}},
      {R"([{"displacements": {}}])", {"gesture 1", "label"}},
      {R"([{"label": 7, "displacements": {}}])", {"gesture 1", "label"}},
      {R"([{"label": "pull"}])", {"'pull'", "displacements"}},
      {one("[1, 2, 3]"), {"'pull'", "displacements"}},
      {one(R"({"1": 3})"), {"'pull'", "vertex 1"}},
      {one(R"({"1": [1, 2]})"), {"'pull'", "vertex 1"}},
      {one(R"({"1": [1, 2, "x"]})"), {"'pull'", "vertex 1"}},
      {one(R"({"1": [1, 2, null]})"), {"'pull'", "vertex 1"}},
      {one(R"({"1": [1, 2, NaN]})"), {"line 1", "JSON"}},
      {one(R"({"1": [1, 2, 1e999]})"), {"double precision"}},
      {one(R"({"1": [1, 2, 1.7e308]})"), {"'pull'", "vertex 1", "too large"}},
      {one(R"({"5": [1, 2, 3]})"), {"'pull'", "vertex '5'", "from 0 to 4"}},
      {one(R"({"99999999999999999999": [1, 2, 3]})"), {"'pull'", "from 0 to 4"}},
      {one(R"({"-1": [1, 2, 3]})"), {"'pull'", "'-1'"}},
      {one(R"({"01": [1, 2, 3]})"), {"'pull'", "'01'"}},
      {one(R"({"": [1, 2, 3]})"), {"'pull'", "''"}},
      {one(R"({"1": [0, 0, 0], "2": [0, 0, 0], "1": [1, 0, 0]})"), {"'pull'", "'1' comes twice"}},
      {R"([{"label": "a", "displacements": {}}, {"label": "b", "displacements": {"3": [0,0,0], "3": [0,0,0]}}])",
       {"'b'", "'3' comes twice"}},
      {R"([{"label": "a", "displacements": {}}, {"label": "a", "displacements": {}}])", {"two gestures", "'a'"}}};
  const TempFolder folder;
  for (const BadGesture& bad : files) {
    write_text(folder / "a.deform", bad.text);
    const std::string message = message_of<UnreadableFile>([&] { read_gestures(folder / "a.deform", pyramid()); });
    EXPECT_THAT(message, HasSubstr("a.deform")) << bad.text;
    for (const std::string& word : bad.words) EXPECT_THAT(message, HasSubstr(word)) << bad.text;
  }
  EXPECT_THROW(read_gestures(folder / "missing", pyramid()), UnreadableFile);
}

TEST(Gestures, OfficialFilesAreReadAsTheyAre) {
  if (!has_shared()) GTEST_SKIP() << "no real gestures beside this checkout";
  int read = 0;
  for (const auto& model : std::filesystem::directory_iterator(shared("oracle/reshape"))) {
    if (!model.is_directory()) continue;
    const std::string name = model.path().filename();
    const MeshFile file = read_mesh(model.path() / (name + ".obj"));
    for (const Gesture& gesture : read_gestures(model.path() / (name + ".deform"), file.mesh.positions)) {
      EXPECT_FALSE(gesture.targets.empty());
      EXPECT_NO_THROW(check(gesture, file.mesh.positions, file.mesh.triangles));
      ++read;
    }
    const int triangles = static_cast<int>(file.mesh.triangles.rows());
    const int vertices = static_cast<int>(file.mesh.positions.rows());
    EXPECT_EQ(read_unit_box_curvatures(model.path() / (name + ".fk"), triangles).rows(), triangles);
    EXPECT_THROW(read_unit_box_curvatures(model.path() / (name + ".fk"), triangles + 1), UnreadableFile);
    if (!std::filesystem::exists(model.path() / (name + ".straight"))) continue;
    EXPECT_FALSE(read_straight_chains(model.path() / (name + ".straight"), vertices).empty());
  }
  EXPECT_GE(read, 17);
}

TEST(StraightChains, AreReadLineByLine) {
  const TempFolder folder;
  write_text(folder / "a.straight", "0 1 2 \n\n 4\t3 1\r\n");
  EXPECT_EQ(read_straight_chains(folder / "a.straight", 5), (std::vector<std::vector<int>>{{0, 1, 2}, {4, 3, 1}}));
  const std::vector<std::pair<const char*, const char*>> bad = {{"0 1\n2 5", "line 2: vertex 5"},
                                                                {"0 -1", "line 1: vertex -1"},
                                                                {"0 1 x", "line 1: a vertex number is expected"},
                                                                {"0 1.5", "line 1"},
                                                                {"0\n1 2 2", "line 2: vertex 2 comes twice"},
                                                                {"0 99999999999999999999", "line 1"}};
  for (const auto& [text, words] : bad) {
    write_text(folder / "a.straight", text);
    EXPECT_THAT(message_of<UnreadableFile>([&] { read_straight_chains(folder / "a.straight", 5); }), HasSubstr(words));
  }
}

TEST(StraightChains, ComeBackAsWritten) {
  const TempFolder folder;
  const std::vector<std::vector<int>> chains = {{3, 1, 2}, {7}, {0, 99999, 0}};
  write_text(folder / "a.straight", "9 8 7");
  write_straight_chains(folder / "a.straight", chains);
  EXPECT_EQ(read_text(folder / "a.straight"), "3 1 2\n7\n0 99999 0\n");
  EXPECT_EQ(read_straight_chains(folder / "a.straight", 100000), chains);
  write_straight_chains(folder / "a.straight", {});
  EXPECT_TRUE(read_straight_chains(folder / "a.straight", 1).empty());
}

TEST(StraightChains, RefuseToBeWrittenWhereTheyCouldNotBeRead) {
  const TempFolder folder;
  for (const std::vector<int>& bad : {std::vector<int>{}, {1, -2}, {4, 4}}) {
    EXPECT_THAT(message_of<InvalidInput>([&] {
                  write_straight_chains(folder / "a", {{1, 2}, bad});
                }),
                HasSubstr("chain 1"));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a"));
  EXPECT_THROW(write_straight_chains(folder / "missing" / "a", {{1, 2}}), UnwritableFile);
}

TEST(CurvatureFile, HasALineATriangle) {
  const TempFolder folder;
  write_text(folder / "a.fk", "1.5 -2e-3\r\n0 0\n\n");
  const Curvatures read = read_unit_box_curvatures(folder / "a.fk", 2);
  ASSERT_EQ(read.rows(), 2);
  EXPECT_EQ(read(0, 0), 1.5);
  EXPECT_EQ(read(0, 1), -2e-3);
  const std::vector<std::pair<const char*, const char*>> bad = {
      {"1 2\n", "2 in all"}, {"1 2\n1 2\n1 2\n", "line 3"}, {"1 2\n1\n", "line 2"},       {"1 2 3\n1 2\n", "line 1"},
      {"1 2\nx 2\n", "'x'"}, {"1 2\n1 nan\n", "line 2"},    {"1 1e999\n1 2\n", "line 1"}, {"", "there are 0"}};
  for (const auto& [text, words] : bad) {
    write_text(folder / "a.fk", text);
    EXPECT_THAT(message_of<UnreadableFile>([&] { read_unit_box_curvatures(folder / "a.fk", 2); }), HasSubstr(words));
  }
}

}  // namespace
}  // namespace swage::test
