#include "surface_view.h"

#include "swage/thrown.h"
#include "tile.h"

namespace swage {
namespace {

constexpr int kTile = 96;
constexpr int kTilesATime = 64;

/// The pixels of the view in which the surface may be.
PixelBox reached_box(const SurfaceView& view) {
  Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
  for (const auto& position : view.scene.mesh.positions.rowwise()) {
    const Eigen::Vector2d at = view.camera.project(position.transpose());
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  const auto pixel = [](double at, double middle, int size) {
    return std::clamp(static_cast<int>(std::floor(std::clamp(at + middle, -1e6, 1e6))), 0, size);
  };
  const double middle_x = view.box.width / 2.0, middle_y = view.box.height / 2.0;
  const int x = pixel(low.x() - 1, middle_x, view.box.width), y = pixel(low.y() - 1, middle_y, view.box.height);
  return {x, y, pixel(high.x() + 2, middle_x, view.box.width) - x, pixel(high.y() + 2, middle_y, view.box.height) - y};
}

std::vector<PixelBox> tiles_of(const PixelBox& box) {
  std::vector<PixelBox> tiles;
  for (int y = box.y; y < box.y + box.height; y += kTile) {
    for (int x = box.x; x < box.x + box.width; x += kTile) {
      tiles.push_back({x, y, std::min(kTile, box.x + box.width - x), std::min(kTile, box.y + box.height - y)});
    }
  }
  return tiles;
}

}  // namespace

Ray SurfaceView::ray_at(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d off = pixel - Eigen::Vector2d(box.width / 2.0, box.height / 2.0);
  const Eigen::Vector3d origin = camera.unproject(off) + kEyeDistance * camera.toward;
  return {origin.cast<float>(), -camera.toward.cast<float>(), 2 * kEyeDistance};
}

bool draw_surface(Image& image, const SurfaceView& view, long& covered, const Watch& watch) {
  covered = 0;
  if (!view.scene.rays) return true;
  const Ambience ambience(view.ambient_rays);
  const std::vector<PixelBox> tiles = tiles_of(reached_box(view));
  const auto count = static_cast<int>(tiles.size());
  for (int first = 0; first < count; first += kTilesATime) {
    if (!watch.goes_on("surface", double(first) / count)) return false;
    Thrown thrown;
#pragma omp parallel for schedule(dynamic) reduction(+ : covered)
    for (int t = first; t < std::min(count, first + kTilesATime); ++t) {
      thrown.keep([&] {
        Tile tile(view, tiles[static_cast<size_t>(t)]);
        if (tile.is_empty()) return;
        tile.find_ambience(ambience);
        covered += tile.paint(image);
      });
    }
    thrown.rethrow();
  }
  return true;
}

}  // namespace swage
