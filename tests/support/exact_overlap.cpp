#include "exact_overlap.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

namespace swage::test {
namespace {

using Triangle = std::array<IntegerVector, 3>;

/// A point times its positive `weight`.
struct Weighted {
  IntegerVector point;
  long weight;
};

IntegerVector normal(const Triangle& t) { return (t[1] - t[0]).cross(t[2] - t[0]); }

bool lies_in(const Weighted& p, const Triangle& t) {
  const IntegerVector up = normal(t);
  if (up.dot(p.point - p.weight * t[0]) != 0) return false;
  for (size_t k = 0; k < 3; ++k) {
    if (up.dot((t[(k + 1) % 3] - t[k]).cross(p.point - p.weight * t[k])) < 0) return false;
  }
  return true;
}

/// Where the lines p q and a b of one plane meet; nothing where they are parallel.
void add_meeting(const IntegerVector& p, const IntegerVector& q, const IntegerVector& a, const IntegerVector& b,
                 std::vector<Weighted>& points) {
  const IntegerVector bottom = (q - p).cross(b - a), top = (a - p).cross(b - a);
  const long weight = bottom.squaredNorm();
  if (weight > 0) points.push_back({weight * p + top.dot(bottom) * (q - p), weight});
}

/// Where the line p q can enter or leave the triangle.
void add_candidates(const IntegerVector& p, const IntegerVector& q, const Triangle& t, std::vector<Weighted>& points) {
  points.push_back({p, 1});
  points.push_back({q, 1});
  const long p_height = normal(t).dot(p - t[0]), q_height = normal(t).dot(q - t[0]);
  if (p_height != q_height) {
    const long turned = p_height > q_height ? 1 : -1;
    points.push_back({turned * (p_height * q - q_height * p), turned * (p_height - q_height)});
  } else if (p_height == 0) {
    for (size_t k = 0; k < 3; ++k) add_meeting(p, q, t[k], t[(k + 1) % 3], points);
  }
}

bool lies_on(const Weighted& p, const std::vector<IntegerVector>& shared) {
  if (shared.empty()) return false;
  const IntegerVector from = p.point - p.weight * shared[0];
  return shared.size() == 1 ? from.isZero(0) : from.cross(shared[1] - shared[0]).isZero(0);
}

}  // namespace

Positions IntegerSoup::positions() const {
  Positions result(static_cast<Eigen::Index>(points.size()), 3);
  for (size_t v = 0; v < points.size(); ++v) {
    result.row(static_cast<Eigen::Index>(v)) = points[v].cast<double>().transpose();
  }
  return result;
}

Triangles IntegerSoup::triangles() const {
  Triangles result(size(), 3);
  for (int t = 0; t < size(); ++t) {
    const auto& [a, b, c] = corners[static_cast<size_t>(t)];
    result.row(t) << a, b, c;
  }
  return result;
}

bool IntegerSoup::overlap(int a, int b) const {
  const auto at = [&](int t) {
    Triangle triangle;
    for (size_t k = 0; k < 3; ++k) triangle[k] = points[static_cast<size_t>(corners[static_cast<size_t>(t)][k])];
    return triangle;
  };
  const Triangle first = at(a), second = at(b);
  if (normal(first).isZero(0) || normal(second).isZero(0)) return false;
  std::vector<IntegerVector> shared;
  for (const IntegerVector& p : first) {
    if (std::find(second.begin(), second.end(), p) != second.end()) shared.push_back(p);
  }
  if (shared.size() == 3) return true;
  std::vector<Weighted> candidates;
  for (size_t k = 0; k < 3; ++k) {
    add_candidates(first[k], first[(k + 1) % 3], second, candidates);
    add_candidates(second[k], second[(k + 1) % 3], first, candidates);
  }
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](const Weighted& p) { return lies_in(p, first) && lies_in(p, second) && !lies_on(p, shared); });
}

IntegerSoup integer_soup(unsigned seed) {
  std::mt19937 engine(seed);
  const auto below = [&](int count) { return static_cast<int>(engine() % static_cast<unsigned>(count)); };
  // Every third one is flat.
  const int wide = 3 + below(6), deep = seed % 3 == 0 ? 1 : wide;
  IntegerSoup soup;
  for (int v = 0; v < 40; ++v) soup.points.emplace_back(below(wide), below(wide), below(deep));
  for (int t = 0; t < 40; ++t) soup.corners.push_back({below(40), below(40), below(40)});
  return soup;
}

}  // namespace swage::test
