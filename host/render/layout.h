// Where on a sheet everything is.
#pragma once

#include <string>
#include <vector>

#include "camera.h"

namespace swage {

struct Writing {
  std::string text;
  Eigen::Vector2d at;  ///< On the baseline: its left end or, where centred, its middle.
  double size, room;
  bool is_centred, is_faint;
};

struct Layout {
  int width = 0, height = 0;
  double unit = 1;                            ///< Pixels of what is one pixel wide in a picture of 1600 × 900.
  std::vector<std::vector<PixelBox>> panels;  ///< By group: where meshes are drawn.
  std::vector<Writing> writings;
  PixelBox footer;  ///< For the colour bar and the legend; no height where there is none.
};

/// Panels that share a camera.
struct GroupShape {
  const std::vector<Panel>& panels;
  std::string title;
  Eigen::Vector2d extent;  ///< Of what a panel shows, in the scene.
};

/// One group that fills the picture, in a grid.
Layout grid_layout(const GroupShape& group, const RenderOptions& options, bool has_footer);

/// A group a row.
Layout rows_layout(const std::vector<GroupShape>& groups, const std::vector<std::string>& columns,
                   const RenderOptions& options, bool has_footer);

}  // namespace swage
