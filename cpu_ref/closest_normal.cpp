// The closest of a few normals by comparing all, of many by a k-d tree.
#include <cmath>
#include <limits>
#include <nanoflann.hpp>
#include <optional>

#include "cpu_steps.h"

namespace swage {
namespace {

constexpr Eigen::Index kFew = 64;

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Positions, 3, nanoflann::metric_L2_Simple>;

/// What a search finds: of several equally near the first.
struct First {
  Tree::IndexType number = 0;
  double squared_distance = std::numeric_limits<double>::infinity();

  // nanoflann's names. It asks for what is nearer than the worst.
  bool addPoint(double squared, Tree::IndexType other) {
    if (squared < squared_distance || (squared == squared_distance && other < number)) {
      squared_distance = squared;
      number = other;
    }
    return true;
  }
  double worstDist() const { return std::nextafter(squared_distance, std::numeric_limits<double>::infinity()); }
  bool full() const { return std::isfinite(squared_distance); }
};

class CpuClosestNormal final : public ClosestNormalStep {
 public:
  explicit CpuClosestNormal(const Positions& normals) : normals_(normals) {
    if (normals_.rows() > kFew) tree_.emplace(3, std::cref(normals_));
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
    Eigen::Index best = 0;
    (normals_ * unit.transpose()).maxCoeff(&best);
    return static_cast<int>(best);
  }

  int by_tree(const Eigen::RowVector3d& unit) const {
    First first;
    tree_->index->findNeighbors(first, unit.data(), nanoflann::SearchParams());
    return static_cast<int>(first.number);
  }

  Positions normals_;
  std::optional<Tree> tree_;
};

}  // namespace

std::unique_ptr<ClosestNormalStep> cpu_closest_normal(const Positions& normals) {
  return std::make_unique<CpuClosestNormal>(normals);
}

}  // namespace swage
