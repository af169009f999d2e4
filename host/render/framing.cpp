#include "framing.h"

#include <algorithm>
#include <string>

#include "swage/error.h"

namespace swage {
namespace {

[[noreturn]] void refuse(const char* function, size_t panel, const std::string& why) {
  throw InvalidInput(std::string(function) + ": panel " + std::to_string(panel) + ": " + why);
}

}  // namespace

void check_panel(const Panel& panel, size_t index, const char* function) {
  try {
    check(panel.mesh.positions, panel.mesh.triangles);
  } catch (const InvalidInput& e) {
    refuse(function, index, e.what());
  }
  if (panel.face_values.size() != 0 && panel.face_values.size() != panel.mesh.triangles.rows()) {
    refuse(function, index,
           "face_values: " + std::to_string(panel.face_values.size()) + " numbers of " +
               std::to_string(panel.mesh.triangles.rows()) + " triangles; give one for each");
  }
  for (size_t h = 0; h < panel.handles.size(); ++h) {
    const HandleMark& mark = panel.handles[h];
    if (!mark.from.allFinite() || !mark.to.allFinite()) {
      refuse(function, index, "handle " + std::to_string(h) + " is not at a finite place; mend it");
    }
  }
}

Positions seen_positions(std::span<const Panel> panels, const char* function) {
  std::vector<Eigen::RowVector3d> seen;
  for (const Panel& panel : panels) {
    std::vector<char> is_seen(static_cast<size_t>(panel.mesh.positions.rows()), 0);
    for (const int v : panel.mesh.triangles.reshaped()) is_seen[static_cast<size_t>(v)] = 1;
    for (Eigen::Index v = 0; v < panel.mesh.positions.rows(); ++v) {
      if (is_seen[static_cast<size_t>(v)]) seen.emplace_back(panel.mesh.positions.row(v));
    }
  }
  Positions positions(static_cast<Eigen::Index>(seen.size()), 3);
  for (size_t i = 0; i < seen.size(); ++i) positions.row(static_cast<Eigen::Index>(i)) = seen[i];
  if (box_diagonal(positions) == 0) {
    throw InvalidInput(std::string(function) +
                       ": all vertices of triangles are at one place; there is nothing to draw");
  }
  return positions;
}

Framing framing_of(std::span<const Panel> panels, const View& view, const char* function) {
  const Positions positions = seen_positions(panels, function);
  Framing framing{unit_box(positions), Camera(view, function), {}};
  Eigen::Vector2d low(1e300, 1e300), high = -low;
  const auto include = [&](const Eigen::Vector3d& point) {
    const Eigen::Vector2d at = framing.camera.flat(into(framing.box, point));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  };
  for (const auto& position : positions.rowwise()) include(position.transpose());
  for (const Panel& panel : panels) {
    for (const HandleMark& mark : panel.handles) {
      include(mark.from);
      include(mark.to);
    }
  }
  framing.camera.centre = (low + high) / 2;
  framing.extent = (high - low).cwiseMax(1e-3);
  return framing;
}

double fitting_scale(const Eigen::Vector2d& extent, const PixelBox& box, double margin) {
  const auto room = [&](int size) { return std::max(0.25 * size, size - 2 * margin); };
  return std::min(room(box.width) / extent.x(), room(box.height) / extent.y());
}

Eigen::Vector3d into(const UnitBox& box, const Eigen::Vector3d& point) {
  return (point - box.corner.transpose()) / box.extent;
}

}  // namespace swage
