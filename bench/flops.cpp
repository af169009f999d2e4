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
  Counting& operator+=(Counting b) { return *this = *this + b; }
  friend Counting operator-(Counting a) { return -a.value_; }
  friend Counting sqrt(Counting a) { return ++counted.roots, std::sqrt(a.value_); }
  friend Counting fabs(Counting a) { return std::fabs(a.value_); }
  friend Counting copysign(Counting a, Counting b) { return std::copysign(a.value_, b.value_); }
  friend bool operator<(Counting a, Counting b) { return a.value_ < b.value_; }
  friend bool operator>(Counting a, Counting b) { return a.value_ > b.value_; }
  friend bool operator<=(Counting a, Counting b) { return a.value_ <= b.value_; }
  friend bool operator>=(Counting a, Counting b) { return a.value_ >= b.value_; }
  friend bool operator==(Counting a, Counting b) { return a.value_ == b.value_; }

 private:
  double value_;
};

using real = Counting;
using scalar = double;
using mask = bool;
using wide = Counting;
wide to_wide(real number) { return number; }
int any_lane(bool condition) { return condition ? 1 : 0; }
// Each needs those before it.
// clang-format off
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/procrustes.h"
#include "shared/wide.h"
#include "shared/transform.h"
#include "shared/quadric.h"
namespace in_rows {
#include "row.h"
#include "shared/rows.h"
#include "shared/coupling.h"
}  // namespace in_rows
// clang-format on

template <typename Compute>
Flops flops_of(const Compute& compute) {
  counted = {};
  compute();
  return counted;
}

Mat3 sum_of_pairs(int pairs) {
  Mat3 sum = mat3(vec3(1, 2, 3), vec3(4, 5, 7), vec3(8, 9, 11));
  for (int p = 0; p < pairs; ++p) {
    sum = add_mat3(sum, outer3(sub3(vec3(p, 1, 2), vec3(0, 0, 0)), vec3(3, p, 5)));
  }
  return sum;
}

/// On a saddle. In single precision with what rounding took.
Vec3 offset_to(int neighbour, bool single) {
  const double angle = neighbour, x = std::cos(angle), y = std::sin(angle);
  const Vec3 from = vec3(0, 0, 0), to = vec3(x, y, x * y);
  const Vec3 rounded = sub3(to, from);
  return single ? add3(rounded, sub3(from, from)) : rounded;
}

}  // namespace

Flops flops_of_closest_rotation() { return flops_of_rotation(0); }

Flops flops_of_rotation(int pairs) {
  return flops_of([=] { closest_rotation(sum_of_pairs(pairs)); });
}

Flops flops_of_similarity(int pairs) {
  return flops_of([=] {
    const Mat3 sum = sum_of_pairs(pairs), rotation = closest_rotation(sum);
    scale_mat3(closest_scale(rotation, sum, 1), rotation);
  });
}

Flops flops_of_transform() {
  const Mat3 m = mat3(vec3(1, 0.2, 0.3), vec3(0.4, 1, 0.5), vec3(0.6, 0.7, 1));
  const Vec3 edge = vec3(1, 2, 3), normal = vec3(0, 0, 1);
  const Flops per_triangle = flops_of([=] {
    distance_from_identity(damped_inverse(with_mapped_normal(m, normal)).matrix);
    distance_from_normal(m, normal);
    TriangleTerms terms = no_edges(normal, 1, 1);
    for (int k = 0; k < 3; ++k) {
      terms = add_edge(terms, m, normal, sub3(edge, normal), edge, 1, 1, 1);
      length_weight(dot3(edge, edge), 1);
    }
  });
  const Flops per_edge = flops_of([=] {
    const EdgeSum sum =
        add_sides(edge_side(apply3(m, edge), m, normal, edge), edge_side(apply3(m, edge), m, normal, edge));
    const real target = target_length(sum.length, 0, edge);
    edge_quadratic(sum, 1, edge, length_weight(target * target, 1), target, 1, 1);
    const Mat3 difference = sub_mat3(m, m);
    disagreement(difference, edge) + disagreement(difference, normal);
  });
  auto add = [](int triangle, int edges) { return triangle + edges * 3 / 2; };
  return {add(per_triangle.sums, per_edge.sums), add(per_triangle.products, per_edge.products),
          add(per_triangle.quotients, per_edge.quotients), add(per_triangle.roots, per_edge.roots)};
}

Flops flops_of_coupling() {
  const in_rows::Rows m{{1, 2, 3, 0}, {4, 5, 6, 0}, {7, 8, 9, 0}};
  const Flops of_four = flops_of([=] {
    in_rows::Rows product = in_rows::own_product(m, m, m, m.x, 1, 1);
    for (int k = 0; k < 3; ++k) product = add_rows(product, in_rows::shared_product(m, m, m));
  });
  auto entries = [](int of_fours) { return of_fours * 3 / 4; };  // Of each row three count.
  return {entries(of_four.sums), entries(of_four.products), 0, 0};
}

Flops flops_of_curvature(int neighbours, double scalar_size) {
  const bool single = scalar_size == sizeof(float);
  return flops_of([=] {
    const Vec3 normal = vec3(0, 0, 1);
    const Plane plane = plane_normal_to(normal);
    Spread spread = no_spread();
    for (int k = 0; k < neighbours; ++k) spread = spread_to(spread, plane, normal, offset_to(k, single));
    const Units units = units_of(spread, plane);
    Triangle triangle = no_equations();
    for (int k = 0; k < neighbours; ++k) triangle = fold(triangle, terms_at(units, normal, offset_to(k, single)));
    const Rows rows = orthogonal(rows_of(triangle), single ? sizeof(float) : sizeof(double));
    principal_curvatures(graph_of(coefficients(rows), units.per_u, units.per_w));
  });
}

}  // namespace swage::bench
