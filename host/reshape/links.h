// Components that no triangle joins, joined all the same (paper section 5.1 does so by a scaffold; where none can be
// had, by links between nearest points).
#pragma once

#include <vector>

#include "adjacency.h"
#include "cancel.h"
#include "plan.h"

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

/// The paper's: a scaffold in the unit box, and a tie for each edge of it between components.
struct ScaffoldTies {
  Scaffold scaffold;
  std::vector<Tie> ties;
};

/// None where the options have none, or none can be had, and why.
std::optional<ScaffoldTies> scaffold_ties(const ReshapeOptions& options, const Mesh& unit_mesh,
                                          const std::vector<int>& component, int contacts, const Poll& poll,
                                          std::string& why_not);

}  // namespace swage
