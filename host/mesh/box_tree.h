// Boxes in a tree, for those that overlap and those that are near.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>
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

  /// Calls `found(a)` for each box that overlaps or touches another.
  template <class Found>
  void overlaps(const Eigen::AlignedBox3d& other, const Found& found) const;

  /// Calls `nearer(a)` for each box no farther from the point than `most`, near ones early; each call returns what is
  /// the most from then on.
  template <class Nearer>
  void near(const Eigen::Vector3d& point, double most, const Nearer& nearer) const;

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

template <class Found>
void BoxTree::overlaps(const Eigen::AlignedBox3d& other, const Found& found) const {
  std::array<int, 64> waiting{0};
  for (size_t count = 1; count > 0;) {
    const int at = waiting[--count];
    const Node& node = nodes_[static_cast<size_t>(at)];
    if (!node.box.intersects(other)) continue;
    if (node.second >= 0) {
      waiting[count++] = node.second;
      waiting[count++] = at + 1;
      continue;
    }
    for (int i = node.first; i < node.last; ++i) {
      const int a = order_[static_cast<size_t>(i)];
      if (boxes_[static_cast<size_t>(a)].intersects(other)) found(a);
    }
  }
}

template <class Nearer>
void BoxTree::near(const Eigen::Vector3d& point, double most, const Nearer& nearer) const {
  const auto distance = [&](int at) { return nodes_[static_cast<size_t>(at)].box.exteriorDistance(point); };
  std::array<std::pair<double, int>, 64> waiting;
  waiting[0] = {distance(0), 0};
  for (size_t count = 1; count > 0;) {
    const auto [away, at] = waiting[--count];
    if (away > most) continue;
    const Node& node = nodes_[static_cast<size_t>(at)];
    if (node.second >= 0) {
      waiting[count] = {distance(node.second), node.second};
      waiting[count + 1] = {distance(at + 1), at + 1};
      if (waiting[count].first < waiting[count + 1].first) std::swap(waiting[count], waiting[count + 1]);
      count += 2;
      continue;
    }
    for (int i = node.first; i < node.last; ++i) most = nearer(order_[static_cast<size_t>(i)]);
  }
}

}  // namespace swage
