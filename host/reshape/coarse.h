// Coarse to fine: where a large mesh's passes start.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "decimate.h"
#include "plan.h"

namespace swage {

struct CoarsePlan {
  Proxy proxy;
  std::unique_ptr<Reshape> reshape;  ///< Of the proxy. Solves from several threads.

  std::size_t bytes() const;  ///< Of the proxy's mesh and maps.
};

/// Prepared; or none, and why.
std::unique_ptr<CoarsePlan> coarse_plan(const ReshapePlan& plan, const Curvatures& unit_box_curvatures,
                                        const Poll& poll, std::string& why_none);

/// Of the mesh's triangles, as the gesture on the coarse stand-in has them; identities where it cannot be solved. None
/// where `progress` cancelled.
std::optional<Transforms> coarse_transforms(const CoarsePlan& coarse, const ReshapePlan& plan,
                                            const std::vector<Hold>& holds, const ProgressFn& progress);

}  // namespace swage
