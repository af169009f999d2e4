#include "swage/compare.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "shapes.h"
#include "swage/error.h"

namespace swage::test {
namespace {

using std::numbers::pi;

Positions mapped(const Positions& positions, const Eigen::Matrix3d& map) { return positions * map.transpose(); }

Positions scaled(const Positions& positions, const Eigen::Vector3d& factors) {
  return mapped(positions, factors.asDiagonal());
}

void expect_spread(const Spread& spread, double mean, double percentile_95, double max, double tolerance = 1e-9) {
  EXPECT_NEAR(spread.mean, mean, tolerance);
  EXPECT_NEAR(spread.percentile_95, percentile_95, tolerance);
  EXPECT_NEAR(spread.max, max, tolerance);
}

TEST(Compare, ASimilarityChangesSizeAlone) {
  const Mesh mesh = torus();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Positions edit = mapped(mesh.positions, 3 * turn).rowwise() + Eigen::RowVector3d(5, 6, 7);
  const Comparison same = compare(mesh.positions, edit, mesh.triangles);
  EXPECT_GT(same.turn.mean, 0.1);
  EXPECT_LE(same.turn.max, 0.5 + 1e-9);
  expect_spread(same.uneven, 0, 0, 0);
  expect_spread(same.shear, 0, 0, 0);
  expect_spread(same.size, std::log(3), std::log(3), std::log(3));
  EXPECT_NEAR(same.slippage_loss.max, 0, 1e-9);
  EXPECT_NEAR(same.slippage_measured, 1, 1e-12);
  EXPECT_NEAR(same.area_after / same.area_before, 9, 1e-9);
  EXPECT_NEAR(*same.volume_after / *same.volume_before, 27, 1e-9);
  EXPECT_EQ(same.flipped, 0);
  EXPECT_EQ(same.collapsed, 0);
  EXPECT_EQ(same.new_crossings, 0);
  EXPECT_TRUE(same.complete);
}

TEST(Compare, ACylinderScaledAlongItsAxisSlidesStill) {
  const Mesh mesh = cylinder();
  const Comparison longer = compare(mesh.positions, scaled(mesh.positions, {2, 3, 2}), mesh.triangles);
  EXPECT_NEAR(longer.turn.max, 0, 1e-7);
  // Chords of 32 segments; the caps keep their shape.
  const double side = 32 * std::sin(pi / 32), caps = 2 * 32 * std::sin(2 * pi / 32) / 8, share = side / (side + caps);
  expect_spread(longer.uneven, share * std::log(1.5), std::log(1.5), std::log(1.5));
  expect_spread(longer.shear, share * 2 * std::asin(0.2), 2 * std::asin(0.2), 2 * std::asin(0.2));
  EXPECT_NEAR(longer.slippage_loss.max, 0, 1e-9);
  ASSERT_EQ(longer.round_parts.size(), 1U);
  EXPECT_FALSE(longer.round_parts[0].is_sphere);
  EXPECT_NEAR(longer.round_parts[0].radius, 0.5, 1e-9);
  EXPECT_NEAR(longer.round_parts[0].before, 0, 1e-9);
  EXPECT_NEAR(longer.round_parts[0].after, 0, 1e-9);
  EXPECT_NEAR(longer.out_of_round.value(), 0, 1e-9);
}

/// Of points evenly around an ellipse: from their distances to its centre.
double out_of_round(double a, double b) {
  constexpr int kPoints = 100'000;
  const double radius = std::sqrt((a * a + b * b) / 2);
  double sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2 * pi * i / kPoints;
    sum += std::pow(std::hypot(a * std::cos(angle), b * std::sin(angle)) / radius - 1, 2);
  }
  return std::sqrt(sum / kPoints);
}

TEST(Compare, ACylinderScaledAcrossItsAxisIsRoundNoMore) {
  const Mesh mesh = cylinder(0.5, 1, 64, 10);
  const Comparison flat = compare(mesh.positions, scaled(mesh.positions, {1.2, 1, 1}), mesh.triangles);
  EXPECT_GT(flat.turn.max, 0.05);
  EXPECT_NEAR(flat.slippage_loss.max, 0, 1e-9) << "the map is linear";
  ASSERT_EQ(flat.round_parts.size(), 1U);
  EXPECT_NEAR(flat.round_parts[0].after, out_of_round(1.2, 1), 1e-4);
  EXPECT_NEAR(flat.out_of_round.value(), out_of_round(1.2, 1), 1e-4);
}

TEST(Compare, ASphereMadeAnEggIsRoundNoMore) {
  const Mesh mesh = sphere();
  const Comparison same = compare(mesh.positions, 2 * mesh.positions, mesh.triangles);
  ASSERT_EQ(same.round_parts.size(), 1U);
  EXPECT_TRUE(same.round_parts[0].is_sphere);
  EXPECT_NEAR(same.round_parts[0].area, same.area_before, 1e-9);
  EXPECT_NEAR(same.round_parts[0].after, 0, 1e-9);
  const Comparison egg = compare(mesh.positions, scaled(mesh.positions, {1, 1.3, 1}), mesh.triangles);
  EXPECT_GT(egg.out_of_round.value(), 0.05);
}

TEST(Compare, AShearedBoxAsInClosedForm) {
  constexpr double kShear = 0.4;  // x grows by that much along y.
  const Mesh mesh = box({1, 1, 1}, 4);
  Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
  map(0, 1) = kShear;
  const Comparison sheared = compare(mesh.positions, mapped(mesh.positions, map), mesh.triangles);
  const double large = std::sqrt(1 + kShear * kShear / 4) + kShear / 2, small = 1 / large;
  const double slant = std::hypot(1, kShear), tilt = std::atan(kShear);
  const Positions normals = [&] {
    Positions n(mesh.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < n.rows(); ++t) {
      const Eigen::RowVector3d a = mesh.positions.row(mesh.triangles(t, 0));
      const Eigen::RowVector3d b = mesh.positions.row(mesh.triangles(t, 1)),
                               c = mesh.positions.row(mesh.triangles(t, 2));
      n.row(t) = (b - a).cross(c - a).normalized();
    }
    return n;
  }();
  for (Eigen::Index t = 0; t < normals.rows(); ++t) {
    const Eigen::RowVector3d n = normals.row(t).cwiseAbs();
    const Eigen::RowVector2d s = sheared.faces.stretches.row(t);
    if (n[0] > 0.5) {
      EXPECT_NEAR(s[0], slant, 1e-9);
      EXPECT_NEAR(s[1], 1, 1e-9);
      EXPECT_NEAR(sheared.faces.turn[t], tilt, 1e-9);
    } else if (n[1] > 0.5) {
      EXPECT_NEAR(s[0], 1, 1e-9);
      EXPECT_NEAR(s[1], 1, 1e-9);
      EXPECT_NEAR(sheared.faces.turn[t], 0, 1e-9);
    } else {
      EXPECT_NEAR(s[0], large, 1e-9);
      EXPECT_NEAR(s[1], small, 1e-9);
      EXPECT_NEAR(sheared.faces.turn[t], 0, 1e-9);
    }
  }
  expect_spread(sheared.turn, tilt / 3, tilt, tilt);
  EXPECT_NEAR(sheared.size.max, std::log(slant) / 2, 1e-9);
  EXPECT_NEAR(sheared.slippage_loss.max, 0, 1e-9);
  EXPECT_TRUE(sheared.round_parts.empty());
  EXPECT_FALSE(sheared.out_of_round);
}

/// A sheet in x, y rolled about the y axis's direction to a cylinder of that radius, without stretching it.
Positions rolled(const Positions& positions, double radius) {
  Positions result = positions;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double angle = positions(v, 0) / radius;
    result.row(v) << radius * std::sin(angle), positions(v, 1), positions(v, 2) + radius * (1 - std::cos(angle));
  }
  return result;
}

