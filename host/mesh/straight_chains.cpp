#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

#include "adjacency.h"
#include "angle_rounding.h"
#include "curve_sides.h"
#include "measures.h"
#include "messages.h"
#include "straight_runs.h"
#include "swage/error.h"
#include "swage/features.h"

namespace swage {
namespace {

// Where more edges than this meet is a hub, at which each edge has others nearly opposite.
constexpr int kMostAtJunction = 100;

void check_options(const StraightOptions& options) {
  const auto refuse_unless = [](double value, double most, const char* name, const char* range) {
    if (value >= 0 && value <= most) return;
    throw InvalidInput(std::string("straight_chains: options.") + name + ": " + digits(value) + " is not " + range);
  };
  refuse_unless(options.feature_angle, std::numbers::pi, "feature_angle", "an angle between 0 and pi radians");
  refuse_unless(options.turn, std::numbers::pi / 2, "turn", "an angle between 0 and pi / 2 radians");
  refuse_unless(options.deviation, 1, "deviation", "between 0 and 1 lengths of a chain");
  refuse_unless(options.shortest, 1, "shortest", "between 0 and 1 box diagonals");
}

/// Feature edges joined into lines that turn little at each vertex.
class Lines {
 public:
  Lines(const PositionsRef& positions, const FeatureEdges& edges, double turn)
      : positions_(positions), edges_(edges), turn_(turn) {
    const auto count = static_cast<size_t>(edges.rows());
    next_.assign(count, {-1, -1});
    met_.assign(count, 0);
    std::vector<std::pair<int, int>> pairs;
    pairs.reserve(2 * count);
    for (int e = 0; e < edges.rows(); ++e) {
      for (int end : {0, 1}) pairs.emplace_back(edges(e, end), e);
    }
    const Lists at = lists_from(static_cast<int>(positions.rows()), pairs);
    for (int v = 0; v < at.size(); ++v) join(v, at[v]);
  }

  /// Each as the vertices along it: open ones first, each from its lower end, then closed ones, which begin and end
  /// where they turn most.
  std::vector<std::vector<int>> all() {
    std::vector<std::vector<int>> lines;
    for (int e = 0; e < edges_.rows(); ++e) {
      for (int end : {0, 1}) {
        if (!is_met(e) && next(e, edges_(e, end)) < 0) lines.push_back(walk(e, edges_(e, end)));
      }
    }
    for (int e = 0; e < edges_.rows(); ++e) {
      if (!is_met(e)) lines.push_back(begun_at_largest_turn(walk(e, edges_(e, 0))));
    }
    for (std::vector<int>& line : lines) {
      if (line.back() < line.front()) std::reverse(line.begin(), line.end());
    }
    return lines;
  }

 private:
  bool is_met(int edge) const { return met_[static_cast<size_t>(edge)] != 0; }
  int other_end(int edge, int vertex) const { return edges_(edge, 0) == vertex ? edges_(edge, 1) : edges_(edge, 0); }
  int& next(int edge, int vertex) { return next_[static_cast<size_t>(edge)][edges_(edge, 0) == vertex ? 0 : 1]; }

  /// Of the edges that meet at a vertex, the straightest pairs first.
  void join(int vertex, const Lists::Range& edges) {
    if (edges.size() > kMostAtJunction) return;
    std::vector<std::tuple<double, int, int>> pairs;
    for (int i = 0; i < edges.size(); ++i) {
      for (int j = 0; j < i; ++j) {
        const double turn = turn_at(positions_, other_end(edges[j], vertex), vertex, other_end(edges[i], vertex));
        if (turn <= turn_ + kAngleRounding) pairs.emplace_back(turn, edges[j], edges[i]);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [turn, a, b] : pairs) {
      if (next(a, vertex) >= 0 || next(b, vertex) >= 0) continue;
      next(a, vertex) = b;
      next(b, vertex) = a;
    }
  }

  /// From a vertex along an edge, to where the line ends or comes back.
  std::vector<int> walk(int edge, int vertex) {
    std::vector<int> line{vertex};
    while (edge >= 0 && std::exchange(met_[static_cast<size_t>(edge)], 1) == 0) {
      vertex = other_end(edge, vertex);
      line.push_back(vertex);
      edge = next(edge, vertex);
    }
    return line;
  }

  std::vector<int> begun_at_largest_turn(std::vector<int> loop) const {
    loop.pop_back();
    const size_t count = loop.size();
    std::pair<double, int> largest{-1, 0};
    size_t begin = 0;
    for (size_t i = 0; i < count; ++i) {
      const double turn = turn_at(positions_, loop[(i + count - 1) % count], loop[i], loop[(i + 1) % count]);
      if (std::pair(turn, -loop[i]) > largest) std::tie(largest, begin) = std::pair(std::pair(turn, -loop[i]), i);
    }
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(begin), loop.end());
    loop.push_back(loop.front());
    return loop;
  }

  const PositionsRef& positions_;
  const FeatureEdges& edges_;
  double turn_;
  std::vector<std::array<int, 2>> next_;  ///< The edge by which a line goes on at an edge's two ends, -1 for none.
  std::vector<char> met_;
};

std::vector<std::vector<int>> runs_of_lines(const PositionsRef& positions, const std::vector<std::vector<int>>& lines,
                                            double deviation, double shortest) {
  std::vector<std::vector<int>> runs;
  for (const std::vector<int>& line : lines) {
    for (const auto& [first, last] : straight_runs(positions(line, Eigen::all), deviation, shortest)) {
      runs.emplace_back(line.begin() + first, line.begin() + last + 1);
    }
  }
  return runs;
}

}  // namespace

std::vector<std::vector<int>> straight_chains(const PositionsRef& positions, const TrianglesRef& triangles,
                                              const StraightOptions& options) {
  check_options(options);
  const FeatureEdges edges = feature_edges(positions, triangles, options.feature_angle);
  const double shortest = options.shortest * box_diagonal(positions);
  const std::vector<std::vector<int>> lines = Lines(positions, edges, options.turn).all();
  // Sides of a curve are told by those alike beside them, of half the length at least.
  std::vector<std::vector<int>> runs = runs_of_lines(positions, lines, options.deviation, shortest / 2);
  const std::vector<bool> is_side = are_sides_of_curves(positions, runs);
  std::vector<std::vector<int>> chains;
  for (size_t r = 0; r < runs.size(); ++r) {
    const double length = (positions.row(runs[r].back()) - positions.row(runs[r].front())).norm();
    if (runs[r].size() >= 3 && length >= shortest && !is_side[r]) chains.push_back(std::move(runs[r]));
  }
  std::sort(chains.begin(), chains.end());
  return chains;
}

}  // namespace swage
