// What a PLY file says it holds.
#pragma once

#include <string>
#include <vector>

#include "input.h"

namespace swage {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

size_t size_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< Of a list.
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties;
  size_t offset = 0;  ///< Of its line in the header.
};

struct PlyHeader {
  enum class Encoding { ascii, little_endian, big_endian } encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  size_t end = 0;  ///< Where the body begins.
};

PlyHeader read_ply_header(Input& input);

}  // namespace swage
