// From the command line to a style.
#pragma once

#include <string>
#include <vector>

#include "stylize.h"
#include "swage/style.h"

namespace swage::cli {

/// The presets in words, for help and errors.
std::string preset_names();

/// Throws WrongUsage where the name is neither a preset nor a mesh file's.
void check_style_name(const std::string& name);

/// A preset or the mesh in a file. Throws UnreadableFile.
Mesh style_mesh(const std::string& name);

/// "closest", "sphere", "capture", "normals", "normal-map", "developable" or "polycube".
std::string method_of(const StylizeJob& job);

/// What the style is of, in a few words: a preset, or a file's name without folder and extension.
std::string style_title(const StylizeJob& job);

/// Warns of styles that will not do much. Throws as what reads and makes styles does.
Style style_of(const StylizeJob& job, const MeshFile& file, std::vector<std::string>& warnings);

}  // namespace swage::cli
