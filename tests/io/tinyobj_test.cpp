// Against tinyobjloader: what two readers agree on.
#include <gtest/gtest.h>

#include <tiny_obj_loader.h>

#include <set>

#include "places.h"
#include "samples.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

void expect_same(const std::filesystem::path& path) {
  SCOPED_TRACE(path.string());
  tinyobj::ObjReaderConfig config;
  config.triangulate = false;
  tinyobj::ObjReader other;
  ASSERT_TRUE(other.ParseFromFile(path.string(), config)) << other.Error();
  const auto& attributes = other.GetAttrib();
  const MeshFile file = read_mesh(path);
  ASSERT_EQ(static_cast<size_t>(file.mesh.positions.size()), attributes.vertices.size());
  for (size_t k = 0; k < attributes.vertices.size(); ++k) {
    // Its own conversion of decimals is a few units in the last place off.
    const double ours = file.mesh.positions.data()[k];
    EXPECT_NEAR(ours, attributes.vertices[k], 1e-14 * std::max(1., std::abs(ours)));
  }
  std::vector<std::vector<int>> polygons;
  for (const auto& shape : other.GetShapes()) {
    size_t corner = 0;
    for (const size_t count : shape.mesh.num_face_vertices) {
      polygons.emplace_back();
      for (size_t k = 0; k < count; ++k) polygons.back().push_back(shape.mesh.indices[corner++].vertex_index);
    }
  }
  EXPECT_EQ(file.polygons, polygons);
}

TEST(TinyObj, AgreesOnGeneratedFiles) {
  const TempFolder folder;
  const std::string corners[] = {"", "/1", "//1", "/1/1"};
  for (const std::string& tail : corners) {
    std::string text = "vt 0 0\nvn 0 0 1\n";
    const Positions positions = moved_pyramid();
    for (int v = 0; v < 5; ++v) {
      text +=
          "v " + decimal(positions(v, 0)) + "\t" + decimal(positions(v, 1)) + "  " + decimal(positions(v, 2)) + "\r\n";
      if (v >= 2) text += "f -1" + tail + " -2" + tail + " " + std::to_string(v - 1) + tail + "\n";
    }
    text += "g all\nf 1" + tail + " 2" + tail + " 3" + tail + " 4" + tail + "\n# end";
    write_text(folder / "a.obj", text);
    expect_same(folder / "a.obj");
  }
}

// It counts a face's corners in a byte, and refuses corners such as 1// and 1/1/.
const std::set<std::string> kBeyondIt = {"box_longline.obj", "polygonfaces.obj", "jacked.obj"};

TEST(TinyObj, AgreesOnRealMeshes) {
  if (!has_shared()) GTEST_SKIP() << "no real meshes beside this checkout";
  int compared = 0;
  for (const char* name : {"A_closed_manifold", "C_multi_component", "D_non_manifold", "E_bad_shape"}) {
    for (const auto& entry : std::filesystem::directory_iterator(shared("data/meshes") / name)) {
      if (entry.path().extension() != ".obj" || kBeyondIt.contains(entry.path().filename())) continue;
      expect_same(entry.path());
      ++compared;
    }
  }
  EXPECT_GT(compared, 50);
}

}  // namespace
}  // namespace swage::test
