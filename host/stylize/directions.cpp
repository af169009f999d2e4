#include "directions.h"

#include <limits>

namespace swage {
namespace {

constexpr Eigen::Index kFew = 64;  // Compared one by one sooner than by a tree.

}  // namespace

Positions normalised(Positions rows) {
#pragma omp parallel for schedule(static)
  for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i).stableNormalize();
  return rows;
}

Directions::Directions(const Positions& directions) : units_(normalised(directions)) {
  if (units_.rows() <= kFew) return;
  for (const auto& unit : units_.rowwise()) boxes_.emplace_back(Eigen::Vector3d(unit.transpose()));
  tree_.emplace(boxes_);
}

int Directions::nearest(const Eigen::Vector3d& unit) const {
  if (!tree_) return nearest_of_few(unit);
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  tree_->near(unit, least, [&](int i) {
    const double distance = (units_.row(i).transpose() - unit).norm();
    if (distance < least || (distance == least && i < best)) {
      least = distance;
      best = i;
    }
    return least;
  });
  return best;
}

int Directions::nearest_of_few(const Eigen::Vector3d& unit) const {
  Eigen::Index best = 0;
  (units_ * unit).maxCoeff(&best);
  return static_cast<int>(best);
}

}  // namespace swage
