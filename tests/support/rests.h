// Rest shapes that the steps of reshaping are tested on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage::test {

/// As reshaping has it, with its default weights. Curvatures of 2 make every triangle round, of 0 none.
TransformStep::Rest rest_of(const Mesh& mesh, double curvatures = 2);

/// Closed, with boundary, flat, needles, crowded edges, one triangle, none, tiny and huge, with a name each.
std::vector<std::pair<std::string, TransformStep::Rest>> rest_families();

}  // namespace swage::test
