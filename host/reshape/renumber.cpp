#include "renumber.h"

namespace swage {

Renumbered::Renumbered(Mesh given, const Edges& edges)
    : given_(std::move(given)),
      numbering_(by_neighbourhood(given_, edges)),
      place_of_vertex_(inverse(numbering_.vertices)) {}

ReshapeOptions Renumbered::into(ReshapeOptions options) const {
  if (options.unit_box_curvatures) {
    options.unit_box_curvatures = Curvatures((*options.unit_box_curvatures)(numbering_.triangles, Eigen::all));
  }
  for (std::vector<int>& chain : options.straight_chains) {
    for (int& vertex : chain) vertex = place_of_vertex_[static_cast<size_t>(vertex)];
  }
  return options;
}

Gesture Renumbered::into(const Gesture& gesture) const {
  Gesture result{gesture.label, {}};
  for (const auto& [vertex, target] : gesture.targets) {
    result.targets.emplace(place_of_vertex_[static_cast<size_t>(vertex)], target);
  }
  return result;
}

ReshapeResult Renumbered::into(const ReshapeResult& start) const {
  ReshapeResult result;
  result.unfinished = start.unfinished(numbering_.vertices, Eigen::all);
  result.transforms = start.transforms(numbering_.triangles, Eigen::all);
  return result;
}

ReshapeResult Renumbered::back(ReshapeResult result) const {
  const auto restore = [](const std::vector<int>& numbers, auto& rows) {
    auto given = rows;
    given(numbers, Eigen::all) = rows;
    rows = std::move(given);
  };
  restore(numbering_.vertices, result.positions);
  restore(numbering_.vertices, result.unfinished);
  restore(numbering_.triangles, result.transforms);
  return result;
}

}  // namespace swage
