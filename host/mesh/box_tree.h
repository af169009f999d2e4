// Boxes in a tree, for those that overlap.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace swage {

/// Halves by the median of the middles along the longest axis, down to a few boxes a leaf.
class BoxTree {
 public:
  /// Borrows the boxes.
  explicit BoxTree(const std::vector<Eigen::AlignedBox3d>& boxes);

  int leaf_count() const { return static_cast<int>(leaves_.size()); }

  /// Calls `found(a, b)`, a < b, for each two boxes that overlap or touch, of which one lies in the leaf and the other
  /// in it or a later one, until it says no. All leaves together name each two boxes once.
  template <class Found>
  void overlaps(int leaf, const Found& found) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    int first, last;  ///< Of `order_`.
    int second = -1;  ///< Its second child; the first one is the next node. A leaf has none.
  };

  void split(int first, int last);

  const std::vector<Eigen::AlignedBox3d>& boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;  ///< Each before its children.
  std::vector<int> leaves_;  ///< Their nodes, in the order of `order_`.
};

template <class Found>
void BoxTree::overlaps(int leaf, const Found& found) const {
  const Node& own = nodes_[static_cast<size_t>(leaves_[static_cast<size_t>(leaf)])];
  const auto box = [&](int i) -> const Eigen::AlignedBox3d& { return boxes_[static_cast<size_t>(i)]; };
  std::array<int, 64> waiting{0};  // Halving a number of 31 bits ends before.
  for (size_t count = 1; count > 0;) {
    const int at = waiting[--count];
    const Node& node = nodes_[static_cast<size_t>(at)];
    if (node.last <= own.first || !node.box.intersects(own.box)) continue;
    if (node.second >= 0) {
      waiting[count++] = node.second;
      waiting[count++] = at + 1;
      continue;
    }
    for (int i = own.first; i < own.last; ++i) {
      const int a = order_[static_cast<size_t>(i)];
      for (int j = std::max(node.first, i + 1); j < node.last; ++j) {
        const int b = order_[static_cast<size_t>(j)];
        if (box(a).intersects(box(b)) && !found(std::min(a, b), std::max(a, b))) return;
      }
    }
  }
}

}  // namespace swage
