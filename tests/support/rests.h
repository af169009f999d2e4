// Rest shapes that the steps of reshaping are tested on.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "swage/mesh.h"
#include "swage/reshape.h"

namespace swage::test {

/// As reshaping has it, with the solver's own weights. Curvatures of 2 make every triangle round, of 0 none.
TransformStep::Rest rest_of(const Mesh& mesh, double curvatures = 2, ReshapeSolver solver = ReshapeSolver::published);

/// Closed, with the steady solver's weights, with boundary, flat, needles, crowded edges, one triangle, none, tiny and
/// huge, with a name each.
std::vector<std::pair<std::string, TransformStep::Rest>> rest_families();

}  // namespace swage::test
