// The local_map step on a device.
#include <Eigen/SVD>
#include <cmath>

#include "opencl_steps.h"
#include "pairs.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;

constexpr double kStraight = 1e-9;  // Across a line whose edges spread less than this part, nothing is told.

Matrix3d across(const Eigen::RowVector3d& normal) { return Matrix3d::Identity() - normal.transpose() * normal; }

/// `rest` with weights of normals, which pairs ask for.
PairsRest with_normal_weights(PairsRest rest) {
  rest.normal_weights = Eigen::VectorXd::Zero(rest.normals.rows());
  return rest;
}

/// P sum_p w_p a_p a_pᵀ P
Matrix3d spread_of(const PairsRest& pairs, Index i) {
  const auto at = static_cast<size_t>(i);
  Matrix3d spread = Matrix3d::Zero();
  for (int p = pairs.offsets[at]; p < pairs.offsets[at + 1]; ++p) {
    const Eigen::RowVector3d a = pairs.vertices.row(pairs.pairs(p, 1)) - pairs.vertices.row(pairs.pairs(p, 0));
    spread += pairs.weights[p] * a.transpose() * a;
  }
  const Matrix3d plane = across(pairs.normals.row(i));
  return plane * spread * plane;
}

double unit_of(const PairScales& scales) { return scales.per_weight * scales.per_length * scales.per_length; }

/// What holds normals to those given; 0 where they are those.
Eigen::VectorXd guides(const LocalMapStep::Rest& rest, const PairScales& scales) {
  Eigen::VectorXd guides = Eigen::VectorXd::Zero(elements_of(rest.pairs));
  if (!std::isfinite(rest.guidance)) return guides;
  for (Index i = 0; i < guides.size(); ++i) {
    guides[i] = unit_of(scales) * rest.guidance * spread_of(rest.pairs, i).trace();
  }
  return guides;
}

/// (P (sum_p w_p a_p a_pᵀ + sum_j w_j I) P)⁺ as xx, xy, xz, yy, yz, zz, in the device's units; without neighbours where
/// they are not `smoothed`.
Eigen::Matrix<double, Eigen::Dynamic, 6> inverse_spreads(const LocalMapStep::Rest& rest, const PairScales& scales,
                                                         bool smoothed) {
  const PairsRest& pairs = rest.pairs;
  Eigen::Matrix<double, Eigen::Dynamic, 6> inverses(elements_of(pairs), 6);
#pragma omp parallel for schedule(static)
  for (Index i = 0; i < inverses.rows(); ++i) {
    const auto at = static_cast<size_t>(i);
    const Matrix3d plane = across(pairs.normals.row(i));
    Matrix3d spread = spread_of(pairs, i);
    if (smoothed && !rest.neighbours.empty()) {
      for (int k = rest.offsets[at]; k < rest.offsets[at + 1]; ++k) spread += rest.smoothing[k] * plane;
    }
    Eigen::JacobiSVD<Matrix3d> solver(unit_of(scales) * spread, Eigen::ComputeFullU | Eigen::ComputeFullV);
    solver.setThreshold(kStraight);
    const Matrix3d inverse = solver.solve(plane);
    inverses.row(i) << inverse(0, 0), inverse(0, 1), inverse(0, 2), inverse(1, 1), inverse(1, 2), inverse(2, 2);
  }
  return inverses;
}

class OpenClLocalMap final : public LocalMapStep {
 public:
  OpenClLocalMap(const Queue& queue, const Rest& rest)
      : OpenClLocalMap(queue, rest, PairScales(with_normal_weights(rest.pairs))) {}

  void fit(const Positions& positions, const Positions& normals, Transforms& maps) override {
    if (smooths_) check_rows("LocalMapStep::fit", "maps", maps.rows(), count_);
    const Transforms last = smooths_ ? maps : Transforms();
    const Visit visit(queue_, {&last_});
    if (smooths_) last_.show(last);
    if (turns_) {
      pairs_.fit_rows("LocalMapStep::fit", turn_, positions, normals, turned_, turned_rows_, unsmoothed_, rest_normals_,
                      guides_);
    }
    pairs_.fit("LocalMapStep::fit", fit_, positions, turns_ ? turned_ : normals, maps, inverses_, rest_normals_,
               smooths_ ? 1 : 0, neighbour_offsets_, neighbours_, smoothing_, last_);
  }

 private:
  OpenClLocalMap(const Queue& queue, const Rest& rest, const PairScales& scales)
      : queue_(queue),
        count_(elements_of(rest.pairs)),
        smooths_(!rest.neighbours.empty()),
        turns_(std::isfinite(rest.guidance)),
        turned_(turns_ ? count_ : 0, 3),
        pairs_(queue, with_normal_weights(rest.pairs), "local_map"),
        inverses_(queue, pairs_.elements().tiles(inverse_spreads(rest, scales, true))),
        unsmoothed_(queue, pairs_.elements().tiles(inverse_spreads(rest, scales, false))),
        rest_normals_(queue, rest.pairs.normals, Layout::rows),
        neighbour_offsets_(queue, rest.offsets),
        neighbours_(queue, rest.neighbours),
        smoothing_(queue, Eigen::VectorXd(unit_of(scales) * rest.smoothing)),
        guides_(queue, pairs_.elements().tiles(guides(rest, scales))),
        turned_rows_(queue, turned_.size()),
        last_(queue, rest.neighbours.empty() ? 0 : Index{9} * count_),
        turn_(queue, "local_map", "turn_normals"),
        fit_(queue, "local_map", "fit_maps") {}

  Queue queue_;
  Index count_;
  bool smooths_, turns_;
  Positions turned_;
  Pairs pairs_;
  Reals inverses_, unsmoothed_, rest_normals_;
  Ints neighbour_offsets_, neighbours_;
  Reals smoothing_, guides_;
  HostRows turned_rows_, last_;
  Kernel turn_, fit_;
};

}  // namespace

std::unique_ptr<LocalMapStep> opencl_local_map(const SharedContext& context, const LocalMapStep::Rest& rest) {
  return std::make_unique<OpenClLocalMap>(Queue(context), rest);
}

}  // namespace swage
