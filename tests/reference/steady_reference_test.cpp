// The steady solver beside the authors' results: as good in every measure, whatever the resolution and the stop.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "authors.h"
#include "edit_measures.h"
#include "measures.h"
#include "places.h"
#include "refined.h"
#include "shapes.h"

namespace swage {
namespace {

ReshapeResult solved(const test::AuthorsGesture& authors) {
  return reshape(authors.mesh.positions, authors.mesh.triangles, authors.gesture, authors.options);
}

class SteadyGesture : public testing::TestWithParam<test::AuthorsName> {
 protected:
  void SetUp() override {
    if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
    authors_ = test::authors_gesture(GetParam().model, GetParam().gesture, ReshapeSolver::steady);
  }

  bool is(const std::string& model, const std::string& gesture) const {
    return GetParam().model == model && GetParam().gesture == gesture;
  }

  test::AuthorsGesture authors_;
};

TEST_P(SteadyGesture, IsAsGoodAsThePublishedResult) {
  const Mesh& rest = authors_.mesh;
  const Positions published = unit_box(rest.positions).back(test::authors_result(GetParam().model, GetParam().gesture));

  const ReshapeResult steady = solved(authors_);

  EXPECT_EQ(steady.report.stop, Termination::moved_little);
  const bool phone = is("phone", "def_v1"), lifted = is("cylinder_1kF", "def_v1");
  if (phone) {  // The only one that is finalised. Published, that takes the handles to 2.65 % from 1.05 %.
    const Positions unfinished =
        unit_box(rest.positions).back(test::authors_result("phone", "def_v1", ".unfinished.obj"));
    const double before = test::mean_normal_change(rest, unfinished);
    EXPECT_LT(test::mean_normal_change(rest, steady.unfinished), before + 0.25);
    EXPECT_LT(test::mean_normal_change(rest, steady.positions), before + 0.3);
    EXPECT_LE(test::handle_error(rest, authors_.gesture, steady.positions), 0.01);
  } else {
    EXPECT_LT(test::mean_normal_change(rest, steady.positions), test::mean_normal_change(rest, published) + 0.1);
  }
  EXPECT_LE(test::mean_stretch(rest, steady.positions), test::mean_stretch(rest, published));
  EXPECT_LT(test::handle_error(rest, authors_.gesture, steady.positions),
            std::max(2 * test::handle_error(rest, authors_.gesture, published), 0.005));
  if (lifted) {  // The published radius grows by 7 %.
    const double wide = steady.positions.col(0).maxCoeff() - steady.positions.col(0).minCoeff();
    const double wide_at_rest = rest.positions.col(0).maxCoeff() - rest.positions.col(0).minCoeff();
    EXPECT_NEAR(wide / wide_at_rest, 1, 0.05);
  } else {
    EXPECT_LT(test::deviation(published, steady.positions).mean, 0.01);
  }
}

TEST_P(SteadyGesture, DoesNotDependOnTheStop) {
  const Positions usual = solved(authors_).positions;
  authors_.options.movement /= 10;
  EXPECT_LT(test::deviation(usual, solved(authors_).positions).largest, 1e-3);
}

TEST_P(SteadyGesture, IsReachedByPlainPassesToo) {
  authors_.options.finalise = false;
  authors_.options.pass_limit = 1000;
  authors_.options.movement = 1e-4;
  const ReshapeResult accelerated = solved(authors_);
  authors_.options.acceleration_window = 0;
  const ReshapeResult plain = solved(authors_);
  EXPECT_EQ(plain.report.stop, Termination::moved_little);
  EXPECT_LT(accelerated.report.passes, plain.report.passes);
  RecordProperty("passes", accelerated.report.passes);
  RecordProperty("plain_passes", plain.report.passes);
  EXPECT_LT(test::deviation(plain.positions, accelerated.positions).largest, 1e-3);
}

const auto kNameOf = [](const auto& named) { return test::test_name(named.param.model, named.param.gesture); };

INSTANTIATE_TEST_SUITE_P(Authors, SteadyGesture, testing::ValuesIn(test::authors_names()), kNameOf);

test::AuthorsGesture refined(test::AuthorsGesture authors) {
  const Mesh fine = test::subdivided(authors.mesh);
  authors.options = test::refined(authors.options, authors.mesh.triangles, fine.triangles);
  authors.mesh = fine;
  return authors;
}

void expect_little(const test::Deviation& by_one_subdivision) {
  EXPECT_LT(by_one_subdivision.mean, 0.005);
  EXPECT_LT(by_one_subdivision.largest, 0.015);
  testing::Test::RecordProperty("mean_percent_of_D", std::to_string(100 * by_one_subdivision.mean));
  testing::Test::RecordProperty("largest_percent_of_D", std::to_string(100 * by_one_subdivision.largest));
}

using SteadyRefined = SteadyGesture;

TEST_P(SteadyRefined, OneSubdivisionChangesLittleTwoLittleMore) {
  const Positions coarse = solved(authors_).positions;
  const test::AuthorsGesture once = refined(authors_);
  expect_little(test::deviation(coarse, solved(once).positions));
  if (authors_.mesh.triangles.rows() > 5'000) return;  // Minutes.
  // What finalising does to the phone at 60,000 triangles is up to 2 % of D from what it does at 3,800: its passes are
  // compared.
  authors_.options.finalise = !is("phone", "def_v1");
  const test::AuthorsGesture twice = refined(refined(authors_));
  const test::Deviation by_two = test::deviation(solved(authors_).positions, solved(twice).positions);
  EXPECT_LT(by_two.mean, 0.01);
  EXPECT_LT(by_two.largest, 0.03);
}

INSTANTIATE_TEST_SUITE_P(
    Authors, SteadyRefined, testing::ValuesIn([] {
      std::vector<test::AuthorsName> all = test::authors_names();
      // Those without a result of the authors' program, one of each model.
      all.insert(all.end(), {{"screwdriver", "def_v1"}, {"m0839_sofa", "def_v2"}, {"f5-1_antique_chair", "def_v1"}});
      return all;
    }()),
    kNameOf);

}  // namespace
}  // namespace swage
