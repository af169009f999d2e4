// Pictures of a mesh and its edits, side by side.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "swage/compare.h"
#include "swage/render.h"

namespace swage::cli {

struct PictureOptions {
  std::string path;  ///< Empty for no picture.
  std::string heat = "normals";
  std::string view;  ///< X,Y,Z; empty for the automatic one.
  std::string up = "y";
  std::string size = "1600x900";
};

/// --picture and what goes with it.
void add_picture_options(CLI::App& app, PictureOptions& options);

/// Throws WrongUsage where an option is not understood or nothing can be written to the path, and Unavailable where
/// this build makes no pictures.
void check(const PictureOptions& options);

struct PictureEdit {
  const std::string& path;
  const Positions& positions;
  const Comparison& changes;
};

/// The rest with handles and arrows, then the edits with what changed as colours, all on one scale. Throws Interrupted.
Image picture_of(const PictureOptions& options, const std::string& rest_path, const Mesh& rest,
                 const std::vector<PictureEdit>& edits, const std::optional<Gesture>& gesture,
                 const CommonOptions& common);

}  // namespace swage::cli
