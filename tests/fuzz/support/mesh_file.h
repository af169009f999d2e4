// What every mesh format goes through.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swage/mesh_io.h"

namespace swage::fuzz {

/// Reads the mesh, checks that it is one, and writes it unmoved, moved and in other formats, each of which must be
/// readable and give what was written. Nothing where it is refused.
std::optional<MeshFile> use_mesh(const std::string& extension, std::string_view bytes);

/// A pyramid over a square with two groups: 5 vertices, 6 triangles of 5 polygons.
MeshFile pyramid();

}  // namespace swage::fuzz
