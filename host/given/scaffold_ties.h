// Ties between components by a scaffold (paper section 5.1, "Multi-Component Models").
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cancel.h"
#include "swage/scaffold.h"
#include "swage/when.h"
#include "tie.h"

namespace swage {

/// A scaffold in the unit box, and a tie for each edge of it between components.
struct ScaffoldTies {
  Scaffold scaffold;
  std::vector<Tie> ties;
};

/// None where it is not wanted, automatically where components have contacts, or none can be had; and why.
/// Throws where it is wanted always, and cannot be had.
std::optional<ScaffoldTies> scaffold_ties(When when, const Mesh& unit_mesh, const std::vector<int>& component,
                                          int contacts, const Poll& poll, std::string& why_not);

}  // namespace swage
