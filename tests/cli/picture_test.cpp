// `swage compare --picture`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.h"
#include "shapes.h"
#include "swage/mesh_io.h"
#include "swage/render.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

/// Of a PNG file, by its header (RFC 2083); -1 of none.
std::pair<int, int> size_of_png(const std::filesystem::path& path) {
  const std::string bytes = read_text(path);
  if (bytes.size() < 24 || bytes.substr(0, 8) != "\x89PNG\r\n\x1A\n") return {-1, -1};
  const auto number = [&](size_t at) {
    int value = 0;
    for (size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    return value;
  };
  return {number(16), number(20)};
}

class PictureProgram : public testing::Test {
 protected:
  PictureProgram() {
    Mesh mesh = cylinder(0.5, 1, 24, 4);
    write_mesh(rest_, mesh);
    std::filesystem::create_directory(edits_);
    mesh.positions.col(1) *= 1.5;
    write_mesh(std::filesystem::path(edits_) / "b_longer.obj", mesh);
    mesh.positions.col(0) *= 1.5;
    write_mesh(std::filesystem::path(edits_) / "a_flat.ply", mesh);
    write_text(std::filesystem::path(edits_) / "notes.txt", "no mesh");
  }

  Outcome compare(Arguments arguments, const std::string& size = "400x200") const {
    arguments.insert(arguments.begin(), {"compare", rest_, edits_});
    if (!size.empty()) arguments.insert(arguments.end(), {"--size", size});
    return run(arguments);
  }

  TempFolder folder_;
  std::string rest_ = folder_ / "rest.obj", edits_ = folder_ / "edits", picture_ = folder_ / "picture.png";
};

class DrawnPicture : public PictureProgram {
 protected:
  void SetUp() override {
    if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  }
};

TEST_F(DrawnPicture, ShowsAFolderOfEdits) {
  const Outcome outcome = compare({"--picture", picture_});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(size_of_png(picture_), std::pair(400, 200));
  const size_t flat = outcome.out.find("a_flat.ply"), longer = outcome.out.find("b_longer.obj");
  EXPECT_LT(flat, longer) << "in the order of their names";
  EXPECT_NE(longer, std::string::npos);
  EXPECT_EQ(outcome.out.find("notes.txt"), std::string::npos);
}

TEST_F(DrawnPicture, ChangesWithWhatIsAskedFor) {
  std::vector<std::string> seen;
  const std::vector<Arguments> asked{{},
                                     {"--heat", "uneven"},
                                     {"--heat", "size"},
                                     {"--heat", "none"},
                                     {"--view", "0,0.2,1"},
                                     {"--up", "z"},
                                     {"--pin", "y<=0%", "--move", "y>=100%=0,0.5,0"}};
  for (Arguments arguments : asked) {
    arguments.insert(arguments.end(), {"--picture", picture_});
    const Outcome outcome = compare(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    seen.push_back(read_text(picture_));
    for (size_t k = 0; k + 1 < seen.size(); ++k) EXPECT_FALSE(seen[k] == seen.back()) << k << ' ' << seen.size();
  }
  compare({"--picture", picture_, "--threads", "1"});
  EXPECT_TRUE(read_text(picture_) == seen.front());
}

TEST_F(PictureProgram, RefusesWrongUse) {
  const auto expect = [&](const std::string& says, const Arguments& arguments, const std::string& size = "") {
    const std::vector<std::string> before = names_in(folder_.path());
    const Outcome outcome = compare(arguments, size);
    EXPECT_EQ(outcome.code, 2) << says;
    EXPECT_THAT(outcome.err, HasSubstr(says));
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(names_in(folder_.path()), before);
  };
  expect("name a .png file", {"--picture", folder_ / "picture.jpg"});
  expect("name a .png file", {"--picture", "-"});
  expect("there is no folder", {"--picture", folder_ / "missing/picture.png"});
  expect("--json both name", {"--picture", picture_, "--json", picture_});
  expect("--heat", {"--picture", picture_, "--heat", "warm"});
  expect("--heat requires --picture", {"--heat", "none"});
  expect("--view 1,2", {"--picture", picture_, "--view", "1,2"});
  expect("--view 0,0,0", {"--picture", picture_, "--view", "0,0,0"});
  expect("--up", {"--picture", picture_, "--up", "w"});
  for (const char* size : {"10x200", "400", "400x20000", "a400x200", "400.5x200"}) {
    expect(std::string("--size ") + size, {"--picture", picture_}, size);
  }
}

TEST_F(PictureProgram, AFolderWithoutMeshesIsRefused) {
  std::filesystem::create_directory(folder_ / "empty");
  const Outcome outcome = run({"compare", rest_, folder_ / "empty"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("there is no edit in this folder"));
}

TEST_F(PictureProgram, APictureIsMadeOrTheBuildSaysWhyNot) {
  const Outcome outcome = compare({"--picture", picture_});
  EXPECT_EQ(outcome.code, can_render() ? 0 : 4);
  EXPECT_EQ(std::filesystem::exists(picture_), can_render());
  if (!can_render()) {
    EXPECT_THAT(outcome.err, HasSubstr("SWAGE_RENDER"));
  }
}

}  // namespace
}  // namespace swage::test
