// Closest similarities: the closest rotation, then the scale that fits best with it (Umeyama 1991).
#include <algorithm>
#include <cmath>

#include "cpu_steps.h"
#include "procrustes.h"

namespace swage {
namespace {

using Eigen::Matrix3d;

// Weights that cancel leave this part of their terms as rounding.
constexpr double kNoSpread = 1e-12;

class CpuSimilarity final : public SimilarityStep {
 public:
  explicit CpuSimilarity(const PairsRest& rest) : rest_(rest) {}

  void fit(const Positions& positions, const Positions& targets, Transforms& similarities) override {
    check_rows("SimilarityStep::fit", "positions", positions.rows(), rest_.vertices.rows());
    check_rows("SimilarityStep::fit", "targets", targets.rows(), rest_.normals.rows());
    const Eigen::Index count = element_count(rest_);
    similarities.resize(count, 9);
#pragma omp parallel for schedule(static)
    for (Eigen::Index i = 0; i < count; ++i) {
      const Matrix3d edges = edge_covariance(rest_, positions, i);
      const Matrix3d rotation = closest_rotation(edges + normal_covariance(rest_, targets, i));
      store(scale(rotation, edges, i) * rotation, similarities, i);
    }
  }

 private:
  double scale(const Matrix3d& rotation, const Matrix3d& edges, Eigen::Index element) const {
    const auto at = static_cast<size_t>(element);
    double spread = 0, terms = 0;
    for (int p = rest_.offsets[at]; p < rest_.offsets[at + 1]; ++p) {
      const double square =
          (rest_.vertices.row(rest_.pairs(p, 1)) - rest_.vertices.row(rest_.pairs(p, 0))).squaredNorm();
      spread += rest_.weights[p] * square;
      terms += std::abs(rest_.weights[p]) * square;
    }
    if (std::abs(spread) <= kNoSpread * terms) return 1;
    return std::max(0.0, rotation.cwiseProduct(edges).sum() / spread);
  }

  PairsRest rest_;
};

}  // namespace

std::unique_ptr<SimilarityStep> cpu_similarity(const PairsRest& rest) { return std::make_unique<CpuSimilarity>(rest); }

}  // namespace swage
