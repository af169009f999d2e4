// Makes a shape of boxes: its normals become those of a few directions everywhere, and its details dissolve.
//
// Liu, Jacobson: Normal-Driven Spherical Shape Analogies. Computer Graphics Forum 40(5), 2021, section 5.1.
#pragma once

#include <memory>
#include <numbers>

#include "swage/backend.h"
#include "swage/handles.h"
#include "swage/mesh.h"
#include "swage/report.h"
#include "swage/style.h"
#include "swage/stylize.h"

#pragma GCC visibility push(default)
namespace swage {

struct PolycubeOptions {
  double lambda = 10;                               ///< Above 0: how much normals count against the shape in each pass.
  int pass_limit = 50;                              ///< At least 1.
  double energy_drop = 5e-5;                        ///< At least 0: passes end that lower the energy by less.
  double least_angle = std::numbers::pi * 2 / 180;  ///< Radians, [0, pi/6]: no pass but the first leaves a triangle an
                                                    ///< angle below that is smaller than before.
  std::shared_ptr<Backend> backend;                 ///< Does the local steps; cpu_backend() where none is given.
};

/// Stylizes by triangles (StylizeEnergy::farap, StylizeWeights::clamped) to the closest of the style's normals, which
/// are looked up again after every step (style.dynamic is not asked), pass after pass, each with the last one's shape
/// at rest: nothing draws details back. After each pass but the first, what would thin out or turn over a triangle is
/// held back, and vertices of triangles of angles below 10 degrees move a little towards the mean of their neighbours,
/// along what the targets around leave free. A cube's six normals make a PolyCube, prism(6)'s a hexagonal box.
///
/// The report's energy is the mean over the area of |n - t|², n a triangle's normal and t its target (no unit). Passes
/// end where it falls by less than asked, or does not fall, and then the pass before is returned. Handles are met
/// exactly; components without any keep their centre and the mean square distance of their area from it. The result's
/// `passes` are the terms of each against its own rest shape.
///
/// Throws InvalidInput where an option is out of its range or Stylize does, and Unsolvable where it does.
StylizeResult polycube(const PositionsRef& positions, const TrianglesRef& triangles,
                       const ClosestNormals& style = closest_normals(style_shape(StyleShape::cube)),
                       const PolycubeOptions& options = {}, const Gesture& handles = {},
                       const ProgressFn& progress = {});

}  // namespace swage
#pragma GCC visibility pop
