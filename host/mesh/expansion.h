// Numbers without rounding: sums of doubles that do not overlap (Shewchuk 1997).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace swage {

/// A sum of up to N doubles, none of them zero, of ascending magnitude and strongly nonoverlapping, so that the last
/// one has the sign of the whole. Exact as long as no product overflows or underflows.
template <std::size_t N>
class Expansion {
 public:
  void append(double term) {
    if (term != 0) terms_[size_++] = term;
  }
  std::size_t size() const { return size_; }
  /// 0 beyond the last.
  double operator[](std::size_t i) const { return i < size_ ? terms_[i] : 0; }
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }

 private:
  // The first `size_` of them; the others are never read.
  std::array<double, N> terms_;  // NOLINT(cppcoreguidelines-pro-type-member-init)
  std::size_t size_ = 0;
};

/// A rounded result and what rounding took away.
struct Rounded {
  double value, rest;
};

inline Rounded sum_of(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a, a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

inline Rounded product_of(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

inline Expansion<2> difference(double a, double b) {
  const Rounded rounded = sum_of(a, -b);
  Expansion<2> exact;
  exact.append(rounded.rest);
  exact.append(rounded.value);
  return exact;
}

template <std::size_t N>
Expansion<N> operator-(const Expansion<N>& e) {
  Expansion<N> negative;
  for (std::size_t i = 0; i < e.size(); ++i) negative.append(-e[i]);
  return negative;
}

/// Merges by magnitude and sums from the smallest on (Shewchuk's fast expansion sum).
template <std::size_t N, std::size_t M>
Expansion<N + M> operator+(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> result;
  double sum = 0;
  for (std::size_t i = 0, j = 0; i + j < e.size() + f.size();) {
    const bool from_e = j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]));
    const Rounded next = sum_of(sum, from_e ? e[i++] : f[j++]);
    result.append(next.rest);
    sum = next.value;
  }
  result.append(sum);
  return result;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  return e + -f;
}

template <std::size_t N>
Expansion<2 * N> operator*(const Expansion<N>& e, double factor) {
  Expansion<2 * N> result;
  double sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i) {
    const Rounded product = product_of(e[i], factor);
    const Rounded low = sum_of(sum, product.rest), high = sum_of(product.value, low.value);
    result.append(low.rest);
    result.append(high.rest);
    sum = high.value;
  }
  result.append(sum);
  return result;
}

template <std::size_t N>
Expansion<4 * N> operator*(const Expansion<N>& e, const Expansion<2>& f) {
  return e * f[0] + e * f[1];
}

}  // namespace swage
