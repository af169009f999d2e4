// The two global systems as multigrid takes them: own terms and couplings.
#pragma once

#include "multilevel.h"
#include "plan.h"

namespace swage {

/// The transform step's, whole.
ElementGraph transform_graph(const TransformStep::Rest& rest);

/// The vertex step's: of the sphericity term a bound that couples neighbours alone, edges no stiffer
/// than 100 times the usual, without straight chains.
ElementGraph vertex_graph(const TransformStep::Rest& rest, const TransformStep::EdgeQuadratics& quadratics,
                          const std::vector<Tie>& ties, const std::vector<Holds>& holds);

}  // namespace swage
