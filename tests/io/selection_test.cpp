// Vertices selected in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.h"
#include "samples.h"
#include "swage/error.h"
#include "swage/handles.h"

namespace swage::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Vertices 0 .. 5 at x = 0, 0.1, .., 0.5; triangles 0 1 2 and 3 4 5 in groups left and right; vertex 6 lone.
MeshFile two_triangles() {
  return read_bytes("a.obj",
                    "v 0 0 0\nv 0.1 1 0\nv 0.2 2 0\nv 0.3 0 1\nv 0.4 1 1\nv 0.5 2 7\nv 0.5 0 0\n"
                    "g left\nf 1 2 3\ng right part\nf 4 5 6\n");
}

std::vector<int> select(const std::string& text) { return Selection(text).vertices(two_triangles()); }

std::string complaint(const std::string& text) {
  try {
    Selection(text).vertices(two_triangles());
  } catch (const InvalidInput& error) {
    return error.what();
  }
  ADD_FAILURE() << text << " was understood";
  return "";
}

using Vertices = std::vector<int>;

TEST(Selection, ByNumber) {
  EXPECT_EQ(select("3"), (Vertices{3}));
  EXPECT_EQ(select("5,1-3, 2 ,0"), (Vertices{0, 1, 2, 3, 5}));
  EXPECT_EQ(select("0-6").size(), 7u);
}

TEST(Selection, ByHalfSpace) {
  EXPECT_EQ(select("x<0.2"), (Vertices{0, 1}));
  EXPECT_EQ(select("x<=0.2"), (Vertices{0, 1, 2}));
  EXPECT_EQ(select("y > 1"), (Vertices{2, 5}));
  EXPECT_EQ(select("z>=1"), (Vertices{3, 4, 5}));
}

TEST(Selection, ByPercentOfTheBox) {
  EXPECT_EQ(select("x>=100%"), (Vertices{5, 6}));
  EXPECT_EQ(select("x<=0%"), (Vertices{0}));
  EXPECT_EQ(select("z<50%"), (Vertices{0, 1, 2, 3, 4, 6}));
  EXPECT_EQ(select("y>=50%&y<=50 %"), (Vertices{1, 4}));
}

TEST(Selection, ByBox) {
  EXPECT_EQ(select("box:0.1,1,0,0.4,2,1"), (Vertices{1, 2, 4}));
  EXPECT_EQ(select("box: 0.4,2,1, 0.1,1,0"), (Vertices{1, 2, 4}));
}

TEST(Selection, ByComponentAndGroup) {
  EXPECT_EQ(select("component:0"), (Vertices{0, 1, 2}));
  EXPECT_EQ(select("component:2"), (Vertices{6}));
  EXPECT_EQ(select("group:left"), (Vertices{0, 1, 2}));
  EXPECT_EQ(select("group:part & y>0"), (Vertices{4, 5}));
}

TEST(Selection, FromAFile) {
  const TempFolder folder;
  write_text(folder / "ids", "4, 2\r\n\n5\t0,0");
  EXPECT_EQ(select("@" + (folder / "ids").string()), (Vertices{0, 2, 4, 5}));
  for (const char* text : {"1 x", "1 -2", "1 7", "1.5", "99999999999999999999"}) {
    write_text(folder / "ids", std::string("3\n") + text);
    EXPECT_THROW(select("@" + (folder / "ids").string()), UnreadableFile) << text;
  }
  EXPECT_THROW(select("@" + (folder / "missing").string()), UnreadableFile);
}

Eigen::AlignedBox3d region(const std::string& text) {
  const auto box = Selection(text).region(two_triangles());
  EXPECT_TRUE(box) << text;
  return box.value_or(Eigen::AlignedBox3d());
}

