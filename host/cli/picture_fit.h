// Rows of panels in a picture, as large as may be.
#pragma once

#include <string>
#include <vector>

#include "options.h"
#include "swage/render.h"

namespace swage::cli {

/// Pixels a mesh unit, about, at which panels that are seen from `options.view` are drawn, and in how many columns.
struct PictureFit {
  int columns = 1;
  double scale = 0;
};

/// Of `rows` rows of such panels: one is broken into several where those are full and the meshes larger.
PictureFit fit(const std::vector<Panel>& panels, size_t rows, const RenderOptions& options);

/// One row as a picture of options.height, several as a sheet of rows as high as they need to be. `columns` are their
/// titles. Views are the rows' or that of the options. Throws Interrupted.
Image drawn_to_fit(std::vector<SheetRow> rows, const std::vector<std::string>& columns, RenderOptions options,
                   const CommonOptions& common);

}  // namespace swage::cli
