// The colours of a picture, sRGB in [0, 1].
#pragma once

#include <Eigen/Core>

namespace swage {

using Colour = Eigen::Vector3f;

namespace palette {

inline const Colour kPaper(1, 1, 1);
inline const Colour kSurface(0.80F, 0.825F, 0.855F);
inline const Colour kUnknown(0.58F, 0.58F, 0.58F);
inline const Colour kLine(0.13F, 0.15F, 0.19F);
inline const Colour kText(0.10F, 0.11F, 0.13F);
inline const Colour kFaintText(0.36F, 0.38F, 0.42F);
inline const Colour kHeld(0.84F, 0.13F, 0.16F);
inline const Colour kMoved(0.96F, 0.52F, 0.05F);

}  // namespace palette
}  // namespace swage
