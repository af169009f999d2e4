// The similarity step on a device.
#include <cmath>

#include "opencl_steps.h"
#include "pairs.h"

namespace swage {
namespace {

// Weights that cancel leave this part of their terms as rounding.
constexpr double kNoSpread = 1e-12;

/// 1 / sum_p w_p |a_p|², or 0 where the sum vanishes, and to fill up `size`.
Eigen::VectorXd inverse_spreads(const PairsRest& rest, Eigen::Index size) {
  const PairScales scales(rest);
  Eigen::VectorXd inverses = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < elements_of(rest); ++i) {
    const auto at = static_cast<size_t>(i);
    double spread = 0, terms = 0;
    for (int p = rest.offsets[at]; p < rest.offsets[at + 1]; ++p) {
      const Eigen::RowVector3d edge = rest.vertices.row(rest.pairs(p, 1)) - rest.vertices.row(rest.pairs(p, 0));
      const double term = scales.per_weight * rest.weights[p] * (edge * scales.per_length).squaredNorm();
      spread += term;
      terms += std::abs(term);
    }
    inverses[i] = std::abs(spread) <= kNoSpread * terms ? 0 : 1 / spread;
  }
  return inverses;
}

class OpenClSimilarity final : public SimilarityStep {
 public:
  OpenClSimilarity(const Queue& queue, const PairsRest& rest)
      : sums_(queue, rest),
        inverse_spreads_(queue, inverse_spreads(rest, sums_.stride())),
        similarities_(queue, Eigen::Index{sums_.stride()} * 9),
        fit_(queue, "similarity", "fit_similarities") {}

  void fit(const Positions& positions, const Positions& targets, Transforms& similarities) override {
    sums_.gather(positions, targets);
    fit_.launch(sums_.items(), sums_.stride(), sums_.all(), sums_.edges(), inverse_spreads_, similarities_);
    similarities.resize(sums_.count(), 9);
    similarities_.download_strided(similarities, sums_.stride());
  }

 private:
  PairSums sums_;
  Reals inverse_spreads_, similarities_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<SimilarityStep> opencl_similarity(const SharedContext& context, const PairsRest& rest) {
  return std::make_unique<OpenClSimilarity>(Queue(context), rest);
}

}  // namespace swage
