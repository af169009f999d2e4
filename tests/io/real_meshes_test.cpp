// The real meshes: well-formed ones come back byte for byte, malformed ones are refused in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "mesh_index.h"
#include "places.h"
#include "samples.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using testing::HasSubstr;

TEST(RealMeshes, AreReadAsListedAndComeBackByteForByte) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  int read = 0;
  for (const ListedMesh& listed : listed_meshes()) {
    SCOPED_TRACE(listed.name);
    const MeshFile file = read_mesh(listed.path);
    EXPECT_EQ(file.mesh.positions.rows(), listed.number("verts"));
    // Listed with triangles that repeat a vertex, each of which is told of here.
    EXPECT_LE(file.mesh.triangles.rows(), listed.number("tris"));
    if (file.warnings.empty() || listed.letter() == 'A') {
      EXPECT_EQ(file.mesh.triangles.rows(), listed.number("tris"));
    }
    EXPECT_TRUE(written(file, file.mesh.positions) == read_text(listed.path));
    ++read;
  }
  EXPECT_GT(read, 150);
}

TEST(RealMeshes, MovedAreReadAgainExactly) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  for (const char* name :
       {"A_closed_manifold/phone.obj", "A_closed_manifold/quadknot.obj", "A_closed_manifold/cactus.off",
        "E_bad_shape/colored_tetra.ply", "C_multi_component/triangle_with_two_solids.stl"}) {
    const MeshFile file = read_mesh(shared("data/meshes") / name);
    const Positions moved = file.mesh.positions * 1.1;
    const MeshFile again = read_bytes(std::filesystem::path(name).filename(), written(file, moved));
    EXPECT_EQ(again.mesh.positions, moved) << name;
    EXPECT_EQ(again.polygons, file.polygons) << name;
  }
}

// What each malformed file is refused for.
const std::map<std::string, std::string> kRefused = {
    {"assimp_OutOfMemory.off", "line 2: 353535235358 vertices are promised"},
    {"assimp_empty.off", "is empty"},
    {"assimp_empty0.obj", "is empty"},
    {"assimp_invalid.off", "line 7"},
    {"assimp_malformed.obj", "line 28: a face names vertex 0"},
    {"assimp_point_cloud.obj", "has 3 vertices and no triangles"},
    {"assimp_testline.obj", "has 8 vertices and no triangles"},
    {"box_UTF16BE.obj", "UTF-16"},
    {"fairing-cross.off", "binary OFF"},
    {"invalidvertex.stl", "line 89: a coordinate is expected, not 'blah'"},
    {"number_formats.obj", "line 11: a coordinate"},
    {"obj_points.obj", "no triangles"},
    {"obj_wireframe.obj", "no triangles"},
    {"openscad_empty.stl", "is empty"},
    {"pipe_huge_1e300.obj", "line 4: a coordinate is beyond 1e12"},
    {"pipe_index_eq_nverts.off", "a face names vertex 160"},
    {"pipe_nan.off", "line 11: a coordinate is not a finite number"},
    {"pipe_negative_index.off", "a face names vertex -1"},
    {"pipe_truncated.off", "truncated"},
    {"pipe_truncated_binary.stl", "truncated"},
    {"ply_empty_bin.ply", "has 0 vertices and no triangles"},
    {"points_emptyface.ply", "has 1024 vertices and no triangles"},
    {"random_bytes.obj", "not a text file"},
    {"stl_empty_bin.stl", "no triangles"},
    {"trimesh_empty.obj", "no triangles"},
    {"trimesh_empty.ply", "no triangles"},
    {"unparseable.stl", "line 4: a coordinate is expected"}};
// And what each of the others is read with.
const std::map<std::string, std::string> kWarned = {
    {"notenoughindices.obj", "line 9: a face of fewer than three vertices is skipped"},
    {"pipe_two_vertex_face.obj", "a face of fewer than three vertices is skipped"}};

TEST(RealMeshes, MalformedAreRefusedOrReadWithAWarning) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  size_t seen = 0;
  for (const auto& entry : std::filesystem::directory_iterator(shared("data/meshes/X_malformed"))) {
    const std::string name = entry.path().filename();
    SCOPED_TRACE(name);
    ++seen;
    if (const auto warned = kWarned.find(name); warned != kWarned.end()) {
      const MeshFile file = read_mesh(entry.path());
      ASSERT_EQ(file.warnings.size(), 1u);
      EXPECT_THAT(file.warnings[0], HasSubstr(warned->second));
      continue;
    }
    ASSERT_TRUE(kRefused.contains(name)) << "nobody said what to expect of this file";
    EXPECT_THAT(refusal(name, read_text(entry.path())), HasSubstr(kRefused.at(name)));
  }
  EXPECT_EQ(seen, kRefused.size() + kWarned.size());
}

}  // namespace
}  // namespace swage::test
