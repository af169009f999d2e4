#include "picture_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <utility>

#include "picture.h"

namespace swage::cli {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTitles = 80.0 / 1600;  // Of the picture's width: what is above the meshes of a row.
constexpr int kLeastRow = 100;           // Pixels.

/// Of the largest panel, to the right and upwards.
Vector2d extent_of(const std::vector<Panel>& panels, const View& view) {
  const Vector3d across = view.up.cross(view.from);
  const Vector3d right = across.norm() > 0 ? across.normalized() : view.from.unitOrthogonal();
  const Vector3d up = view.from.cross(right).normalized();
  Vector2d extent = Vector2d::Constant(std::numeric_limits<double>::min());  // A line may be seen from its end.
  for (const Panel& panel : panels) {
    const Eigen::VectorXd x = panel.mesh.positions * right, y = panel.mesh.positions * up;
    extent = extent.cwiseMax(Vector2d(x.maxCoeff() - x.minCoeff(), y.maxCoeff() - y.minCoeff()));
  }
  return extent;
}

/// No higher than the panels need at their columns' width.
int row_height(const std::vector<Panel>& panels, const RenderOptions& options) {
  const Vector2d extent = extent_of(panels, *options.view);
  const double width = options.width / static_cast<double>(panels.size());
  const double height = width * extent.y() / extent.x() + kTitles * options.width;
  return static_cast<int>(std::clamp(height, static_cast<double>(std::min(kLeastRow, options.height)),
                                     static_cast<double>(options.height)));
}

}  // namespace

PictureFit fit(const std::vector<Panel>& panels, size_t rows, const RenderOptions& options) {
  const Vector2d extent = extent_of(panels, *options.view);
  const size_t count = panels.size();
  PictureFit best;
  for (size_t columns = 1; columns <= count; ++columns) {
    if (count % columns != 0 || (rows > 1 && columns < count)) continue;
    const size_t lines = count / columns;
    const double width = options.width / static_cast<double>(columns);
    const double height = options.height / static_cast<double>(lines);
    const double below_titles = std::max(height - kTitles * options.width, height / 2);
    const double scale = std::min(width / extent.x(), below_titles / extent.y());
    if (scale > best.scale) best = {static_cast<int>(columns), scale};
  }
  return best;
}

Image drawn_to_fit(std::vector<SheetRow> rows, const std::vector<std::string>& columns, RenderOptions options,
                   const CommonOptions& common) {
  if (rows.size() == 1) {
    std::vector<Panel>& panels = rows.front().panels;
    for (size_t p = 0; p < panels.size(); ++p) panels[p].title = columns[p];
    if (rows.front().view) options.view = rows.front().view;
    options.columns = fit(panels, 1, options).columns;
    return drawn(panels, options, common);
  }
  int height = 0;
  for (const SheetRow& row : rows) {
    RenderOptions own = options;
    if (row.view) own.view = row.view;
    height = std::max(height, row_height(row.panels, own));
  }
  options.height = height;
  return drawn(rows, columns, options, common);
}

}  // namespace swage::cli