TEST(Compare, ABentSheetAsInClosedForm) {
  constexpr int kCells = 32;
  const Mesh mesh = sheet(kCells);
  const double width = mesh.positions.col(0).maxCoeff() - mesh.positions.col(0).minCoeff();
  const double radius = 2 * width, step = width / kCells / radius;  // Radians a cell.
  const Comparison bent = compare(mesh.positions, rolled(mesh.positions, radius), mesh.triangles);
  const double chord = std::sin(step / 2) / (step / 2);
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    const Eigen::RowVector3d xs = mesh.positions.col(0)(mesh.triangles.row(t)).transpose();
    const double middle = (xs.maxCoeff() + xs.minCoeff()) / 2;
    EXPECT_NEAR(bent.faces.turn[t], std::abs(middle / radius), 1e-9);
    EXPECT_NEAR(bent.faces.stretches(t, 0), 1, 1e-9);
    EXPECT_NEAR(bent.faces.stretches(t, 1), chord, 1e-9);
  }
  EXPECT_NEAR(bent.slippage_loss.mean, box_diagonal(mesh.positions) / radius, 1e-3);
  EXPECT_NEAR(bent.slippage_loss.max, box_diagonal(mesh.positions) / radius, 1e-3);
}

/// A smooth edit of a cylinder that changes all that is measured.
Positions bulged(const Positions& positions) {
  Positions result = positions;
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    const double along = positions(v, 1), grown = 1 + 0.3 * std::sin(2 * along);
    result.row(v) << grown * positions(v, 0), 1.5 * along, 1.2 * grown * positions(v, 2);
  }
  return result;
}

/// Vertices of a cylinder's side that are off its rims slide by up to 30 % of the spacing.
Mesh irregular(Mesh mesh, int segments, int rings) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> slide(-0.3, 0.3);
  const double low = mesh.positions.col(1).minCoeff(), high = mesh.positions.col(1).maxCoeff();
  const double radius = mesh.positions.col(0).maxCoeff();
  for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
    const Eigen::RowVector3d at = mesh.positions.row(v);
    if (at[1] < low + 1e-9 || at[1] > high - 1e-9) continue;
    const double angle = std::atan2(at[2], at[0]) + slide(random) * 2 * pi / segments;
    mesh.positions.row(v) << radius * std::cos(angle), at[1] + slide(random) * (high - low) / rings,
        radius * std::sin(angle);
  }
  return mesh;
}

