#include "fit_picture.h"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "changes.h"
#include "measures.h"
#include "swage/steps.h"
#include "template_surface.h"

namespace swage::cli {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastSlope = 1e-9;  // Of the field: below it there is no direction and no distance.
constexpr double kLeastPercent = 1;   // Of the colour bar.

Positions middles(const Mesh& mesh) {
  Positions points(mesh.triangles.rows(), 3);
  for (Index t = 0; t < points.rows(); ++t) {
    points.row(t) = mesh.positions(mesh.triangles.row(t), Eigen::all).colwise().mean();
  }
  return points;
}

/// Radians, of lines: 0 to a right angle.
double line_angle(const Eigen::RowVector3d& a, const Eigen::RowVector3d& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

Mesh both(const Mesh& a, const Mesh& b) {
  Mesh all{Positions(a.positions.rows() + b.positions.rows(), 3),
           Triangles(a.triangles.rows() + b.triangles.rows(), 3)};
  all.positions << a.positions, b.positions;
  all.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.positions.rows())).matrix();
  return all;
}

}  // namespace

FitMiss miss_of(const Template& of, const TemplateFit& fit, const Mesh& mesh, const Backend& backend) {
  FieldValues field;
  of.field(backend)->evaluate(fit.pose.into(middles(mesh)), fit.parameters, FieldDerivatives::in_space, field);
  const Positions areas = area_vectors(mesh.positions, mesh.triangles);
  const Positions slopes = field.gradients * fit.pose.rotation;
  VectorXd angles(areas.rows()), weights = areas.rowwise().norm();
  FitMiss miss{VectorXd(areas.rows()), {}};
  for (Index t = 0; t < areas.rows(); ++t) {
    const double slope = slopes.row(t).norm();
    miss.off[t] = std::abs(field.values[t]) / std::max(slope, kLeastSlope);
    angles[t] = line_angle(areas.row(t), slopes.row(t));
    if (slope < kLeastSlope) weights[t] = 0;
  }
  miss.off /= fit.pose.scale * box_diagonal(mesh.positions);
  miss.angle = spread(angles, weights);
  return miss;
}

Image picture_of_fit(const PictureOptions& options, const ShownFit& shown, const CommonOptions& common) {
  const Index count = shown.mesh.triangles.rows();
  const Mesh together = both(shown.mesh, shown.surface);
  const auto grey = [](Index triangles) {
    return VectorXd::Constant(triangles, std::numeric_limits<double>::quiet_NaN());
  };
  VectorXd off = grey(together.triangles.rows());
  off.head(count) = 100 * shown.miss.off;
  RenderOptions render = render_options_of(options, up_of(shown.of, shown.fit.pose));
  render.heat_map = {0, rounded_up(std::max(kLeastPercent, 200 * shown.fit.residual)), "distance, % of the diagonal"};
  const std::string name = std::filesystem::path(shown.path).stem().string();
  return drawn({{shown.mesh, name, {}, grey(count), {}},
                {shown.surface, shown.of.name(), {}, grey(shown.surface.triangles.rows()), {}},
                {together,
                 "both",
                 {},
                 off,
                 fmt::format("off by {:.2f} %, at most {:.1f} %", 100 * shown.fit.residual, 100 * shown.fit.largest)}},
               render, common);
}

}  // namespace swage::cli
