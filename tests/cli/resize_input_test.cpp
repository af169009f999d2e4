// `swage resize` on models that are no clean surface.
#include <gmock/gmock.h>

#include "resizing.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using nlohmann::json;
using testing::HasSubstr;

class ResizingAny : public Resizing {
 protected:
  /// The box is the one asked for, and nothing but positions changed.
  void expect_resized(const std::string& mesh, const Vector3d& factors) const {
    const std::string scale =
        std::to_string(factors[0]) + "," + std::to_string(factors[1]) + "," + std::to_string(factors[2]);
    const Mesh rest = read_mesh(mesh).mesh, resized = mesh_of({"--scale", scale}, mesh);
    ASSERT_EQ(resized.positions.rows(), rest.positions.rows());
    EXPECT_EQ(resized.triangles, rest.triangles);
    EXPECT_TRUE(resized.positions.allFinite());
    const AlignedBox3d before = box_of(rest.positions), after = box_of(resized.positions);
    EXPECT_LT((after.sizes() - before.sizes().cwiseProduct(factors)).norm(), 1e-6 * before.sizes().norm()) << scale;
  }
};

TEST_F(ResizingAny, NonManifoldWithALoneVertex) {
  write_mesh(file("awkward.obj"), awkward());
  expect_resized(file("awkward.obj"), {2, 1, 0.5});
  expect_resized(file("awkward.obj"), {0.1, 8, 1});
}

TEST_F(ResizingAny, ALoneVertexIsCarried) {
  write_text(file("lone.obj"), read_text(model_) + "v 2 3 0.5\n");
  expect_resized(file("lone.obj"), {2, 1.5, 1});
  const Positions positions = mesh_of({"--scale", "1,2,1"}, file("lone.obj")).positions;
  EXPECT_NEAR(positions(positions.rows() - 1, 1), 6, 1e-6) << "it stood at the top of the box";
  const Outcome outcome = resize({"--scale", "2,1,1", "--protect", "component:2", "-o", "-"}, file("lone.obj"));
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("--protect component:2: no triangle of"));
}

TEST_F(ResizingAny, ASoupOfStlStaysTogether) {
  write_mesh(file("soup.stl"), read_mesh(model_).mesh);
  expect_resized(file("soup.stl"), {2, 1, 1});
  const Mesh soup = mesh_of({"--scale", "2,1,1"}, file("soup.stl"));
  EXPECT_EQ(soup.positions.rows(), 259) << "corners are still at one place, and so is where the ball touches the bar";
}

TEST_F(ResizingAny, FarFromTheOriginAndOfAnySize) {
  for (const double size : {1e-6, 1e6}) {
    write_mesh(file("far.obj"), transformed(read_mesh(model_).mesh, size, size * Vector3d(3e5, -7e5, 1e5)));
    expect_resized(file("far.obj"), {2, 1, 0.5});
  }
}

TEST_F(ResizingAny, AFlatModelIsResizedInItsPlane) {
  write_mesh(file("sheet.obj"), sheet(6));
  const Positions positions = mesh_of({"--scale", "2,0.5,1"}, file("sheet.obj")).positions;
  EXPECT_LT((box_of(positions).sizes() - Vector3d(2, 0.5, 0)).norm(), 1e-9);
  EXPECT_TRUE(result({"--size", "2,0.5,-"}, file("sheet.obj")) == result({"--scale", "2,0.5,1"}, file("sheet.obj")));
  const Outcome outcome =
      run({"resize", file("sheet.obj"), "--grid", "20", "--scale", "2,0.5,3", "-o", file("flat.obj"), "--json", "-"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no extent along z: the factor there changes nothing"));
  EXPECT_TRUE(read_text(file("flat.obj")) == result({"--scale", "2,0.5,1"}, file("sheet.obj")));
  const json told = json::parse(outcome.out);
  EXPECT_EQ(told["factors"], (json{2, 0.5, 1}));
  EXPECT_EQ(told["cells"], (json{20, 20, 1}));
}

TEST_F(ResizingAny, AFlatModelHasNoOtherSizeAcross) {
  write_mesh(file("sheet.obj"), sheet(6));
  for (const char* size : {"2,1,1", "-,-,1e-9"}) {
    const Outcome outcome = resize({"--size", size, "-o", file("flat.obj")}, file("sheet.obj"));
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("sheet.obj: --size " + std::string(size) + ": along z the model has no extent"));
  }
  EXPECT_FALSE(std::filesystem::exists(file("flat.obj")));
}

}  // namespace
}  // namespace swage::test
