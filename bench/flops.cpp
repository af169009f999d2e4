#include "flops.h"

#include <cmath>

namespace swage::bench {
namespace {

Flops counted;

class Counting {
 public:
  constexpr Counting(double value = 0) : value_(value) {}

  friend Counting operator+(Counting a, Counting b) { return ++counted.sums, a.value_ + b.value_; }
  friend Counting operator-(Counting a, Counting b) { return ++counted.sums, a.value_ - b.value_; }
  friend Counting operator*(Counting a, Counting b) { return ++counted.products, a.value_ * b.value_; }
  friend Counting operator/(Counting a, Counting b) { return ++counted.quotients, a.value_ / b.value_; }
  friend Counting operator-(Counting a) { return -a.value_; }
  friend Counting sqrt(Counting a) { return ++counted.roots, std::sqrt(a.value_); }
  friend Counting fabs(Counting a) { return std::fabs(a.value_); }
  friend bool operator<(Counting a, Counting b) { return a.value_ < b.value_; }
  friend bool operator>(Counting a, Counting b) { return a.value_ > b.value_; }
  friend bool operator>=(Counting a, Counting b) { return a.value_ >= b.value_; }
  friend bool operator==(Counting a, Counting b) { return a.value_ == b.value_; }

 private:
  double value_;
};

using real = Counting;
using scalar = double;
using mask = bool;
// Each needs those before it.
// clang-format off
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/procrustes.h"
// clang-format on

template <typename Compute>
Flops flops_of(const Compute& compute) {
  counted = {};
  compute();
  return counted;
}

}  // namespace

Flops flops_of_closest_rotation() {
  return flops_of([] { closest_rotation(mat3(vec3(1, 2, 3), vec3(4, 5, 7), vec3(8, 9, 11))); });
}

}  // namespace swage::bench
