// The same small mesh in every format and variant that is read, written here without the library's writers.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "swage/mesh.h"
#include "swage/mesh_io.h"

namespace swage::test {

struct Sample {
  std::string name;  ///< Of the file, its extension telling the format.
  std::function<std::string(const Positions&)> bytes;
  bool is_single = false;  ///< Coordinates are float32.
};

/// A pyramid over a square: a quad and four triangles.
Positions pyramid();
/// The pyramid turned and moved to where no coordinate is round.
Positions moved_pyramid();

/// Without normals: their bytes are a function of the positions alone.
std::vector<Sample> samples();

/// The shortest decimal that reads back as x.
std::string decimal(double x);
std::string little_float(double x);

/// Reads a file of that name with these bytes.
MeshFile read_bytes(const std::string& name, const std::string& bytes);
/// The bytes that writing `file` with these positions in its own format gives.
std::string written(const MeshFile& file, const Positions& positions);
/// The message of the UnreadableFile that reading gives; fails the test and is empty where it gives none.
std::string refusal(const std::string& name, const std::string& bytes);

}  // namespace swage::test
