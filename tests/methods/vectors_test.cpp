#include "vectors.h"

#include <gtest/gtest.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <cmath>

namespace swage {
namespace {

constexpr Eigen::Index kLong = 200'003;

Eigen::VectorXf sines(Eigen::Index size, float step) {
  return Eigen::VectorXf::NullaryExpr(size, [&](Eigen::Index i) { return std::sin(step * static_cast<float>(i)); });
}

TEST(Vectors, ProductsAreEigens) {
  for (const Eigen::Index size : {Eigen::Index{0}, Eigen::Index{5}, kStretch, kLong}) {
    const Eigen::VectorXf a = sines(size, 0.1F), b = sines(size, 0.11F);
    const auto [aa, ab] = products<Eigen::VectorXf, 2>(a, {&a, &b});
    EXPECT_NEAR(aa, a.cast<double>().squaredNorm(), 1e-12 * static_cast<double>(size));
    EXPECT_NEAR(ab, a.cast<double>().dot(b.cast<double>()), 1e-12 * static_cast<double>(size));
    EXPECT_EQ(product(a, b), ab);
  }
}

TEST(Vectors, CombineIsEigens) {
  const Eigen::VectorXf x = sines(kLong, 0.1F);
  Eigen::VectorXf y = sines(kLong, 0.2F);
  const Eigen::VectorXf expected = 2 * x - 0.5F * y;
  combine(2, x, -0.5, y);
  EXPECT_EQ(y, expected);
}

#ifdef _OPENMP
TEST(Vectors, ProductsDoNotDependOnThreads) {
  const Eigen::VectorXf a = sines(kLong, 0.1F), b = sines(kLong, 0.11F);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const double one = product(a, b);
  omp_set_num_threads(3);
  EXPECT_EQ(product(a, b), one);
  omp_set_num_threads(threads);
}
#endif

}  // namespace
}  // namespace swage
