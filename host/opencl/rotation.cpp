// The rotation step on a device.
#include "opencl_steps.h"
#include "pairs.h"

namespace swage {
namespace {

class OpenClRotation final : public RotationStep {
 public:
  OpenClRotation(const Queue& queue, const PairsRest& rest)
      : sums_(queue, rest),
        rotations_(queue, Eigen::Index{sums_.stride()} * 9),
        fit_(queue, "rotation", "fit_rotations") {}

  void fit(const Positions& positions, const Positions& targets, Transforms& rotations) override {
    sums_.gather(positions, targets);
    fit_.launch(sums_.items(), sums_.stride(), sums_.all(), rotations_);
    rotations.resize(sums_.count(), 9);
    rotations_.download_strided(rotations, sums_.stride());
  }

 private:
  PairSums sums_;
  Reals rotations_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<RotationStep> opencl_rotation(const SharedContext& context, const PairsRest& rest) {
  return std::make_unique<OpenClRotation>(Queue(context), rest);
}

}  // namespace swage
