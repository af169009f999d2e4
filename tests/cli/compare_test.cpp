// `swage compare` on edits made for it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "program.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class CompareProgram : public testing::Test {
 protected:
  CompareProgram() : mesh_(cylinder(0.5, 1, 48, 8)) {
    Mesh edit = mesh_;
    write_mesh(rest_, mesh_);
    edit.positions.col(1) *= 2;
    write_mesh(longer_, edit);
    edit.positions.col(0) *= 1.5;
    write_mesh(flat_, edit);
  }

  TempFolder folder_;
  Mesh mesh_;
  std::string rest_ = folder_ / "rest.obj", longer_ = folder_ / "longer.ply", flat_ = folder_ / "flat.off";
};

TEST_F(CompareProgram, MeasuresEachEdit) {
  const Outcome outcome = run({"compare", rest_, longer_, flat_, "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json told = json::parse(outcome.out);
  EXPECT_EQ(told["command"], "compare");
  EXPECT_EQ(told["input"], rest_);
  EXPECT_EQ(told["vertices"], mesh_.positions.rows());
  ASSERT_EQ(told["edits"].size(), 2U);
  const json &longer = told["edits"][0], &flat = told["edits"][1];
  EXPECT_EQ(longer["input"], longer_);
  EXPECT_NEAR(longer["normal_error_deg"]["max"].get<double>(), 0, 1e-6);
  EXPECT_NEAR(longer["non_uniform_scale"]["max"].get<double>(), std::log(2), 1e-9);
  EXPECT_NEAR(longer["volume_ratio"].get<double>(), 2, 1e-9);
  EXPECT_NEAR(longer["out_of_round"].get<double>(), 0, 1e-9);
  EXPECT_EQ(longer["round_parts"].size(), 1U);
  EXPECT_TRUE(longer["handle_error"].is_null());
  EXPECT_GT(flat["normal_error_deg"]["mean"].get<double>(), 1);
  EXPECT_GT(flat["out_of_round"].get<double>(), 0.1);
  EXPECT_EQ(flat["flipped_triangles"], 0);
  EXPECT_EQ(flat["new_self_intersections"], 0);
}

TEST_F(CompareProgram, PrintsALineAnEdit) {
  const Outcome outcome = run({"compare", rest_, longer_, flat_, "--move", "y>=100%=0,1,0"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("slippage"));
  EXPECT_THAT(outcome.out, HasSubstr(longer_));
  EXPECT_THAT(outcome.out, HasSubstr(flat_));
}

TEST_F(CompareProgram, KnowsHowFarHandlesAreOff) {
  const Outcome outcome = run({"compare", rest_, longer_, "--pin", "y<=0%", "--move", "y>=100%=0,1,0", "--json", "-"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NEAR(json::parse(outcome.out)["edits"][0]["handle_error"].get<double>(), 0, 1e-9);
}

TEST_F(CompareProgram, WritesTheNumbersOfTriangles) {
  const std::string faces = folder_ / "faces.ply";
  const Outcome outcome = run({"compare", rest_, flat_, "--faces", faces});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(read_text(faces), HasSubstr("property double slippage_loss\n"));
  const MeshFile written = read_mesh(faces);
  EXPECT_EQ(written.mesh.triangles, mesh_.triangles);
  EXPECT_EQ(written.mesh.positions, read_mesh(flat_).mesh.positions);
}

TEST_F(CompareProgram, RefusesOtherMeshes) {
  write_mesh(folder_ / "other.obj", box());
  const Outcome other = run({"compare", rest_, folder_ / "other.obj"});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("other.obj: it has"));
  EXPECT_EQ(run({"compare", rest_}).code, 2);
  EXPECT_EQ(run({"compare", rest_, longer_, flat_, "--faces", folder_ / "faces.ply"}).code, 2);
  EXPECT_EQ(run({"compare", rest_, longer_, "--faces", folder_ / "faces.obj"}).code, 2);
  EXPECT_EQ(run({"compare", rest_, longer_, "--straight", "none", "--straight-angle", "30"}).code, 2);
}

}  // namespace
}  // namespace swage::test
