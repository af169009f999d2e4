// The closest of a few normals by comparing all, of many by a k-d tree.
#define NANOFLANN_FIRST_MATCH  // Of several equally near the first.
#include <nanoflann.hpp>
#include <optional>

#include "cpu_steps.h"

namespace swage {
namespace {

constexpr Eigen::Index kFew = 64;

using Tree = nanoflann::KDTreeEigenMatrixAdaptor<Positions, 3, nanoflann::metric_L2_Simple>;

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
    Tree::IndexType best = 0;
    double squared_distance = 0;
    tree_->query(unit.data(), 1, &best, &squared_distance);
    return static_cast<int>(best);
  }

  Positions normals_;
  std::optional<Tree> tree_;
};

}  // namespace

std::unique_ptr<ClosestNormalStep> cpu_closest_normal(const Positions& normals) {
  return std::make_unique<CpuClosestNormal>(normals);
}

}  // namespace swage
