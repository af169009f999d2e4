// The authors' own program on the authors' own gestures.
#include <gtest/gtest.h>

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "authors.h"
#include "edit_measures.h"
#include "measures.h"
#include "places.h"
#include "swage/reshape.h"

namespace swage {
namespace {

constexpr double kPosition = 1e-7;  // × D. The reference is printed to 15 digits; noise of 1e-10 moves it by 1e-9.

struct Expected {
  const char* model;
  const char* gesture;
  int passes, best_pass;
  Termination stop;
  double energy;
  double handle_error;  // × D, before finalising.
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.model << " " << expected.gesture; }

constexpr Termination kMoved = Termination::moved_little;
const Expected kGestures[] = {
    {"cylinder_1kF", "def_v0", 10, 9, kMoved, 0.628456, 1.5e-4},
    {"cylinder_1kF", "def_v1", 55, 54, kMoved, 1.87243, 5.7e-5},
    {"cylinder_1kF", "def_v2", 12, 11, kMoved, 2.15717, 6.3e-5},
    {"cylinder_1kF", "def_v3", 10, 9, kMoved, 0.695393, 1.4e-4},
    {"phone", "def_v1", 21, 20, kMoved, 134.658, 1.05e-2},
    {"cutlery_s26-1", "def_v1", 27, 25, Termination::energy_rose, 2.98551, 1.9e-3},
    {"e_car_extruded", "def_v1", 34, 33, kMoved, 7.85116, 1.8e-3},
    {"espresso", "def_v1", 36, 35, kMoved, 11.5729, 1.3e-3},
};

/// Their results are in the unit box.
double largest_deviation(const Expected& expected, const std::string& suffix, const Positions& rest,
                         const Positions& result) {
  const Positions theirs = test::authors_result(expected.model, expected.gesture, suffix);
  const UnitBox box = unit_box(rest);
  return (box.into(result) - theirs).rowwise().norm().maxCoeff() / box_diagonal(box.into(rest));
}

/// As their program prints energies.
std::string six_digits(double number) {
  std::ostringstream text;
  text << std::setprecision(6) << number;
  return text.str();
}

class ReferenceGesture : public testing::TestWithParam<Expected> {};

TEST_P(ReferenceGesture, IsMetStepByStep) {
  if (!test::has_shared()) GTEST_SKIP() << "the reference results are not here";
  const Expected& expected = GetParam();
  const auto [mesh, options, gesture] =
      test::authors_gesture(expected.model, expected.gesture, ReshapeSolver::published);

  const ReshapeResult result = reshape(mesh.positions, mesh.triangles, gesture, options);

  EXPECT_EQ(result.report.passes, expected.passes);
  EXPECT_EQ(result.report.best_pass, expected.best_pass);
  EXPECT_EQ(result.report.stop, expected.stop);
  EXPECT_EQ(six_digits(result.report.energy), six_digits(expected.energy));
  EXPECT_LT(largest_deviation(expected, ".expected.obj", mesh.positions, result.positions), kPosition);
  const bool fires = std::string(expected.model) == "phone";
  EXPECT_EQ(result.finalised, fires);
  if (fires) {
    EXPECT_LT(largest_deviation(expected, ".unfinished.obj", mesh.positions, result.unfinished), kPosition);
  }

  EXPECT_NEAR(test::handle_error(mesh, gesture, result.unfinished), expected.handle_error,
              0.05 * expected.handle_error);
}

INSTANTIATE_TEST_SUITE_P(Authors, ReferenceGesture, testing::ValuesIn(kGestures),
                         [](const auto& named) { return test::test_name(named.param.model, named.param.gesture); });

}  // namespace
}  // namespace swage
