// Normals turn with the surface.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstring>
#include <sstream>

#include "samples.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

// Two triangles, one in the plane z = 0 and one in x = 0; the second normal is shared by both.
const std::string kShaded =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0.0 1.0\nvn 0.6 0 0.8\nvn 1 0 0\n"
    "f 1//1 2//1 3//2\nf 1//3 3//2 4//-1\n";

Positions turned(const Positions& positions, const Eigen::Matrix3d& turn) { return positions * turn.transpose(); }

std::vector<Eigen::Vector3d> normals_of(const std::string& obj) {
  std::vector<Eigen::Vector3d> normals;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("vn ")) continue;
    std::istringstream numbers(line.substr(3));
    Eigen::Vector3d n;
    numbers >> n.x() >> n.y() >> n.z();
    normals.push_back(n);
  }
  return normals;
}

TEST(Normals, TurnWithTheMesh) {
  const MeshFile file = read_bytes("a.obj", kShaded);
  // About the mean normal of each set of users the minimal rotation is the whole one.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitY()).matrix();
  const auto normals = normals_of(written(file, turned(file.mesh.positions, turn)));
  ASSERT_EQ(normals.size(), 3u);
  EXPECT_LT((normals[0] - turn * Eigen::Vector3d(0, 0, 1)).norm(), 1e-12);
  EXPECT_LT((normals[1] - turn * Eigen::Vector3d(0.6, 0, 0.8)).norm(), 1e-12);
  EXPECT_LT((normals[2] - turn * Eigen::Vector3d(1, 0, 0)).norm(), 1e-12);
}

TEST(Normals, TurnByTheMinimalRotationOfTheirOwnFaces) {
  const MeshFile file = read_bytes("a.obj", kShaded);
  Positions positions = file.mesh.positions;
  positions.row(1) << 1, 0, 1;  // Tilts the first triangle alone by 45 degrees about y.
  const auto normals = normals_of(written(file, positions));
  EXPECT_LT((normals[0] - Eigen::Vector3d(-std::sqrt(0.5), 0, std::sqrt(0.5))).norm(), 1e-12);
  EXPECT_EQ(normals[2], Eigen::Vector3d(1, 0, 0));
  // Users' area vectors: (0, 0, 1) + (1, 0, 0) become (-1, 0, 1) + (1, 0, 0): a turn by 45 degrees.
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-M_PI / 4, Eigen::Vector3d::UnitY()).matrix();
  EXPECT_LT((normals[1] - turn * Eigen::Vector3d(0.6, 0, 0.8)).norm(), 1e-12);
}

TEST(Normals, KeepTheirBytesWhereTheSurfaceOnlySlides) {
  const MeshFile file = read_bytes("a.obj", kShaded);
  const Positions positions = (file.mesh.positions * 1.7).rowwise() + Eigen::RowVector3d(0.1, 0.2, 0.3);
  const std::string text = written(file, positions);
  EXPECT_NE(text.find("vn 0 0.0 1.0\nvn 0.6 0 0.8\nvn 1 0 0\n"), std::string::npos) << text;
}

TEST(Normals, StayWhereTheyCannotFollow) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn nan nan nan\nvn 0 1 0\nf 1//1 2//2 3//9\n";
  const MeshFile file = read_bytes("a.obj", text);
  ASSERT_EQ(file.warnings.size(), 1u);
  EXPECT_NE(file.warnings[0].find("line 7"), std::string::npos);
  Positions flat = file.mesh.positions;
  flat.row(2) << 2, 0, 0;  // No area left.
  EXPECT_EQ(written(file, flat), "v 0 0 0\nv 1 0 0\nv 2 0 0\nvn 0 0 1\nvn nan nan nan\nvn 0 1 0\nf 1//1 2//2 3//9\n");
}

// A triangle turned from +z to +x, with a normal at each vertex.
TEST(Normals, OfVerticesInPlyAndOff) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\n"
      "end_header\n0 0 1 0 0 0\n0 0 1 1 0 0\n0 0 1 0 1 0\n3 0 1 2\n";
  const std::string off = "CNOFF\n3 1 0\n0 0 0 0 0 1 9 9 9 9\n1 0 0 0 0 1 9 9 9 9\n0 1 0 0 0 1 9 9 9 9\n3 0 1 2\n";
  const std::vector<std::pair<std::string, std::string>> files = {{"a.ply", ply}, {"a.off", off}};
  for (const auto& [name, text] : files) {
    const MeshFile file = read_bytes(name, text);
    Positions positions(3, 3);
    positions << 0, 0, 0, 0, 0, -1, 0, 1, 0;
    const std::string bytes = written(file, positions);
    std::istringstream lines(bytes.substr(name == "a.ply" ? bytes.find("end_header\n") + 11 : 12));
    for (int v = 0; v < 3; ++v) {
      double numbers[6];
      for (double& x : numbers) lines >> x;
      const double* n = name == "a.ply" ? numbers : numbers + 3;
      EXPECT_NEAR((Eigen::Vector3d(n[0], n[1], n[2]) - Eigen::Vector3d(1, 0, 0)).norm(), 0, 1e-12) << bytes;
      lines.ignore(100, '\n');
    }
    EXPECT_EQ(read_bytes(name, bytes).mesh.positions, positions);
  }
}

TEST(Normals, OfStlAreThoseOfTheirFacets) {
  const Sample binary = samples().back();
  const MeshFile file = read_bytes(binary.name, binary.bytes(pyramid()));
  const std::string moved = written(file, moved_pyramid()), expected = binary.bytes(moved_pyramid());
  ASSERT_EQ(moved.size(), expected.size());
  for (size_t facet = 84; facet < moved.size(); facet += 50) {
    // Coordinates and attributes to the byte, normals to the rounding of another summation.
    EXPECT_EQ(moved.substr(facet + 12, 38), expected.substr(facet + 12, 38));
    for (size_t k = 0; k < 12; k += 4) {
      float found = 0, wanted = 0;
      std::memcpy(&found, &moved[facet + k], 4);
      std::memcpy(&wanted, &expected[facet + k], 4);
      EXPECT_NEAR(found, wanted, 1e-6);
    }
  }
}

TEST(Normals, OfAsciiStlKeepTheirBytesWhereTheFacetDidNotTurn) {
  const auto solid = [](const char* first, const char* second, const char* moved) {
    return std::string("solid\nfacet normal ") + first +
           " outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop\n" + "endfacet facet normal " + second +
           " outer loop vertex 0 0 0 vertex 0 1 0 vertex " + moved + " endloop endfacet\nendsolid\n";
  };
  const MeshFile file = read_bytes("a.stl", solid("0.00 0 1e0", "1 0 0", "0 0 1"));
  Positions positions = file.mesh.positions;
  positions.row(3) << -2, 0, 0;
  EXPECT_EQ(written(file, positions), solid("0.00 0 1e0", "0 0 1", "-2 0 0"));
}

}  // namespace
}  // namespace swage::test
