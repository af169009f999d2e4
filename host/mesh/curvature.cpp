#include "swage/curvature.h"

#include <numbers>
#include <string>

#include "measures.h"
#include "messages.h"
#include "neighbourhoods.h"
#include "pieces.h"
#include "swage/error.h"

namespace swage {
namespace {

void check_options(const CurvatureOptions& options) {
  if (!(options.crease_angle >= 0 && options.crease_angle <= std::numbers::pi)) {
    throw InvalidInput("curvature: options.crease_angle: " + digits(options.crease_angle) +
                       " is not an angle between 0 and pi radians");
  }
  if (options.rings < 1) {
    throw InvalidInput("curvature: options.rings: " + std::to_string(options.rings) + " is below 1");
  }
}

Curvatures means_over_triangles(const Pieces& pieces, const Curvatures& at_vertices) {
  const Triangles& triangles = pieces.mesh.triangles;
  Curvatures means(triangles.rows(), 2);
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    Eigen::Array3d weights;
    for (int k = 0; k < 3; ++k) weights[k] = pieces.on_cut[static_cast<size_t>(triangles(t, k))] ? 0 : 1;
    if (weights.sum() == 0) weights.setOnes();
    means.row(t).setZero();
    for (int k = 0; k < 3; ++k) means.row(t) += weights[k] / weights.sum() * at_vertices.row(triangles(t, k));
  }
  return means;
}

}  // namespace

Curvatures curvature(const PositionsRef& positions, const TrianglesRef& triangles, const CurvatureOptions& options,
                     const Backend& backend) {
  check(positions, triangles);
  check_options(options);
  if (box_diagonal(positions) == 0) return Curvatures::Zero(triangles.rows(), 2);
  const UnitBox box = unit_box(positions);
  const Pieces pieces = cut_at_creases(box.into(positions), triangles, options.crease_angle);
  Curvatures at_vertices;
  backend.curvature(neighbourhoods(pieces.mesh, options.rings))->fit(at_vertices);
  return means_over_triangles(pieces, at_vertices) / box.extent;
}

}  // namespace swage
