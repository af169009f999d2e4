// PNG files whose colours are directions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "places.h"
#include "png_bytes.h"
#include "swage/error.h"
#include "swage/render.h"
#include "swage/style_io.h"

namespace swage::test {
namespace {

using testing::FloatNear;
using testing::HasSubstr;

class NormalPictures : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_read()) GTEST_SKIP() << "this build reads no pictures";
  }

  bool can_read() const {
    try {
      read(png_bytes({1, 1}, "\xFF\x80\x80"));
      return true;
    } catch (const Unavailable&) {
      return false;
    }
  }

  NormalPicture read(const std::string& bytes) const {
    write_text(folder_ / "picture.png", bytes);
    return read_normal_picture(folder_ / "picture.png");
  }

  void expect_refused(const std::string& bytes, const std::string& words) const {
    try {
      read(bytes);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const UnreadableFile& refused) {
      EXPECT_THAT(refused.what(), HasSubstr(words));
      EXPECT_THAT(refused.what(), HasSubstr("picture.png"));
    }
  }

  TempFolder folder_;
};

TEST_F(NormalPictures, ColoursAreDirections) {
  const NormalPicture picture = read(png_bytes({2, 2}, std::string("\xFF\x80\x7F"
                                                                   "\x80\x00\x80"
                                                                   "\x80\x80\xFF"
                                                                   "\xC0\xC0\x80",
                                                                   12)));
  EXPECT_EQ(picture.width, 2);
  EXPECT_EQ(picture.height, 2);
  const float tilted = 2 * 192 / 255.0f - 1;
  EXPECT_EQ(picture.normals, (std::vector<float>{1, 0, 0, 0, -1, 0, 0, 0, 1, tilted, tilted, 0}));
}

TEST_F(NormalPictures, WhatIsNoDirectionHasNone) {
  // Black, white, grey, transparent, half transparent, opaque enough.
  const NormalPicture picture = read(png_bytes({6, 1, 8, PngColours::rgba, {}}, std::string("\x00\x00\x00\xFF"
                                                                                            "\xFF\xFF\xFF\xFF"
                                                                                            "\x80\x80\x80\xFF"
                                                                                            "\x80\x80\xFF\x00"
                                                                                            "\x80\x80\xFF\x7F"
                                                                                            "\x80\x80\xFF\x80",
                                                                                            24)));
  for (size_t i = 0; i < 15; ++i) EXPECT_EQ(picture.normals[i], 0) << i;
  EXPECT_EQ(picture.normals[17], 1);
}

TEST_F(NormalPictures, SixteenBitsAndPalettesAreRead) {
  const NormalPicture fine =
      read(png_bytes({1, 1, 16, PngColours::rgb, {}}, std::string("\x7F\xFF\x80\x00\xFF\xFF", 6)));
  EXPECT_EQ(fine.normals, (std::vector<float>{0, 0, 1}));
  // 0x9000 is between two values of 8 bits.
  const NormalPicture between =
      read(png_bytes({1, 1, 16, PngColours::rgb, {}}, std::string("\x90\x42\x80\x00\xFF\xFF", 6)));
  EXPECT_THAT(between.normals[0], FloatNear(2 * 0x9042 / 65535.0f - 1, 1e-6f));
  const NormalPicture few = read(png_bytes({2, 1, 8, PngColours::palette, "\x80\x80\xFF\xFF\x80\x80"},
                                           "\1"
                                           "\1"));
  EXPECT_EQ(few.normals, (std::vector<float>{1, 0, 0, 1, 0, 0}));
}

TEST_F(NormalPictures, MayHaveChunksOfNoPixels) {
  std::string bytes = png_bytes({1, 1}, "\xFF\x80\x7F");
  bytes.insert(33, std::string("\0\0\0\0IDAT\x35\xAF\x06\x1E", 12));
  EXPECT_EQ(read(bytes).normals, (std::vector<float>{1, 0, 0}));
}

TEST_F(NormalPictures, OtherFilesAreRefusedInWords) {
  const std::string good = png_bytes({40, 40}, std::string(4800, '\xFF'));
  expect_refused("", "is no PNG file");
  expect_refused("\xFF\xD8\xFF\xE0 JFIF", "is no PNG file");
  expect_refused(png_bytes({2, 1, 8, PngColours::grey, {}}, "\x80\x90"), "grey picture");
  for (const size_t length : {9u, 20u, 33u, 60u, 2000u}) expect_refused(good.substr(0, length), "damaged PNG");
  expect_refused(good.substr(0, good.size() - 12), "damaged PNG");
  // Of 65536 x 65536 pixels, it says.
  std::string huge = good;
  huge.replace(16, 8, std::string("\x00\x01\x00\x00\x00\x01\x00\x00", 8));
  expect_refused(huge, "make it smaller");
  // A chunk of a gigabyte, it says, and one before the header.
  std::string greedy = good;
  greedy.replace(33, 4, std::string("\x3F\x00\x00\x00", 4));
  expect_refused(greedy, "ends within a chunk");
  expect_refused(good.substr(0, 33) + std::string("\x3F\x00\x00\x00IDAT\x78\x01", 10), "ends within a chunk");
  expect_refused(good.substr(0, good.size() - 12), "has no end");
  expect_refused(good.substr(0, 8) + std::string("\0\0\0\0CgBI\0\0\0\0", 12) + good.substr(8), "damaged PNG");
  EXPECT_THROW(read_normal_picture(folder_ / "missing.png"), UnreadableFile);
  EXPECT_THROW(read_normal_picture(folder_.path()), UnreadableFile);
}

TEST_F(NormalPictures, WhatIsWrittenIsReadAgain) {
  if (!can_render()) GTEST_SKIP() << "this build makes no pictures";
  const NormalPicture picture = read(png({1, 2, {128, 255, 128, 0, 128, 127}}));
  EXPECT_EQ(picture.normals, (std::vector<float>{0, 1, 0, -1, 0, 0}));
}

}  // namespace
}  // namespace swage::test
