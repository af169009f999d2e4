// A file written back is the file read, but for the numbers that changed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "places.h"
#include "samples.h"
#include "shapes.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

Positions as_read(const Sample& sample, const Positions& positions) {
  return sample.is_single ? Positions(positions.cast<float>().cast<double>()) : positions;
}

TEST(RoundTrip, ReadsThePositionsThatStandThere) {
  for (const Sample& sample : samples()) {
    SCOPED_TRACE(sample.name);
    for (const Positions& positions : {pyramid(), moved_pyramid()}) {
      const MeshFile file = read_bytes(sample.name, sample.bytes(positions));
      EXPECT_EQ(file.mesh.positions, as_read(sample, positions));
      EXPECT_EQ(file.mesh.triangles.rows(), 6);
      EXPECT_EQ(file.polygons.size(), format_of(sample.name) == MeshFormat::stl ? 6u : 5u);
      EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
    }
  }
}

TEST(RoundTrip, UnmovedGivesTheSameBytes) {
  for (const Sample& sample : samples()) {
    const std::string bytes = sample.bytes(moved_pyramid());
    const MeshFile file = read_bytes(sample.name, bytes);
    EXPECT_EQ(written(file, file.mesh.positions), bytes) << sample.name;
  }
}

TEST(RoundTrip, MovedGivesTheBytesOfTheMovedMesh) {
  for (const Sample& sample : samples()) {
    const MeshFile file = read_bytes(sample.name, sample.bytes(pyramid()));
    const std::string bytes = written(file, moved_pyramid());
    const MeshFile again = read_bytes(sample.name, bytes);
    EXPECT_EQ(again.mesh.positions, as_read(sample, moved_pyramid())) << sample.name;
    if (format_of(sample.name) == MeshFormat::stl) continue;  // Its normals change too.
    EXPECT_EQ(bytes, sample.bytes(moved_pyramid())) << sample.name;
  }
}

TEST(RoundTrip, OnlyTheMovedVertexChanges) {
  const std::string text = "v 0.000 -0 +1.50e0\nv 1 0 0\nv 0 1.00 0\nf 1 2 3\n";
  const MeshFile file = read_bytes("a.obj", text);
  Positions positions = file.mesh.positions;
  positions(1, 0) = 0.1;
  EXPECT_EQ(written(file, positions), "v 0.000 -0 +1.50e0\nv 0.1 0 0\nv 0 1.00 0\nf 1 2 3\n");
}

