// Models of parts, resized: what is round stays round, and what is to keep its size does.
#include "resize_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ball_amid_slabs.h"
#include "rims.h"

namespace swage::test {
namespace {

using Factors = Eigen::RowVector3d;

Positions resized(const Assembled& model, const ResizeTarget& target, const ResizeOptions& options = {}) {
  return resize(model.mesh.positions, model.mesh.triangles, target, options).positions;
}

Positions plainly_scaled(const Assembled& model, const ResizeTarget& target) {
  return model.mesh.positions * target.factors.asDiagonal();
}

std::vector<Rim> joined_rims(std::vector<Rim> rims, const std::vector<Rim>& others) {
  rims.insert(rims.end(), others.begin(), others.end());
  return rims;
}

/// By how much a part's extents grew unevenly.
double uneven(const Assembled& model, const Part& part, const Positions& positions) {
  const auto of = [&](const Positions& all) { return extents(all.middleRows(part.first, part.count)); };
  const Factors growth = of(positions).cwiseQuotient(of(model.mesh.positions));
  return growth.maxCoeff() / growth.minCoeff() - 1;
}

TEST(ResizeModels, WheelsOfACarStayRound) {
  const Assembled model = car();
  const std::vector<Rim> wheels =
      joined_rims(joined_rims(rims_of(model, "tyre", 2), rims_of(model, "rim", 2)), rims_of(model, "cap", 2));
  ASSERT_EQ(wheels.size(), 12U);
  EXPECT_NEAR(most_oval(model.mesh.positions, wheels), 0, 1e-12);
  EXPECT_NEAR(most_oval(plainly_scaled(model, by(2, 1, 1)), wheels), 1, 1e-12);
  EXPECT_LT(most_oval(resized(model, by(2, 1, 1)), wheels), 0.05);
  EXPECT_LT(most_oval(resized(model, by(1, 2, 1)), wheels), 0.05);
}

TEST(ResizeModels, TheDialOfAClockStaysRound) {
  const Assembled model = clock_of_parts();
  const std::vector<Rim> dial =
      joined_rims(joined_rims(rims_of(model, "dial", 2), rims_of(model, "bezel", 2)), rims_of(model, "inner ring", 2));
  ASSERT_EQ(dial.size(), 3U);
  EXPECT_NEAR(most_oval(plainly_scaled(model, by(2, 1, 1)), dial), 1, 1e-12);
  EXPECT_LT(most_oval(resized(model, by(2, 1, 1)), dial), 0.05);
  EXPECT_LT(most_oval(resized(model, by(1, 2, 1)), dial), 0.05);
}

TEST(ResizeModels, HatchesAndCapsOfATankStayRound) {
  const Assembled model = tank();
  const std::vector<Rim> hatches = joined_rims(rims_of(model, "hatch", 1), rims_of(model, "eye", 2));
  const std::vector<Part> caps = model.named("cap");
  ASSERT_EQ(hatches.size(), 8U);
  ASSERT_EQ(caps.size(), 2U);
  EXPECT_NEAR(most_oval(plainly_scaled(model, by(2, 1, 1)), hatches), 1, 1e-12);
  const Positions result = resized(model, by(2, 1, 1));
  EXPECT_LT(most_oval(result, hatches), 0.05);
  for (const Part& cap : caps) {
    EXPECT_NEAR(uneven(model, cap, plainly_scaled(model, by(2, 1, 1))), 1, 1e-12);
    EXPECT_LT(uneven(model, cap, result), 0.05);
  }
}

class BoltHoles : public testing::TestWithParam<bool> {};

TEST_P(BoltHoles, KeepTheirDiameter) {
  const Assembled model = bolted_plate(GetParam());
  const std::vector<Rim> holes = bolt_holes(model);
  ASSERT_EQ(holes.size(), 4U);
  for (const Rim& hole : holes) ASSERT_THAT(hole.vertices, testing::SizeIs(64));
  for (const double factor : {2.0, 3.0, 0.7}) {
    const Positions result = resized(model, by(factor, 1, 1, ResizeKeep::size));
    const Positions shaped = resized(model, by(factor, 1, 1));
    for (const Rim& hole : holes) {
      EXPECT_LT((diameters(result, hole).array() / 6 - 1).abs().maxCoeff(), 0.02) << factor;
      // As the paper has it, they grow and shrink with the plate, and stay round.
      EXPECT_GT((diameters(shaped, hole).array() / 6 - 1).abs().minCoeff(), 0.05) << factor;
      EXPECT_LT(oval(shaped, hole), 0.02) << factor;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Plate, BoltHoles, testing::Bool(),
                         [](const auto& plate) { return plate.param ? "ribbed" : "flat"; });

TEST(ResizeModels, WheelsKeepTheirSizeWhereAsked) {
  const Assembled model = car();
  const Positions result = resized(model, by(2, 1, 1, ResizeKeep::size));
  for (const Rim& wheel : rims_of(model, "tyre", 2)) {
    EXPECT_LT((diameters(result, wheel).array() / 14 - 1).abs().maxCoeff(), 0.05);
  }
}

TEST(ResizeModels, BoxesAreScaledPlainly) {
  const Assembled model = boxes();
  for (const Factors& factors : {Factors(2, 1, 1), Factors(1, 0.5, 1), Factors(0.3, 1, 3)}) {
    ResizeTarget target;
    target.factors = factors;
    const Positions due = plainly_scaled(model, target);
    EXPECT_LT((resized(model, target) - due).cwiseAbs().maxCoeff(), 1e-4 * extents(due).norm()) << factors;
  }
}

}  // namespace
}  // namespace swage::test
