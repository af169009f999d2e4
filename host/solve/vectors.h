// Sums and updates of long vectors by threads, the same however many those are.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace swage {

/// Calls work(begin, count, index) for stretches that make up a vector of so many entries.
constexpr Eigen::Index kStretch = 16'384;
inline Eigen::Index stretch_count(Eigen::Index size) { return (size + kStretch - 1) / kStretch; }
template <typename Work>
void each_stretch(Eigen::Index size, const Work& work) {
  constexpr Eigen::Index kWorthThreads = 100'000;
#pragma omp parallel for schedule(static) if (size > kWorthThreads)
  for (Eigen::Index i = 0; i < stretch_count(size); ++i) {
    work(i * kStretch, std::min(kStretch, size - i * kStretch), i);
  }
}

/// vector · each of `others`, summed in double.
template <typename Vector, size_t kCount>
std::array<double, kCount> products(const Vector& vector, const std::array<const Vector*, kCount>& others) {
  Eigen::Array<double, static_cast<int>(kCount), Eigen::Dynamic> parts(kCount, stretch_count(vector.size()));
  each_stretch(vector.size(), [&](Eigen::Index begin, Eigen::Index count, Eigen::Index i) {
    for (size_t k = 0; k < kCount; ++k) {
      parts(static_cast<Eigen::Index>(k), i) = vector.segment(begin, count)
                                                   .template cast<double>()
                                                   .dot(others[k]->segment(begin, count).template cast<double>());
    }
  });
  std::array<double, kCount> sums = {};
  for (Eigen::Index i = 0; i < parts.cols(); ++i) {
    for (size_t k = 0; k < kCount; ++k) sums[k] += parts(static_cast<Eigen::Index>(k), i);
  }
  return sums;
}

/// y becomes a x + b y.
template <typename Vector>
void combine(double a, const Vector& x, double b, Vector& y) {
  using Value = typename Vector::Scalar;
  each_stretch(y.size(), [&](Eigen::Index begin, Eigen::Index count, Eigen::Index) {
    y.segment(begin, count) =
        static_cast<Value>(a) * x.segment(begin, count) + static_cast<Value>(b) * y.segment(begin, count);
  });
}

template <typename Vector>
double product(const Vector& a, const Vector& b) {
  return products<Vector, 1>(a, {&b})[0];
}

}  // namespace swage
