#pragma once

namespace swage {

/// Radians: an angle that equals a limit up to rounding is neither below nor above it.
constexpr double kAngleRounding = 1e-9;

}  // namespace swage
