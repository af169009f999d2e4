// The rotation step on a device.
#include "opencl_steps.h"
#include "pairs.h"

namespace swage {
namespace {

class OpenClRotation final : public RotationStep {
 public:
  OpenClRotation(const Queue& queue, const PairsRest& rest)
      : pairs_(queue, rest, "rotation"), fit_(queue, "rotation", "fit_rotations") {}

  void fit(const Positions& positions, const Positions& targets, Transforms& rotations) override {
    pairs_.fit("RotationStep::fit", fit_, positions, targets, rotations);
  }

 private:
  Pairs pairs_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<RotationStep> opencl_rotation(const SharedContext& context, const PairsRest& rest) {
  return std::make_unique<OpenClRotation>(Queue(context), rest);
}

}  // namespace swage
