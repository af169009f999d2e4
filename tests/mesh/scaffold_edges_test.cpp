#include "scaffold_edges.h"

#include <gtest/gtest.h>

namespace swage {
namespace {

using EdgeList = std::vector<std::array<int, 2>>;

TEST(ScaffoldEdges, JoinDifferentComponentsOnceEach) {
  // 0 and 1 are one component, 2 and 3 another; 4 and 5 are a box corner and a Steiner point.
  const Tetrahedra tetrahedra{{3, 0, 4, 1}, {0, 1, 2, 3}, {5, 4, 3, 0}};
  EXPECT_EQ(scaffold_edges(tetrahedra, {0, 0, 1, 1}),
            (EdgeList{{0, 2}, {0, 3}, {0, 4}, {0, 5}, {1, 2}, {1, 3}, {1, 4}, {3, 4}, {3, 5}}));
}

TEST(ScaffoldEdges, NoneWhereAllIsOneComponent) {
  EXPECT_EQ(scaffold_edges(Tetrahedra{{0, 1, 2, 3}}, {7, 7, 7, 7}), EdgeList());
  EXPECT_EQ(scaffold_edges(Tetrahedra{{0, 1, 2, 3}}, {}), EdgeList());
  EXPECT_EQ(scaffold_edges(Tetrahedra(0, 4), {0}), EdgeList());
}

}  // namespace
}  // namespace swage
