#include "element_list.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace swage {

void ElementList::add(int i, int j, double weight) {
  if (i != j) open_.push_back({std::min(i, j), std::max(i, j), weight});
}

void ElementList::close() {
  std::sort(open_.begin(), open_.end(),
            [](const auto& a, const auto& b) { return std::tie(a.first, a.second) < std::tie(b.first, b.second); });
  for (size_t i = 0; i < open_.size(); ++i) {
    const bool again = i > 0 && open_[i].first == open_[i - 1].first && open_[i].second == open_[i - 1].second;
    if (again) {
      edges_.back().weight += open_[i].weight;
    } else {
      edges_.push_back(open_[i]);
    }
  }
  open_.clear();
  offsets_.push_back(static_cast<int>(edges_.size()));
}

Elements ElementList::take(const Positions& vertices) {
  Elements elements;
  PairsRest& pairs = elements.pairs;
  pairs.vertices = vertices;
  pairs.offsets = std::exchange(offsets_, {0});
  const auto count = static_cast<Eigen::Index>(edges_.size());
  pairs.pairs.resize(count, 2);
  pairs.weights.resize(count);
  for (Eigen::Index p = 0; p < count; ++p) {
    const WeightedEdge& edge = edges_[static_cast<size_t>(p)];
    pairs.pairs.row(p) << edge.first, edge.second;
    pairs.weights[p] = edge.weight;
  }
  edges_.clear();
  elements.of_vertex = std::exchange(of_vertex_, {});
  return elements;
}

Transforms matrices_of_triangles(const Elements& elements, const Triangles& triangles, const Transforms& matrices) {
  Transforms result = Transforms::Zero(triangles.rows(), 9);
  for (Eigen::Index t = 0; t < result.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      result.row(t) += matrices.row(elements.of_vertex[static_cast<size_t>(triangles(t, k))]) / 3;
    }
  }
  return result;
}

std::size_t bytes(const PairsRest& pairs) {
  const auto edges = static_cast<std::size_t>(pairs.weights.size());
  return pairs.offsets.size() * sizeof(int) + edges * (sizeof(double) + 2 * sizeof(int));
}

double edge_energy(const PairsRest& pairs, const Positions& positions, const Transforms& matrices) {
  Eigen::VectorXd of_element = Eigen::VectorXd::Zero(matrices.rows());
#pragma omp parallel for schedule(static)
  for (Eigen::Index n = 0; n < matrices.rows(); ++n) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> matrix(matrices.row(n).data());
    const auto at = static_cast<size_t>(n);
    for (int p = pairs.offsets[at]; p < pairs.offsets[at + 1]; ++p) {
      const int i = pairs.pairs(p, 0), j = pairs.pairs(p, 1);
      const Eigen::RowVector3d rest = pairs.vertices.row(j) - pairs.vertices.row(i);
      const Eigen::RowVector3d now = positions.row(j) - positions.row(i);
      of_element[n] += pairs.weights[p] * (now - rest * matrix.transpose()).squaredNorm();
    }
  }
  return of_element.sum();
}

}  // namespace swage
