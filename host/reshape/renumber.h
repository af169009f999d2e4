// Large meshes are solved in an order that is near in memory where it is near on the surface: a pass at 1.3 million
// triangles takes half the time.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "numbering.h"
#include "swage/reshape.h"

namespace swage {

/// Between what a caller gives and gets and what is solved.
class Renumbered {
 public:
  Renumbered(Mesh given, const Edges& edges);

  const Mesh& given() const { return given_; }
  Mesh mesh() const { return in_order(given_, numbering_); }
  ReshapeOptions into(ReshapeOptions options) const;
  Gesture into(const Gesture& gesture) const;
  /// What a solve reads of its start.
  ReshapeResult into(const ReshapeResult& start) const;
  ReshapeResult back(ReshapeResult result) const;
  int vertex(int place) const { return numbering_.vertices[static_cast<size_t>(place)]; }
  int triangle(int place) const { return numbering_.triangles[static_cast<size_t>(place)]; }

 private:
  Mesh given_;
  Numbering numbering_;
  std::vector<int> place_of_vertex_;
};

}  // namespace swage
