#include "scaffold_ties.h"

#include "scaffold_edges.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kEdgeWeight = 1e-2;   // The paper's w_edge.
constexpr double kAloneWeight = 1e-6;  // Of a point that no such edge holds.

Tie edge_tie(const Positions& positions, int i, int j) {
  const Eigen::RowVector3d vector = positions.row(i) - positions.row(j);
  const double length = vector.norm();
  return {{{i, 1 / length}, {j, -1 / length}}, vector / length, kEdgeWeight};
}

std::vector<Tie> ties_of(const Scaffold& scaffold, const std::vector<int>& component) {
  std::vector<Tie> ties;
  std::vector<char> is_held(static_cast<size_t>(scaffold.positions.rows()), 0);
  for (const auto& [i, j] : scaffold_edges(scaffold.tetrahedra, component)) {
    ties.push_back(edge_tie(scaffold.positions, i, j));
    is_held[static_cast<size_t>(i)] = is_held[static_cast<size_t>(j)] = 1;
  }
  for (size_t v = component.size(); v < is_held.size(); ++v) {
    const auto point = static_cast<int>(v);
    if (is_held[v] == 0) ties.push_back({{{point, 1}}, scaffold.positions.row(point), kAloneWeight});
  }
  return ties;
}

}  // namespace

std::optional<ScaffoldTies> scaffold_ties(When when, const Mesh& unit_mesh, const std::vector<int>& component,
                                          int contacts, const Poll& poll, std::string& why_not) {
  const bool must = when == When::always;
  if (when == When::never) {
    why_not = "not wanted";
    return std::nullopt;
  }
  if (contacts > 0 && !must) {
    why_not = "components touch or cross";
    return std::nullopt;
  }
  ScaffoldOptions asked;
  asked.leave_out_crossing = must;
  asked.time_limit = must ? 600 : 20;
  const ProgressFn progress = [&](const Progress&) {
    ask(poll);
    return true;
  };
  try {
    ScaffoldTies result{scaffold(unit_mesh.positions, unit_mesh.triangles, asked, progress), {}};
    result.ties = ties_of(result.scaffold, component);
    return result;
  } catch (const Unavailable& why) {
    if (must) throw;
    why_not = why.what();
  } catch (const Unsolvable& why) {
    if (must) throw;
    why_not = why.what();
  }
  return std::nullopt;
}

}  // namespace swage
