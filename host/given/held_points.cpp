#include "held_points.h"

#include <algorithm>
#include <string>

#include "block_system.h"
#include "swage/error.h"

namespace swage {
namespace {

// In mean diagonal entries: of a point within a triangle, which is held no other way.
constexpr double kFirm = 1e6;

bool is_vertex(const Hold& hold) { return hold.factors[0] == 1; }

void add_fixed(const std::vector<Hold>& holds, HeldPoints& points) {
  for (const Hold& hold : holds) {
    if (is_vertex(hold)) points.fixed.push_back(hold.vertices[0]);
  }
  std::sort(points.fixed.begin(), points.fixed.end());
  points.fixed.erase(std::unique(points.fixed.begin(), points.fixed.end()), points.fixed.end());
  points.fixed_targets = Positions::Zero(static_cast<Eigen::Index>(points.fixed.size()), 3);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(points.fixed_targets.rows());
  for (const Hold& hold : holds) {
    if (!is_vertex(hold)) continue;
    const auto at = std::lower_bound(points.fixed.begin(), points.fixed.end(), hold.vertices[0]) - points.fixed.begin();
    points.fixed_targets.row(at) += hold.target;
    counts[at] += 1;
  }
  points.fixed_targets.array().colwise() /= counts.array();
}

}  // namespace

HeldPoints held_points(const LaplacianSystem& system, const std::vector<Hold>& holds, std::optional<double> weight) {
  HeldPoints points;
  if (!weight) add_fixed(holds, points);
  points.soft_targets.resize(static_cast<Eigen::Index>(holds.size()), 3);
  for (const Hold& hold : holds) {
    if (!weight && is_vertex(hold)) continue;
    points.soft_targets.row(static_cast<Eigen::Index>(points.soft.size())) = hold.target;
    const double per_share = weight ? *weight : kFirm * system.laplacian().diagonal().mean();
    points.soft.push_back({hold.vertices, hold.factors, hold.share * per_share});
  }
  return points;
}

std::shared_ptr<const HeldLaplacian> held_laplacian(LastHeld& last, const LaplacianSystem& system,
                                                    const HeldPoints& points, const std::optional<Given>& given,
                                                    const char* caller) {
  try {
    return last.get(system, points);
  } catch (const Indefinite& singular) {
    int vertex = singular.element();
    if (given && vertex < static_cast<int>(given->vertices().size())) vertex = given->vertex(vertex);
    throw Unsolvable(std::string(caller) + ": the system is singular near vertex " + std::to_string(vertex) +
                     ": its triangles are too badly shaped, or nothing holds them; remesh, or add a handle there");
  }
}

}  // namespace swage
