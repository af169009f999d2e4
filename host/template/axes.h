// The axes x, y, z as 0, 1, 2.
#pragma once

#include <cstddef>

namespace swage {

inline int next(int axis) { return (axis + 1) % 3; }
inline std::size_t at(int axis) { return static_cast<std::size_t>(axis); }

}  // namespace swage