// The mesh's box is (0, 0, 0) to (0.5, 2, 7).
TEST(Selection, BoxesAndHalfSpacesAreRegions) {
  EXPECT_EQ(region("box:0.1,1,2,0.4,2,3").min(), Eigen::Vector3d(0.1, 1, 2));
  EXPECT_EQ(region("box:0.4,1,3,0.1,2,2").max(), Eigen::Vector3d(0.4, 2, 3));
  EXPECT_EQ(region("y>=25% & z<=5").min(), Eigen::Vector3d(0, 0.5, 0));
  EXPECT_EQ(region("y>=25% & z<=5").max(), Eigen::Vector3d(0.5, 2, 5));
  EXPECT_EQ(region("box:-9,-9,-9,9,1,9 & y>=1").sizes(), Eigen::Vector3d(0.5, 0, 7)) << "clipped to the mesh's box";
}

TEST(Selection, ARegionHoldsTheVerticesSelected) {
  const Positions positions = two_triangles().mesh.positions;
  for (const char* text : {"x<0.2", "x<=0.2", "x>0.2", "x>=0.2", "y>0&y<2", "z>=100%", "box:0.1,1,0,0.4,2,1 & x>0.1"}) {
    const Eigen::AlignedBox3d box = region(text);
    Vertices inside;
    for (int v = 0; v < positions.rows(); ++v) {
      if (box.contains(positions.row(v).transpose())) inside.push_back(v);
    }
    EXPECT_EQ(inside, select(text)) << text;
  }
}

TEST(Selection, ARegionNeedsNoVertex) {
  EXPECT_THROW(select("box:0.1,0.4,3,0.2,0.6,4"), InvalidInput);
  EXPECT_NEAR(region("box:0.1,0.4,3,0.2,0.6,4").volume(), 0.1 * 0.2, 1e-12);
  for (const char* text : {"box:1,0,0,2,1,1", "x<0%", "z>7", "x<0.2 & x>0.2", "x<0.1&x>0.3"}) {
    EXPECT_THROW(static_cast<void>(Selection(text).region(two_triangles())), InvalidInput) << text;
  }
}

TEST(Selection, WhatIsNoRegionHasNone) {
  const TempFolder folder;
  write_text(folder / "ids", "1");
  for (const std::string& text : {std::string("1"), std::string("component:0"), std::string("group:left & x>0"),
                                  "x>0 & @" + (folder / "ids").string()}) {
    EXPECT_FALSE(Selection(text).region(two_triangles())) << text;
  }
}

TEST(Selection, QuotesWhatItDoesNotUnderstand) {
  for (const char* text : {"",
                           "&1",
                           "1&",
                           "1,,2",
                           "1,",
                           "-1",
                           "1-",
                           "1-2-3",
                           "5-2",
                           "1.5",
                           "x",
                           "x<",
                           "x=1",
                           "x<1a",
                           "x<nan",
                           "x<1%%",
                           "x<%",
                           "w<1",
                           "box:1,2,3",
                           "box:1,2,3,4,5,six",
                           "box:1,2,3,4,5,6,7",
                           "@",
                           "component:",
                           "component:-1",
                           "component:x",
                           "group:",
                           "all",
                           "xy<1",
                           "1 2"}) {
    EXPECT_THROW(Selection{text}, InvalidInput) << text;
  }
  EXPECT_THAT(complaint("1 & x=3"), HasSubstr("'x=3'"));
  EXPECT_THAT(complaint("1,2,seven"), HasSubstr("'seven'"));
}

TEST(Selection, NamesWhatIsNotThere) {
  EXPECT_THAT(complaint("3,5-7"), AllOf(HasSubstr("vertex 7"), HasSubstr("from 0 to 6")));
  EXPECT_THAT(complaint("99999999999999999999"), HasSubstr("from 0 to 6"));
  EXPECT_THAT(complaint("component:3"), AllOf(HasSubstr("component 3"), HasSubstr("from 0 to 2")));
  EXPECT_THAT(complaint("group:middle"), AllOf(HasSubstr("'group:middle'"), HasSubstr("left, part, right")));
  EXPECT_THAT(complaint("x>0.5"), AllOf(HasSubstr("'x>0.5'"), HasSubstr("selects no vertex")));
  EXPECT_THAT(complaint("group:left & group:right"), HasSubstr("selects no vertex"));
}

}  // namespace
}  // namespace swage::test
