// Components that no triangle joins, joined all the same: held together where they touch or cross, else by a scaffold
// or by links between nearest points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjacency.h"
#include "cancel.h"
#include "swage/scaffold.h"
#include "swage/when.h"
#include "tie.h"

namespace swage {

struct Joined {
  std::vector<Tie> ties;
  std::optional<Scaffold> scaffold;  ///< In the unit box. Ties may be of its own points too.
  std::string told = "one";          ///< What was done, and why.
};

Joined join_components(const Mesh& unit_mesh, const Edges& edges, When scaffold, const Poll& poll);

}  // namespace swage
