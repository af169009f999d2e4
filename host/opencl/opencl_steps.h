// The steps that run on a device, a file each.
#pragma once

#include <memory>

#include "context.h"
#include "swage/steps.h"

namespace swage {

using SharedContext = std::shared_ptr<Context>;

std::unique_ptr<RotationStep> opencl_rotation(const SharedContext& context, const PairsRest& rest);
std::unique_ptr<SimilarityStep> opencl_similarity(const SharedContext& context, const PairsRest& rest);
std::unique_ptr<TransformStep> opencl_transform(const SharedContext& context, const TransformStep::Rest& rest);
std::unique_ptr<CouplingStep> opencl_coupling(const SharedContext& context, const TransformStep::Rest& rest);
std::unique_ptr<CurvatureStep> opencl_curvature(const SharedContext& context, const CurvatureStep::Rest& rest);
std::unique_ptr<NormalFitStep> opencl_normal_fit(const SharedContext& context, const NormalFitStep::Rest& rest);
std::unique_ptr<ClosestNormalStep> opencl_closest_normal(const SharedContext& context, const Positions& normals);
std::unique_ptr<FieldStep> opencl_field(const SharedContext& context, const Tape& tape);
std::unique_ptr<LocalMapStep> opencl_local_map(const SharedContext& context, const LocalMapStep::Rest& rest);
std::unique_ptr<CarryStep> opencl_carry(const SharedContext& context, CarryStep::Rest rest);

}  // namespace swage
