#include "swage/backend.h"

#include "cpu_steps.h"

namespace swage {

namespace {

class CpuBackend final : public Backend {
 public:
  std::string name() const override { return "cpu"; }
  std::string device() const override { return "host"; }
  std::unique_ptr<RotationStep> rotation(const PairsRest& rest) const override { return cpu_rotation(rest); }
  std::unique_ptr<SimilarityStep> similarity(const PairsRest& rest) const override { return cpu_similarity(rest); }
  std::unique_ptr<TransformStep> transform(std::shared_ptr<const TransformStep::Rest> rest) const override {
    return cpu_transform(std::move(rest));
  }
  std::unique_ptr<CouplingStep> coupling(const TransformStep::Rest& rest) const override { return cpu_coupling(rest); }
  std::unique_ptr<CurvatureStep> curvature(const CurvatureStep::Rest& rest) const override {
    return cpu_curvature(rest);
  }
  std::unique_ptr<NormalFitStep> normal_fit(const NormalFitStep::Rest& rest) const override {
    return cpu_normal_fit(rest);
  }
  std::unique_ptr<ClosestNormalStep> closest_normal(const Positions& normals) const override {
    return cpu_closest_normal(normals);
  }
  std::unique_ptr<FieldStep> field(const Tape& tape) const override { return cpu_field(tape); }
  std::unique_ptr<LocalMapStep> local_map(const LocalMapStep::Rest& rest) const override { return cpu_local_map(rest); }
  std::unique_ptr<CarryStep> carry(CarryStep::Rest rest) const override { return cpu_carry(std::move(rest)); }
};

}  // namespace

std::shared_ptr<Backend> cpu_backend() { return std::make_shared<CpuBackend>(); }

}  // namespace swage
