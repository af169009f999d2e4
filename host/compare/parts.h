// The parts of a comparison.
#pragma once

#include "swage/compare.h"

namespace swage {

/// All but slippage_loss.
FaceChanges face_changes(const Positions& rest, const Positions& edit, const Triangles& triangles);

/// FaceChanges::slippage_loss.
Eigen::VectorXd slippage_losses(const Positions& rest, const Positions& edit, const Triangles& triangles,
                                double crease_angle);

std::vector<RoundPart> round_parts(const Positions& rest, const Positions& edit, const Triangles& triangles,
                                   double crease_angle);

}  // namespace swage
