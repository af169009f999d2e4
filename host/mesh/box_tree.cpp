#include "box_tree.h"

#include <algorithm>
#include <numeric>

namespace swage {
namespace {

constexpr int kLeafSize = 6;

}  // namespace

BoxTree::BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes) : boxes_(boxes), order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  if (!boxes.empty()) split(0, static_cast<int>(boxes.size()));
}

void BoxTree::split(int first, int last) {
  const auto begin = order_.begin();
  const auto sum = [&](int i) -> Eigen::Vector3d {
    const Eigen::AlignedBox3d& box = boxes_[static_cast<size_t>(i)];
    return box.min() + box.max();
  };
  Eigen::AlignedBox3d box, sums;
  for (auto i = begin + first; i != begin + last; ++i) {
    box.extend(boxes_[static_cast<size_t>(*i)]);
    sums.extend(sum(*i));
  }
  const size_t at = nodes_.size();
  nodes_.push_back({box, first, last});
  if (last - first <= kLeafSize) {
    leaves_.push_back(static_cast<int>(at));
    return;
  }
  Eigen::Index axis = 0;
  sums.sizes().maxCoeff(&axis);
  const int middle = first + (last - first) / 2;
  std::nth_element(begin + first, begin + middle, begin + last,
                   [&](int a, int b) { return sum(a)[axis] < sum(b)[axis]; });
  split(first, middle);
  nodes_[at].second = static_cast<int>(nodes_.size());
  split(middle, last);
}

}  // namespace swage