TEST(Compare, HowASurfaceIsCutIntoTrianglesHardlyMatters) {
  const Mesh coarse = cylinder(0.5, 1, 64, 24), fine = irregular(cylinder(0.5, 1, 150, 48), 150, 48);
  const Comparison one = compare(coarse.positions, bulged(coarse.positions), coarse.triangles);
  const Comparison other = compare(fine.positions, bulged(fine.positions), fine.triangles);
  const auto expect_near = [](const char* name, const Spread& a, const Spread& b) {
    SCOPED_TRACE(name);
    EXPECT_GT(a.mean, 0.01);
    EXPECT_NEAR(a.mean / b.mean, 1, 0.02);
    EXPECT_NEAR(a.percentile_95 / b.percentile_95, 1, 0.02);
  };
  expect_near("turn", one.turn, other.turn);
  expect_near("uneven", one.uneven, other.uneven);
  expect_near("shear", one.shear, other.shear);
  expect_near("size", one.size, other.size);
  expect_near("slippage loss", one.slippage_loss, other.slippage_loss);
  EXPECT_NEAR(one.out_of_round.value() / other.out_of_round.value(), 1, 0.02);
  EXPECT_NEAR(one.area_after / other.area_after, 1, 0.02);
}

TEST(Compare, CountsWhatTurnsOverCollapsesAndCrosses) {
  Mesh mesh = sheet(2);
  Positions edit = mesh.positions;
  edit.row(mesh.triangles(0, 0)) = edit.row(mesh.triangles(0, 1));
  const Comparison collapsed = compare(mesh.positions, edit, mesh.triangles);
  EXPECT_GE(collapsed.collapsed, 1);
  EXPECT_TRUE(std::isnan(collapsed.faces.turn[0]));
  EXPECT_TRUE(std::isfinite(collapsed.turn.mean));
  edit = scaled(mesh.positions, {-1, 1, 1});
  const Comparison mirrored = compare(mesh.positions, edit, mesh.triangles);
  EXPECT_EQ(mirrored.flipped, mesh.triangles.rows());
  expect_spread(mirrored.turn, pi, pi, pi);
  expect_spread(mirrored.uneven, 0, 0, 0);

  const Mesh two = joined(mesh, transformed(mesh, 1, {0, 0, 0.5}));
  edit = two.positions;
  edit.row(edit.rows() - 1)[2] = -0.5;  // A corner of the upper one, through the lower.
  const Comparison crossed = compare(two.positions, edit, two.triangles);
  EXPECT_EQ(crossed.crossings_before, 0);
  EXPECT_GT(crossed.new_crossings.value(), 0);
}

TEST(Compare, ChainsAndHandles) {
  const Mesh mesh = sheet(8);
  std::vector<int> chain;
  for (int v = 0; v < mesh.positions.rows() && chain.size() < 3; ++v) chain.push_back(v);
  CompareOptions options;
  options.straight_chains = {chain};
  Gesture gesture;
  gesture.add(4, mesh.positions.row(4).transpose() + Eigen::Vector3d(0, 0, 0.5));
  options.gesture = gesture;
  const Comparison none = compare(mesh.positions, mesh.positions, mesh.triangles, options);
  EXPECT_NEAR(*none.handle_error, 0.5 / box_diagonal(mesh.positions), 1e-12);
  Positions edit = mesh.positions;
  edit(chain[1], 2) += 0.1;
  const Comparison bent = compare(mesh.positions, edit, mesh.triangles, options);
  EXPECT_NEAR(*bent.bend_after - *bent.bend_before, 0.1 / box_diagonal(mesh.positions), 1e-9);
  EXPECT_FALSE(compare(mesh.positions, edit, mesh.triangles).bend_after);
  EXPECT_FALSE(compare(mesh.positions, edit, mesh.triangles).handle_error);
}

TEST(Compare, RefusesWhatIsNoEdit) {
  const Mesh mesh = sheet(2);
  EXPECT_THROW(compare(mesh.positions, mesh.positions.topRows(3), mesh.triangles), InvalidInput);
  EXPECT_THROW(compare(Positions::Zero(mesh.positions.rows(), 3), mesh.positions, mesh.triangles), InvalidInput);
  CompareOptions options;
  options.crease_angle = -1;
  EXPECT_THROW(compare(mesh.positions, mesh.positions, mesh.triangles, options), InvalidInput);
  options = {};
  options.straight_chains = {{0, 1, 1000}};
  EXPECT_THROW(compare(mesh.positions, mesh.positions, mesh.triangles, options), InvalidInput);
}

TEST(Compare, EndsWhereToldTo) {
  const Mesh mesh = sheet(8);
  const Comparison part =
      compare(mesh.positions, rolled(mesh.positions, 1), mesh.triangles, {}, [](const Progress&) { return false; });
  EXPECT_FALSE(part.complete);
  EXPECT_GT(part.turn.mean, 0);
  EXPECT_FALSE(part.new_crossings);
}

}  // namespace
}  // namespace swage::test
