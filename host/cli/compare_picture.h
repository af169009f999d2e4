// Pictures of a mesh beside its edits, coloured by what changed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "picture.h"
#include "swage/compare.h"

namespace swage::cli {

/// --heat, which goes with --picture.
void add_heat_option(CLI::App& app, std::string& heat, CLI::Option& picture);

struct PictureEdit {
  const std::string& path;
  const Positions& positions;
  const Comparison& changes;
};

/// The rest with handles and arrows, then the edits with what changed as colours, all on one scale. Throws Interrupted.
Image picture_of(const PictureOptions& options, const std::string& heat_name, const std::string& rest_path,
                 const Mesh& rest, const std::vector<PictureEdit>& edits, const std::optional<Gesture>& gesture,
                 const CommonOptions& common);

}  // namespace swage::cli
