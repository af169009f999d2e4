// Creases and boundaries, where nothing hides them.
#pragma once

#include "surface_view.h"

namespace swage {

/// Draws the scene's lines, paler where they are so dense that they would hide the surface: `covered` of its pixels are
/// seen. False where `watch` says to stop.
bool draw_lines(Image& image, const SurfaceView& view, long covered, double width, const Watch& watch);

}  // namespace swage
