// The few directions that a style's faces have.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "measures.h"
#include "swage/error.h"
#include "swage/style.h"

namespace swage {
namespace {

using Eigen::RowVector3d;

/// Unit vectors farther apart than an angle, in cells of a grid as wide as that: only those of neighbouring cells are
/// compared.
class FarApart {
 public:
  explicit FarApart(double angle)
      : least_cosine_(std::cos(angle)), width_(2.001 * std::sin(std::min(angle, std::numbers::pi) / 2) + 1e-7) {}

  void add(const RowVector3d& unit) {
    const Cell cell = cell_of(unit);
    for (int i = 0; i < 27; ++i) {
      const auto at = cells_.find({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1});
      if (at != cells_.end() && has_near(at->second, unit)) return;
    }
    cells_[cell].push_back(unit);
    all_.push_back(unit);
  }

  const std::vector<RowVector3d>& all() const { return all_; }

 private:
  using Cell = std::array<int, 3>;

  Cell cell_of(const RowVector3d& unit) const {
    const auto number = [&](int k) { return static_cast<int>(std::floor(unit[k] / width_)); };
    return {number(0), number(1), number(2)};
  }

  bool has_near(const std::vector<RowVector3d>& units, const RowVector3d& unit) const {
    return std::any_of(units.begin(), units.end(),
                       [&](const RowVector3d& other) { return other.dot(unit) >= least_cosine_; });
  }

  double least_cosine_, width_;
  std::map<Cell, std::vector<RowVector3d>> cells_;
  std::vector<RowVector3d> all_;
};

}  // namespace

ClosestNormals closest_normals(const Mesh& style, double tolerance) {
  check(style.positions, style.triangles);
  const Positions normals = unit_normals(style.positions, style.triangles);
  FarApart found(tolerance * std::numbers::pi / 180);
  for (const RowVector3d normal : normals.rowwise()) {
    if (!normal.isZero(0)) found.add(normal);
  }
  std::vector<RowVector3d> distinct = found.all();
  if (distinct.empty()) throw InvalidInput("closest_normals: style: no triangle has an area; take another style");
  // Of several that are as near, the first is taken: the authors' program has them in this order.
  std::sort(distinct.begin(), distinct.end(), [](const RowVector3d& a, const RowVector3d& b) {
    return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]);
  });
  ClosestNormals result{Positions(static_cast<Eigen::Index>(distinct.size()), 3)};
  for (size_t i = 0; i < distinct.size(); ++i) result.normals.row(static_cast<Eigen::Index>(i)) = distinct[i];
  return result;
}

}  // namespace swage
