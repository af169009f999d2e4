// The closest of a few normals by comparing all, of many by a k-d tree.
#include <cmath>
#include <cstddef>
#include <limits>
#include <nanoflann.hpp>
#include <optional>

#include "cpu_steps.h"

namespace swage {
namespace {

constexpr Eigen::Index kFew = 64;

/// Normals as nanoflann asks for them, by its names.
struct Points {
  Positions rows;

  size_t kdtree_get_point_count() const { return static_cast<size_t>(rows.rows()); }
  double kdtree_get_pt(int i, size_t axis) const { return rows(i, static_cast<Eigen::Index>(axis)); }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3, int>;

/// What a search finds: of several equally near the first.
struct First {
  int number = 0;
  double squared_distance = std::numeric_limits<double>::infinity();

  // NOLINTBEGIN(readability-identifier-naming): nanoflann's names. It asks for what is nearer than the worst.
  bool addPoint(double squared, int other) {
    if (squared < squared_distance || (squared == squared_distance && other < number)) {
      squared_distance = squared;
      number = other;
    }
    return true;
  }
  double worstDist() const { return std::nextafter(squared_distance, std::numeric_limits<double>::infinity()); }
  bool full() const { return std::isfinite(squared_distance); }
  // NOLINTEND(readability-identifier-naming)
};

class CpuClosestNormal final : public ClosestNormalStep {
 public:
  explicit CpuClosestNormal(const Positions& normals) : normals_{normals} {
    if (normals.rows() > kFew) tree_.emplace(3, normals_);
  }

  void find(const Positions& units, Eigen::VectorXi& closest) override {
    closest.resize(units.rows());
#pragma omp parallel for schedule(static)
    for (Eigen::Index n = 0; n < units.rows(); ++n) {
      if (units.row(n).isZero(0)) {
        closest[n] = 0;
      } else {
        closest[n] = tree_ ? by_tree(units.row(n)) : of_few(units.row(n));
      }
    }
  }

 private:
  int of_few(const Eigen::RowVector3d& unit) const {
    int best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (int m = 0; m < normals_.rows.rows(); ++m) {
      const double cosine = normals_.rows.row(m).dot(unit);
      if (cosine <= most) continue;
      most = cosine;
      best = m;
    }
    return best;
  }

  int by_tree(const Eigen::RowVector3d& unit) const {
    First first;
    tree_->findNeighbors(first, unit.data(), nanoflann::SearchParams());
    return first.number;
  }

  Points normals_;
  std::optional<Tree> tree_;
};

}  // namespace

std::unique_ptr<ClosestNormalStep> cpu_closest_normal(const Positions& normals) {
  return std::make_unique<CpuClosestNormal>(normals);
}

}  // namespace swage
