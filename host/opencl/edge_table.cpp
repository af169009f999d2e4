#include "edge_table.h"

#include <map>
#include <vector>

namespace swage {
namespace {

using Eigen::Index;

class Maker {
 public:
  explicit Maker(const TransformStep::Rest& rest)
      : rest_(rest), paired_(static_cast<size_t>(rest.edges.rows()), false) {
    list_triangles();
    start_rest();
    place_pairs();
    list_crowded();
  }

  EdgeTable table;

 private:
  void list_triangles() {
    const Index triangles = rest_.triangles.rows();
    table.beside.setConstant(rest_.edges.rows(), 2, -1);
    table.first_corners.resize(rest_.edges.rows());
    table.of_triangles.resize(triangles, 12);
    Eigen::VectorXd uses = Eigen::VectorXd::Zero(rest_.edges.rows());
    for (int t = 0; t < triangles; ++t) {
      for (int k = 0; k < 3; ++k) {
        const int e = rest_.triangle_edges(t, k);
        const double along = rest_.edges(e, 0) == rest_.triangles(t, k) ? 1 : -1;
        table.of_triangles.row(t).segment<3>(3 * k) = along * rest_.edge_vectors.row(e);
        if (table.beside(e, 0) < 0) table.first_corners[e] = 3 * t + k;
        place(t, e);
        ++uses[e];
      }
    }
    for (Index t = 0; t < triangles; ++t) {
      for (int k = 0; k < 3; ++k) table.of_triangles(t, 9 + k) = 1 / uses[rest_.triangle_edges(t, k)];
    }
  }

  void place(int t, int e) {
    auto beside = table.beside.row(e);
    if (beside[0] < 0) {
      beside.setConstant(t);
    } else if (beside[1] == beside[0] && t != beside[0]) {
      beside[1] = t;
    } else {
      more_[e].push_back(t);
    }
  }

  void start_rest() {
    table.rest.setZero(rest_.edges.rows(), 8);
    table.rest.leftCols<3>() = rest_.edge_vectors;
    if (rest_.target_lengths.size() != 0) table.rest.col(7) = rest_.target_lengths;
  }

  void place_pairs() {
    std::vector<Index> left;
    for (Index p = 0; p < rest_.pairs.rows(); ++p) {
      const int e = rest_.pair_edges[p], t = rest_.pairs(p, 0), s = rest_.pairs(p, 1);
      const auto beside = table.beside.row(e);
      const bool its = t != s && (beside[0] == t || beside[0] == s) && (beside[1] == t || beside[1] == s);
      if (!its || more_.count(e) > 0 || paired_[static_cast<size_t>(e)]) {
        left.push_back(p);
        continue;
      }
      paired_[static_cast<size_t>(e)] = true;
      tell_pair(p, table.rest.row(e));
    }
    table.pairs = rest_.pairs(left, Eigen::all);
    table.pair_rest.resize(table.pairs.rows(), 8);
    for (Index i = 0; i < table.pairs.rows(); ++i) {
      const Index p = left[static_cast<size_t>(i)];
      table.pair_rest.row(i) = table.rest.row(rest_.pair_edges[p]);
      tell_pair(p, table.pair_rest.row(i));
    }
  }

  void tell_pair(Index pair, EdgeTable::Rest::RowXpr row) const {
    row.segment<4>(3) << rest_.pair_opposites.row(pair), rest_.pair_similarities[pair];
  }

  void list_crowded() {
    table.offsets = {0};
    for (int e = 0; e < table.beside.rows(); ++e) {
      auto beside = table.beside.row(e);
      if (beside[0] == beside[1] ? more_.count(e) == 0 : paired_[static_cast<size_t>(e)]) continue;
      table.crowded.push_back(e);
      table.triangles.push_back(beside[0]);
      if (beside[1] != beside[0]) table.triangles.push_back(beside[1]);
      table.triangles.insert(table.triangles.end(), more_[e].begin(), more_[e].end());
      table.offsets.push_back(static_cast<int>(table.triangles.size()));
      beside[1] = beside[0];
    }
  }

  const TransformStep::Rest& rest_;
  std::map<int, std::vector<int>> more_;  // Triangles after the second at an edge.
  std::vector<char> paired_;              // Whether `beside` tells of the edge's pair.
};

}  // namespace

EdgeTable edge_table(const TransformStep::Rest& rest) { return Maker(rest).table; }

}  // namespace swage