TEST(RoundTrip, MovedAgainstTheFileThoughTheMeshWasEdited) {
  MeshFile file = read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  file.mesh.positions(0, 2) = 5;
  EXPECT_EQ(written(file, file.mesh.positions), "v 0 0 5\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
}

TEST(RoundTrip, StlWeldsCornersAndWritesAllOfThem) {
  const MeshFile file = read_bytes("a.stl",
                                   "solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 0 vertex 1 0 0 vertex 0 1 0\n"
                                   "endloop endfacet\nfacet normal 0 0 1 outer loop\nvertex 1 0 0 vertex 1 1 0 "
                                   "vertex -0 1.0 0\nendloop endfacet\nendsolid\n");
  ASSERT_EQ(file.mesh.positions.rows(), 4);
  EXPECT_EQ(file.mesh.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
  Positions positions = file.mesh.positions;
  positions(2, 1) = 3;
  EXPECT_EQ(written(file, positions),
            "solid\nfacet normal 0 0 1 outer loop\nvertex 0 0 0 vertex 1 0 0 vertex 0 3 0\n"
            "endloop endfacet\nfacet normal 0 0 1 outer loop\nvertex 1 0 0 vertex 1 1 0 "
            "vertex -0 3 0\nendloop endfacet\nendsolid\n");
}

TEST(RoundTrip, OtherFormatsKeepPolygonsAndPositions) {
  const TempFolder folder;
  for (const Sample& sample : samples()) {
    const MeshFile file = read_bytes(sample.name, sample.bytes(pyramid()));
    for (const char* name : {"out.obj", "out.ply", "out.off", "out.stl"}) {
      SCOPED_TRACE(sample.name + " to " + name);
      if (format_of(name) == format_of(sample.name)) continue;
      write_mesh(folder / name, file, moved_pyramid());
      const MeshFile out = read_mesh(folder / name);
      EXPECT_TRUE(out.warnings.empty());
      if (format_of(name) == MeshFormat::stl) {
        EXPECT_EQ(out.mesh.triangles.rows(), 6);
        for (int t = 0; t < 6; ++t) {
          for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3f expected = moved_pyramid().row(file.mesh.triangles(t, k)).cast<float>();
            EXPECT_EQ(out.mesh.positions.row(out.mesh.triangles(t, k)), expected.cast<double>());
          }
        }
      } else {
        EXPECT_EQ(out.mesh.positions, moved_pyramid());
        EXPECT_EQ(out.polygons, file.polygons);
      }
    }
  }
}

TEST(RoundTrip, WritesAMeshFromNoFile) {
  const TempFolder folder;
  const Mesh ball = sphere(1, 2);
  for (const char* name : {"out.obj", "out.ply", "out.off"}) {
    write_mesh(folder / name, ball);
    const MeshFile out = read_mesh(folder / name);
    EXPECT_EQ(out.mesh.positions, ball.positions);
    EXPECT_EQ(out.mesh.triangles, ball.triangles);
  }
  write_mesh(folder / "out.stl", ball);
  EXPECT_EQ(read_mesh(folder / "out.stl").mesh.positions.rows(), ball.positions.rows());
}

TEST(RoundTrip, LongPolygonsFitIntoPly) {
  std::string text, face = "f";
  for (int k = 0; k < 300; ++k) {
    text += "v " + decimal(std::cos(k * 0.0209)) + " " + decimal(std::sin(k * 0.0209)) + " 0\n";
    face.append(" ").append(std::to_string(k + 1));
  }
  const MeshFile file = read_bytes("a.obj", text + face + "\n");
  const TempFolder folder;
  write_mesh(folder / "out.ply", file, file.mesh.positions);
  EXPECT_EQ(read_mesh(folder / "out.ply").polygons, file.polygons);
}

TEST(RoundTrip, RefusesPositionsThatDoNotFit) {
  MeshFile file = read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::ostringstream out;
  Positions positions = Positions::Zero(4, 3);
  EXPECT_THROW(write_mesh(out, MeshFormat::obj, file, positions), InvalidInput);
  positions = file.mesh.positions;
  positions(1, 1) = std::nan("");
  EXPECT_THROW(write_mesh(out, MeshFormat::obj, file, positions), InvalidInput);
  file.polygons[0][1] = 3;
  EXPECT_THROW(write_mesh(out, MeshFormat::obj, file, file.mesh.positions), InvalidInput);
  file.polygons.clear();
  EXPECT_THROW(write_mesh(out, MeshFormat::obj, file, file.mesh.positions), InvalidInput);
  EXPECT_EQ(out.str(), "");
}

TEST(RoundTrip, TellsOfAStreamThatFails) {
  const MeshFile file = read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_THROW(write_mesh(out, MeshFormat::obj, file, file.mesh.positions), UnwritableFile);
}

TEST(Format, IsToldByTheExtensionInAnyCase) {
  EXPECT_EQ(format_of("a/b.x.ObJ"), MeshFormat::obj);
  EXPECT_EQ(format_of("b.PLY"), MeshFormat::ply);
  EXPECT_EQ(format_of("b.Stl"), MeshFormat::stl);
  EXPECT_EQ(format_of("b.off"), MeshFormat::off);
  for (const char* name : {"b.glb", "obj", "b", "b.obj.gz", ""}) EXPECT_THROW(format_of(name), InvalidInput) << name;
}

TEST(Obj, GroupsHoldTheVerticesOfTheirFaces) {
  const MeshFile file = read_bytes("rich.obj", samples()[0].bytes(pyramid()));
  const std::map<std::string, std::vector<int>> expected = {{"The Thing", {0, 1, 2, 3, 4}},
                                                            {"base", {0, 1, 2, 3}},
                                                            {"lower", {0, 1, 2, 3}},
                                                            {"sides", {0, 1, 2, 4}},
                                                            {"default", {0, 2, 3, 4}}};
  EXPECT_EQ(file.groups, expected);
}

TEST(Obj, FacesMayPrecedeTheirVertices) {
  const MeshFile file = read_bytes("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(file.mesh.triangles.rows(), 1);
}

TEST(Numbers, AreReadInEveryNotation) {
  const MeshFile file =
      read_bytes("a.obj", "v +1. .5 -1.E+2\nv 1e-400 -0e0 0.0000001e7\nv 4.9e-324 123456789012 3\nf 1 2 3");
  Positions expected(3, 3);
  expected << 1, 0.5, -100, 0, 0, 1, 4.9e-324, 123456789012., 3;
  EXPECT_EQ(file.mesh.positions, expected);
}

TEST(Warnings, TellSkippedFacesWithTheirLines) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\nf 1 2 3\nf 2\nf 1 1 2\nf 3 2\nf 1 3\nf 3\n";
  const MeshFile file = read_bytes("a.obj", text);
  EXPECT_EQ(file.polygons.size(), 2u);
  EXPECT_EQ(file.mesh.triangles.rows(), 1);
  ASSERT_EQ(file.warnings.size(), 5u);
  EXPECT_THAT(file.warnings[0], HasSubstr("line 4"));
  EXPECT_THAT(file.warnings[1], HasSubstr("line 6"));
  EXPECT_THAT(file.warnings[2], HasSubstr("line 8"));
  EXPECT_THAT(file.warnings[3], HasSubstr("2 more"));
  EXPECT_THAT(file.warnings[4], HasSubstr("line 7"));
  EXPECT_EQ(written(file, file.mesh.positions), text);
}

}  // namespace
}  // namespace swage::test
