// Elements joined by ties.
#pragma once

#include <vector>

#include "element_list.h"
#include "tie.h"

namespace swage {

/// The ties as edges, of an element at each end. `vertices`: all that ties are of. Weights follow the elements': a tie
/// of mean edge length and weight 1 is as stiff as a mean edge.
void add_ties(const Positions& vertices, const std::vector<Tie>& ties, double mean_edge_length, Elements& elements);

}  // namespace swage
