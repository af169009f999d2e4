// What is still turned over in the end.
#include <algorithm>
#include <array>
#include <iomanip>
#include <sstream>

#include "block_system.h"
#include "edit_plan.h"
#include "matrices.h"

namespace swage {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr std::array kRings{1, 2, 4, 8};
constexpr double kFace = 0.05;   // Part of its area, then or now, that a triangle is turned back to,
constexpr int kRounds = 5;       // for those turned over, with those beside them, as often,
constexpr int kSweeps = 100;     // in as many sweeps each.
constexpr double kAside = 0.01;  // Of D: no vertex goes farther for this.

/// All but those `inside`.
HeldPoints outside(const std::vector<char>& inside) {
  HeldPoints held;
  for (size_t v = 0; v < inside.size(); ++v) {
    if (inside[v] == 0) held.fixed.push_back(static_cast<int>(v));
  }
  return held;
}

/// The maps of what is not held become harmonic, and place it. False where nothing holds a part of it.
bool place_among(const EditPlan& plan, HeldPoints& held, Positions& positions, Transforms& maps) {
  try {
    const HeldLaplacian about(plan.system, held);
    const Positions none = Positions::Zero(positions.rows(), 3);
    for (int column = 0; column < 9; column += 3) {
      held.fixed_targets = maps(held.fixed, Eigen::seqN(column, 3));
      maps.middleCols<3>(column) = about.solve(none, held);
    }
    held.fixed_targets = positions(held.fixed, Eigen::all);
    positions = about.solve(plan.system.right_hand_sides(maps), held);
    return true;
  } catch (const Indefinite&) {
    return false;
  }
}

/// Where a triangle faced, and what its area along that is to be.
struct Facing {
  Eigen::RowVector3i corners;
  Vector3d normal;
  double least;
};

double area_along(const Facing& facing, const Positions& at) {
  const Vector3d a = at.row(facing.corners[0]), b = at.row(facing.corners[1]), c = at.row(facing.corners[2]);
  return facing.normal.dot((b - a).cross(c - a));
}

/// Of the triangles that share a corner with those turned over.
std::vector<Facing> facings(const EditPlan& plan, const std::vector<int>& over) {
  const Triangles& triangles = plan.unsplit.triangles;
  std::vector<char> reached(static_cast<size_t>(plan.unsplit.vertices), 0);
  for (const int t : over) {
    for (const int v : triangles.row(t)) reached[static_cast<size_t>(v)] = 1;
  }
  const Positions areas = faced(plan, triangles), areas_now = area_vectors(plan.positions, triangles);
  std::vector<Facing> found;
  for (Index t = 0; t < triangles.rows(); ++t) {
    const auto is_reached = [&](int v) { return reached[static_cast<size_t>(v)] != 0; };
    const Eigen::RowVector3i corners = triangles.row(t);
    const double area = areas.row(t).norm();
    if (area == 0 || std::none_of(corners.begin(), corners.end(), is_reached)) continue;
    Facing facing{corners, areas.row(t).transpose() / area, kFace * std::max(area, areas_now.row(t).norm())};
    const double now = area_along(facing, plan.positions);
    if (now >= 0) facing.least = std::min(facing.least, now);
    found.push_back(facing);
  }
  return found;
}

/// Each that has not its least area gets it by moving its corners, by the least sum of squares, one after another.
void turn_back(const std::vector<Facing>& facings, Positions& positions) {
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    bool all = true;
    for (const Facing& facing : facings) {
      const double lack = facing.least - area_along(facing, positions);
      if (lack <= 1e-3 * facing.least) continue;
      all = false;
      std::array<Vector3d, 3> slopes;
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        const Vector3d side = positions.row(facing.corners[(k + 2) % 3]) - positions.row(facing.corners[(k + 1) % 3]);
        slopes[static_cast<size_t>(k)] = facing.normal.cross(side);
        sum += slopes[static_cast<size_t>(k)].squaredNorm();
      }
      if (sum == 0) continue;
      for (int k = 0; k < 3; ++k) positions.row(facing.corners[k]) += lack / sum * slopes[static_cast<size_t>(k)];
    }
    if (all) return;
  }
}

/// Places those turned over, and as few rings around them as help, by what is around those alone.
void heal_folds(EditPlan& plan) {
  std::vector<int> over = flipped(plan, plan.mesh.triangles, plan.is_flat);
  for (const int rings : kRings) {
    const std::vector<char> inside = around(plan, over, rings);
    HeldPoints held = outside(inside);
    if (over.empty() || held.fixed.empty()) return;
    Positions positions = plan.positions;
    Transforms maps = plan.maps;
    if (!place_among(plan, held, positions, maps)) return;
    std::swap(positions, plan.positions);
    std::swap(maps, plan.maps);
    std::vector<int> left = flipped(plan, plan.mesh.triangles, plan.is_flat);
    if (left.size() < over.size()) {
      let_go(plan, inside);
      over = std::move(left);
    } else {
      plan.positions = std::move(positions);
      plan.maps = std::move(maps);
    }
  }
}

/// Slivers, and whatever its own corners have turned over: they go aside within the surface. Flat triangles too, by the
/// normals that they have: one who counts what turned over may not leave them out.
void heal_slivers(EditPlan& plan) {
  const Positions before = plan.positions;
  const std::vector<char> none_is_flat(static_cast<size_t>(plan.unsplit.triangles.rows()), 0);
  const auto over_now = [&] { return flipped(plan, plan.unsplit.triangles, none_is_flat); };
  std::vector<int> over = over_now();
  for (int round = 0; round < kRounds && !over.empty(); ++round) {
    Positions positions = plan.positions;
    turn_back(facings(plan, over), plan.positions);
    std::vector<int> left = over_now();
    const bool is_far = !((plan.positions - before).rowwise().norm().maxCoeff() < kAside * plan.diagonal);
    if (is_far || left.size() >= over.size()) {
      plan.positions = std::move(positions);
      return;
    }
    over = std::move(left);
  }
}

}  // namespace

std::string heal(EditPlan& plan) {
  const auto over = [&] { return flipped(plan, plan.unsplit.triangles, plan.unsplit.is_flat).size(); };
  const size_t at_first = over();
  const Positions before = plan.positions.topRows(plan.unsplit.vertices);
  heal_folds(plan);
  heal_slivers(plan);
  const double moved = (plan.positions.topRows(before.rows()) - before).rowwise().norm().maxCoeff();
  if (moved == 0) return at_first == 0 ? "none" : "left: nothing near them turns them back";
  std::ostringstream words;
  words << at_first - std::min(at_first, over()) << " turned back, which moved vertices by " << std::setprecision(2)
        << 100 * moved / plan.diagonal << " % of the box diagonal at most";
  return words.str();
}

}  // namespace swage
