#include "same_places.h"

#include <gtest/gtest.h>
#include <omp.h>

#include <numeric>
#include <random>

namespace swage {
namespace {

/// Every one against all before it.
std::vector<int> by_comparing_all(const Positions& positions, double tolerance) {
  std::vector<int> firsts;
  for (int v = 0; v < positions.rows(); ++v) {
    int first = 0;
    while (first < v && ((positions.row(first) - positions.row(v)).norm() > tolerance ||
                         firsts[static_cast<size_t>(first)] != first)) {
      ++first;
    }
    firsts.push_back(first);
  }
  return firsts;
}

/// Clusters of points within less than half the tolerance, on and beside the planes of grids.
Positions clusters(double tolerance) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> place(-3, 3);
  std::uniform_real_distribution<double> off(-0.2, 0.2);
  Positions positions(600, 3);
  for (auto p : positions.rowwise()) {
    for (int u = 0; u < 3; ++u) p[u] = 8 * tolerance * place(random) + tolerance * off(random);
  }
  return positions;
}

TEST(Places, AreThoseThatComparingAllFinds) {
  for (const double tolerance : {1e-9, 1e-3, 1.0}) {
    const Positions positions = clusters(tolerance);
    EXPECT_EQ(firsts_at_places(positions, tolerance), by_comparing_all(positions, tolerance)) << tolerance;
  }
}

TEST(Places, WithoutToleranceAreExact) {
  Positions positions(5, 3);
  positions << 0, 1, 2, -0.0, 1, 2, 0, 1, std::nextafter(2, 3), 0, 1, 2, 1e300, 1, 2;
  EXPECT_EQ(firsts_at_places(positions, 0), (std::vector<int>{0, 0, 2, 0, 4}));
}

TEST(Places, OfManyInOneSmallSpotAreFoundInTime) {
  // All but one within a millionth of the box.
  Positions positions = 1e-6 * Positions::Random(200'000, 3);
  positions.row(0) << 1, 1, 1;
  positions.bottomRows(100'000) = positions.middleRows(50'000, 100'000).eval();
  const std::vector<int> firsts = firsts_at_places(positions, 1e-12);
  for (int v = 0; v < 100'000; ++v) ASSERT_EQ(firsts[static_cast<size_t>(v)], v);
  for (int v = 100'000; v < 150'000; ++v) ASSERT_EQ(firsts[static_cast<size_t>(v)], v - 50'000);
}

TEST(Places, AreTheSameFromAnyNumberOfThreads) {
  const Positions positions = clusters(1e-3).replicate(400, 1);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<int> one = firsts_at_places(positions, 1e-3);
  omp_set_num_threads(5);
  EXPECT_EQ(firsts_at_places(positions, 1e-3), one);
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace swage
