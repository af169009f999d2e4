#include "devices.h"
#include "opencl_steps.h"

namespace swage {

namespace {

class OpenClBackend final : public Backend {
 public:
  OpenClBackend(const FoundDevice& device, Precision precision)
      : facts_(device.facts),
        context_(std::make_shared<Context>(device.handle, precision,
                                           keeps_programs(device.facts) ? ProgramCache() : ProgramCache::of_user())) {}

  std::string name() const override { return "opencl"; }
  std::string device() const override { return facts_.name; }
  Precision precision() const override { return context_->precision(); }
  Traffic traffic() const override { return context_->traffic(); }

  std::unique_ptr<RotationStep> rotation(const PairsRest& rest) const override {
    return opencl_rotation(context_, rest);
  }
  std::unique_ptr<SimilarityStep> similarity(const PairsRest& rest) const override {
    return opencl_similarity(context_, rest);
  }
  std::unique_ptr<TransformStep> transform(std::shared_ptr<const TransformStep::Rest> rest) const override {
    return opencl_transform(context_, *rest);
  }
  std::unique_ptr<CouplingStep> coupling(const TransformStep::Rest& rest) const override {
    return opencl_coupling(context_, rest);
  }
  std::unique_ptr<CurvatureStep> curvature(const CurvatureStep::Rest& rest) const override {
    return opencl_curvature(context_, rest);
  }
  std::unique_ptr<NormalFitStep> normal_fit(const NormalFitStep::Rest& rest) const override {
    return opencl_normal_fit(context_, rest);
  }
  std::unique_ptr<ClosestNormalStep> closest_normal(const Positions& normals) const override {
    return opencl_closest_normal(context_, normals);
  }
  std::unique_ptr<FieldStep> field(const Tape& tape) const override { return opencl_field(context_, tape); }
  std::unique_ptr<LocalMapStep> local_map(const LocalMapStep::Rest& rest) const override {
    return opencl_local_map(context_, rest);
  }
  std::unique_ptr<CarryStep> carry(CarryStep::Rest rest) const override {
    return opencl_carry(context_, std::move(rest));
  }

 private:
  Device facts_;
  SharedContext context_;
};

}  // namespace

std::shared_ptr<Backend> opencl_backend(const std::string& device, Precision precision) {
  return std::make_shared<OpenClBackend>(choose_device(device, precision), precision);
}

}  // namespace swage
