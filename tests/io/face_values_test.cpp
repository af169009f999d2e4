// Numbers of triangles, as PLY properties.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "places.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

TEST(FaceValues, StandBehindEachTrianglesCorners) {
  const TempFolder folder;
  const Mesh mesh = sheet(1);
  const Eigen::Vector2d turns(0.5, std::numeric_limits<double>::quiet_NaN()), sizes(3, 4);
  write_face_values(folder / "faces.ply", mesh, {{"turn", turns}, {"size", sizes}});
  const std::string bytes = read_text(folder / "faces.ply");
  EXPECT_NE(bytes.find("int vertex_indices\nproperty double turn\nproperty double size\nend_header\n"),
            std::string::npos);
  constexpr size_t kFaceBytes = 1 + 3 * 4 + 2 * 8;  // Bytes.
  const auto number = [&](size_t face, size_t k) {
    double value = 0;
    std::memcpy(&value, bytes.data() + bytes.size() - (2 - face) * kFaceBytes + 13 + 8 * k, sizeof value);
    return value;
  };
  EXPECT_EQ(number(0, 0), 0.5);
  EXPECT_EQ(number(0, 1), 3);
  EXPECT_TRUE(std::isnan(number(1, 0)));
  EXPECT_EQ(number(1, 1), 4);
  const Mesh again = read_mesh(folder / "faces.ply").mesh;
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.positions, mesh.positions);
}

TEST(FaceValues, AreNamedAndAsManyAsTriangles) {
  const TempFolder folder;
  EXPECT_THROW(write_face_values(folder / "faces.ply", sheet(1), {{"turn", Eigen::Vector3d(1, 2, 3)}}), InvalidInput);
  for (const char* name : {"", "a b", "x\nend_header"}) {
    EXPECT_THROW(write_face_values(folder / "faces.ply", sheet(1), {{name, Eigen::Vector2d(1, 2)}}), InvalidInput);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "faces.ply"));
}

}  // namespace
}  // namespace swage::test
