#include "refined.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace swage::test {
namespace {

using Middles = std::map<std::pair<int, int>, int>;  // Of each side's ends, the lower first.

/// The last child of triangle t has the middles of sides 01, 12 and 20 as corners.
Middles middles(const Triangles& coarse, const Triangles& fine) {
  Middles middles;
  for (int t = 0; t < coarse.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      middles[std::minmax({coarse(t, k), coarse(t, (k + 1) % 3)})] = fine(4 * t + 3, k);
    }
  }
  return middles;
}

std::vector<int> refined(const std::vector<int>& chain, const Middles& middles) {
  std::vector<int> fine;
  for (const int vertex : chain) {
    if (!fine.empty()) fine.push_back(middles.at(std::minmax({fine.back(), vertex})));
    fine.push_back(vertex);
  }
  return fine;
}

Curvatures refined(const Curvatures& curvatures) {
  Curvatures fine(4 * curvatures.rows(), 2);
  for (Eigen::Index t = 0; t < curvatures.rows(); ++t) fine.middleRows<4>(4 * t).rowwise() = curvatures.row(t);
  return fine;
}

}  // namespace

ReshapeOptions refined(ReshapeOptions options, const Triangles& coarse, const Triangles& fine) {
  if (options.unit_box_curvatures) options.unit_box_curvatures = refined(*options.unit_box_curvatures);
  if (options.straight_chains.empty()) return options;
  const Middles of_sides = middles(coarse, fine);
  for (std::vector<int>& chain : options.straight_chains) chain = refined(chain, of_sides);
  return options;
}

}  // namespace swage::test
