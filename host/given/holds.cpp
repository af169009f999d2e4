#include "holds.h"

namespace swage {

Eigen::RowVector3d Hold::point(const Positions& positions) const {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (size_t k = 0; k < 3; ++k) sum += factors[static_cast<Eigen::Index>(k)] * positions.row(vertices[k]);
  return sum;
}

int Hold::vertex() const {
  Eigen::Index most = 0;
  factors.maxCoeff(&most);
  return vertices[static_cast<size_t>(most)];
}

std::vector<Hold> holds_of(const Gesture& gesture) {
  std::vector<Hold> holds;
  for (const auto& [vertex, target] : gesture.targets) holds.push_back(Hold::at(vertex, target.transpose()));
  return holds;
}

std::vector<Hold> in_box(std::vector<Hold> holds, const UnitBox& box) {
  for (Hold& hold : holds) hold.target = (hold.target - box.corner) / box.extent;
  return holds;
}

}  // namespace swage
