// Soups of triangles with small integer coordinates, whose overlaps are found in integers.
#pragma once

#include <array>
#include <vector>

#include "swage/mesh.h"

namespace swage::test {

using IntegerVector = Eigen::Matrix<long, 3, 1>;

struct IntegerSoup {
  std::vector<IntegerVector> points;
  std::vector<std::array<int, 3>> corners;

  int size() const { return static_cast<int>(corners.size()); }
  Positions positions() const;
  Triangles triangles() const;

  /// Whether the two have a point in common that is not of the vertex or edge they share, by looking at every point
  /// where the outline of what they have in common can have a corner. False where one has no area.
  bool overlap(int a, int b) const;
};

/// Crowded: many touch, lie in one plane, share vertices, repeat each other or have no area.
IntegerSoup integer_soup(unsigned seed);

}  // namespace swage::test
