// The reference steps, a file each.
#pragma once

#include <memory>

#include "swage/steps.h"

namespace swage {

std::unique_ptr<RotationStep> cpu_rotation(const PairsRest& rest);
std::unique_ptr<SimilarityStep> cpu_similarity(const PairsRest& rest);
std::unique_ptr<TransformStep> cpu_transform(std::shared_ptr<const TransformStep::Rest> rest);
std::unique_ptr<CouplingStep> cpu_coupling(const TransformStep::Rest& rest);
std::unique_ptr<CurvatureStep> cpu_curvature(const CurvatureStep::Rest& rest);
std::unique_ptr<NormalFitStep> cpu_normal_fit(const NormalFitStep::Rest& rest);
std::unique_ptr<ClosestNormalStep> cpu_closest_normal(const Positions& normals);
std::unique_ptr<FieldStep> cpu_field(const Tape& tape);
std::unique_ptr<LocalMapStep> cpu_local_map(const LocalMapStep::Rest& rest);
std::unique_ptr<CarryStep> cpu_carry(CarryStep::Rest rest);

}  // namespace swage
