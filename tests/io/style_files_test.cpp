// Normals and captures from PLY files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "places.h"
#include "samples.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/style_io.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 1 2 3\n";

/// The square as a PLY with these lines of vertices and faces, and properties behind the usual ones.
std::string ply(const std::vector<std::string>& vertices, const std::string& vertex_properties,
                const std::vector<std::string>& faces, const std::string& face_properties) {
  std::ostringstream out;
  out << "ply\nformat ascii 1.0\nelement vertex " << vertices.size()
      << "\nproperty float x\nproperty float y\nproperty float z\n"
      << vertex_properties << "element face " << faces.size() << "\nproperty list uchar int vertex_indices\n"
      << face_properties << "end_header\n";
  for (const std::string& line : vertices) out << line << '\n';
  for (const std::string& line : faces) out << line << '\n';
  return out.str();
}

const std::string kNormal = "property float nx\nproperty float ny\nproperty double nz\n";
const std::vector<std::string> kCorners{"0 0 0", "1 0 0", "1 1 0", "0 1 0"};
const std::vector<std::string> kFaceRows{"4 0 1 2 3", "3 0 1 2"};

class StyleFiles : public testing::Test {
 protected:
  GivenNormals read(const std::string& bytes, const std::string& name = "normals.ply") const {
    write_text(folder_ / name, bytes);
    return read_given_normals(folder_ / name, square_);
  }

  template <typename Error>
  void expect_refused(const std::string& bytes, const std::string& words, const std::string& name = "normals.ply") {
    try {
      read(bytes, name);
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Error& refused) {
      EXPECT_THAT(refused.what(), HasSubstr(words));
      EXPECT_THAT(refused.what(), HasSubstr(name));
    }
  }

  TempFolder folder_;
  MeshFile square_ = read_bytes("a.obj", kSquare);
};

TEST_F(StyleFiles, NormalsOfVertices) {
  const GivenNormals normals = read(ply({"0 0 0 1 9 0 0", "1 0 0 1 0 1 0", "1 1 0 1 0 0 1.5", "0 1 0 1 0 0 0"},
                                        "property uchar red\n" + kNormal, kFaceRows, ""));
  EXPECT_FALSE(normals.of_triangles);
  EXPECT_EQ(normals.normals, (Positions{{9, 0, 0}, {0, 1, 0}, {0, 0, 1.5}, {0, 0, 0}}));
}

TEST_F(StyleFiles, NormalsOfFacesAreTheirTriangles) {
  const GivenNormals normals = read(ply(kCorners, "", {"4 0 1 2 3 1 0 0", "2 0 1 5 5 5", "3 0 1 2 0 1 0"}, kNormal));
  EXPECT_TRUE(normals.of_triangles);
  EXPECT_EQ(normals.normals, (Positions{{1, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(StyleFiles, NormalsAreReadAsWritten) {
  const Mesh mesh = sheet(1);
  const Eigen::Vector2d x(1, 0), y(0, -1), z(0, 0.5);
  write_face_values(folder_ / "binary.ply", mesh, {{"nx", x}, {"other", x}, {"ny", y}, {"nz", z}});
  const MeshFile file = read_mesh(folder_ / "binary.ply");
  EXPECT_EQ(read_given_normals(folder_ / "binary.ply", file).normals, (Positions{{1, 0, 0}, {0, -1, 0.5}}));
}

TEST_F(StyleFiles, NormalsThatDoNotFitAreRefused) {
  const std::string none = ply(kCorners, "", kFaceRows, "");
  expect_refused<UnreadableFile>(none, "neither its vertices nor its faces");
  expect_refused<UnreadableFile>(
      ply({"0 0 0 1 0 0", "1 0 0 nan 0 0", "1 1 0 0 0 1", "0 1 0 0 0 1"}, kNormal, kFaceRows, ""),
      "vertex 1 is not finite");
  expect_refused<InvalidInput>(ply({"0 0 0 1 0 0", "1 0 0 1 0 0", "1 1 0 0 0 1"}, kNormal, {"3 0 1 2"}, ""),
                               "3 vertices, but the mesh has 4");
  expect_refused<InvalidInput>(ply(kCorners, "", {"3 0 1 2 1 0 0"}, kNormal), "1 faces, but the mesh has 2");
  expect_refused<InvalidInput>(kSquare, ".ply files", "normals.obj");
  expect_refused<UnreadableFile>("OFF\n", "not a PLY file");
  expect_refused<UnreadableFile>(ply({"0 0 0 1 0"}, kNormal, {}, ""), "line ");
}

/// A sphere with normals of its vertices, `turn` of their directions.
std::string painted_sphere(int subdivisions, const std::function<Eigen::RowVector3d(Eigen::RowVector3d)>& turn) {
  const Mesh ball = sphere(1, subdivisions);
  std::vector<std::string> vertices, faces;
  for (const auto& p : ball.positions.rowwise()) {
    std::ostringstream line;
    line << p << ' ' << turn(p);
    vertices.push_back(line.str());
  }
  for (const auto& t : ball.triangles.rowwise()) {
    std::ostringstream line;
    line << "3 " << t;
    faces.push_back(line.str());
  }
  return ply(vertices, kNormal, faces, "");
}

TEST_F(StyleFiles, ACaptureIsAPaintedSphere) {
  write_text(folder_ / "ball.ply", painted_sphere(2, [](const auto& p) { return -2 * p; }));
  const SphereMap map = read_normal_capture(folder_ / "ball.ply");
  EXPECT_FALSE(map.nearest);
  EXPECT_LT((map.normals + map.directions).rowwise().norm().maxCoeff(), 1e-4);
  EXPECT_EQ(map.triangles, sphere(1, 2).triangles);
}

TEST_F(StyleFiles, OtherCapturesAreRefusedByName) {
  const auto refused = [&](const std::string& name, const std::string& bytes) -> std::string {
    write_text(folder_ / name, bytes);
    try {
      read_normal_capture(folder_ / name);
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_THAT(refused("square.ply", ply(kCorners, "", kFaceRows, "")),
              HasSubstr("square.ply: its vertices have no norm"));
  EXPECT_THAT(refused("blank.ply", painted_sphere(1, [](const auto& p) { return 0 * p; })),
              HasSubstr("blank.ply: normal_capture: 100 % of the sphere"));
  EXPECT_THAT(refused("ball.obj", kSquare), HasSubstr(".png, or a sphere"));
}

}  // namespace
}  // namespace swage::test
