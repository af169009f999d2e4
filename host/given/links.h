// Ties between components by where they are near each other.
#pragma once

#include <vector>

#include "adjacency.h"
#include "cancel.h"
#include "tie.h"

namespace swage {

struct Links {
  std::vector<Tie> ties;
  int contacts = 0;  ///< Of the ties, first, those where components touch or cross.
  int groups = 0;    ///< Of components that hang together by contacts.
};

/// Ties of components where they touch or cross: they stay there.
Links contacts(const Mesh& unit_mesh, const Edges& edges, const Poll& poll);

/// Adds weak ties from groups of components to the nearest others, until all hang together.
void add_links(const Mesh& unit_mesh, const Poll& poll, Links& links);

}  // namespace swage
