// Badly shaped meshes are solved by a remeshed stand-in, whose edit is carried back (paper section 5.1).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plan.h"
#include "swage/transfer.h"

namespace swage {

struct StandIn {
  std::unique_ptr<ReshapePlan> plan;
  Mesh mesh;                ///< As remeshed.
  Attachments attachments;  ///< Of the vertices of the mesh that it stands for.
};

/// Prepared. None where the mesh needs none, or none can be had, and why.
std::shared_ptr<StandIn> stand_in_for(const ReshapePlan& plan, const ProgressFn& progress, std::string& told);

/// Solves the plan's stand-in, and carries the edit back to the mesh.
ReshapeResult solve_stand_in(const ReshapePlan& plan, const Mesh& mesh, const std::vector<Hold>& holds,
                             const ReshapeResult* start, const ProgressFn& progress);

}  // namespace swage
