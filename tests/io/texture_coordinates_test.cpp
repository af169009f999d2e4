// Texture coordinates of OBJ files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.h"
#include "samples.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

const std::string kSquareCorners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string refusal_of(const std::string& name, const std::string& bytes) {
  try {
    read_texture_coordinates(read_bytes(name, bytes));
  } catch (const UnreadableFile& refused) {
    return refused.what();
  }
  ADD_FAILURE() << "not refused";
  return {};
}

/// Of a corner, u and v.
Eigen::RowVector2d at(const TextureCoordinates& texture, Eigen::Index triangle, Eigen::Index corner) {
  return texture.points.row(texture.triangles(triangle, corner));
}

TEST(TextureCoordinates, AreOfTheCornersThatTheMeshHas) {
  // Corners end where a line is continued and where a comment begins.
  for (const char* const face :
       {"f 1/1\\\n2/2\\\n3/3\n", "f 1/1/\\\n2/2/1 3/3# 4/1\n", "f 1/1 2/2/ 3/3/#x 1/2 4/1\n"}) {
    const MeshFile file = read_bytes("a.obj", kSquareCorners + "vt 0 0\nvt 1 0\nvt 1 1\n" + face);
    ASSERT_EQ(file.polygons, (std::vector<std::vector<int>>{{0, 1, 2}})) << face;
    EXPECT_EQ(read_texture_coordinates(file).triangles, Eigen::RowVector3i(0, 1, 2)) << face;
  }
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 0\nf 1\\\n2/1 3/1\n"), HasSubstr("the corner '1' of a face"));
  // Names of a group and of an object, and no faces.
  const MeshFile file = read_bytes("a.obj", kSquareCorners +
                                                "vt 0 0\nvt 1 0\nvt 1 1\ng a \\\nf 1/1 2/2 3/3\no \\\nf 1/1 2/2 3/3\n"
                                                "f 4/3 3/2 2/1\n");
  ASSERT_EQ(file.polygons.size(), 1u);
  EXPECT_EQ(read_texture_coordinates(file).triangles, Eigen::RowVector3i(2, 1, 0));
}

TEST(TextureCoordinates, FollowTheTrianglesOfPolygons) {
  // A face that is skipped, one that is cut in two, one counted back, and points after the faces that name them.
  const MeshFile file = read_bytes("a.obj", kSquareCorners +
                                                "vt 0 0\nvt 0.5 0 0\nvt .5 1\nf 1 2\nf 1/1 2/2/1 3/3 4/4/\n"
                                                "f 1/-1 2/-2 4/-3\nvt 0 1\nvn 0 0 1\n");
  const TextureCoordinates texture = read_texture_coordinates(file);
  ASSERT_EQ(texture.points.rows(), 4);
  ASSERT_EQ(texture.triangles.rows(), 3);
  for (Eigen::Index t = 0; t < 2; ++t) {
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::RowVector3d p = file.mesh.positions.row(file.mesh.triangles(t, k));
      EXPECT_EQ(at(texture, t, k), Eigen::RowVector2d(p[0] / 2, p[1])) << t << ' ' << k;
    }
  }
  EXPECT_EQ(texture.triangles.row(2), Eigen::RowVector3i(2, 1, 0));
  EXPECT_EQ(file.triangle_polygons, (std::vector<int>{0, 0, 1}));
}

TEST(TextureCoordinates, StayWithTheirTrianglesWhereOthersAreLeftOut) {
  const MeshFile file = read_bytes("a.obj", kSquareCorners + "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 2/2\nf 1/3 2/1 3/2\n");
  EXPECT_EQ(read_texture_coordinates(file).triangles.row(0), Eigen::RowVector3i(2, 0, 1));
}

TEST(TextureCoordinates, AreRefusedWhereTheyAreMissing) {
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "f 1 2 3\nvt 0 0\n"), HasSubstr("line 5: the corner '1' of a face"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 0\nf 1/1 2/1 3//1\n"), HasSubstr("line 6"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 0\nf 1/1 2/1 3/2\n"), HasSubstr("line 6: a face names"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 0\nf 1/1 2/1 3/0\n"), HasSubstr("coordinates 0"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 0\nf 1/-2 2/1 3/1\n"), HasSubstr("coordinates -2"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0 nan\nf 1/1 2/1 3/1\n"), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal_of("a.obj", kSquareCorners + "vt 0\nf 1/1 2/1 3/1\n"), HasSubstr("texture coordinate"));
  EXPECT_THAT(refusal_of("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), HasSubstr(".obj files only"));
}

TEST(TextureCoordinates, NoneAtAllAreToldOf) {
  EXPECT_THAT(refusal_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("a.obj: has no texture coordinates (vt)"));
}

}  // namespace
}  // namespace swage::test
