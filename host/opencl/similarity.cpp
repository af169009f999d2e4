// The similarity step on a device.
#include <cmath>

#include "opencl_steps.h"
#include "pairs.h"

namespace swage {
namespace {

// Weights that cancel leave this part of their terms as rounding.
constexpr double kNoSpread = 1e-12;

/// 1 / sum_p w_p |a_p|², or 0 where the sum vanishes.
Eigen::VectorXd inverse_spreads(const PairsRest& rest) {
  const PairScales scales(rest);
  Eigen::VectorXd inverses = Eigen::VectorXd::Zero(elements_of(rest));
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
      : pairs_(queue, rest, "similarity"),
        inverse_spreads_(queue, pairs_.elements().tiles(inverse_spreads(rest))),
        fit_(queue, "similarity", "fit_similarities") {}

  void fit(const Positions& positions, const Positions& targets, Transforms& similarities) override {
    pairs_.fit("SimilarityStep::fit", fit_, positions, targets, similarities, inverse_spreads_);
  }

 private:
  Pairs pairs_;
  Reals inverse_spreads_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<SimilarityStep> opencl_similarity(const SharedContext& context, const PairsRest& rest) {
  return std::make_unique<OpenClSimilarity>(Queue(context), rest);
}

}  // namespace swage
