// Finalising: handles that miss are held harder, and those in dimples by patches instead of points.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <unordered_set>

#include "plan.h"

namespace swage {
namespace {

constexpr double kMiss = 0.005;        // Of the box's diagonal: handles that miss by more are held harder.
constexpr double kMissOfPatch = 0.01;  // The same of patches, which let their middle go a little.
constexpr double kTooFar = 0.02;       // Handles that miss by more are not let go further.
constexpr double kHardest = 100;       // Times as hard.
constexpr double kPatch = 0.025;       // Radius of a patch, of the unit box.
constexpr double kShareOfPatch = 0.9;  // Of a handle's weight.
constexpr double kHardening = 1.4;     // Handles miss by about the 0.7th power of how hard they are held.
constexpr int kRounds = 4;             // In which all is held harder, until handles miss by less,
constexpr double kStuck = 0.95;        // or by as much of what they missed by in the last.

/// What can be said for positions.
struct Merit {
  double miss;         ///< Largest distance of a handle from its target.
  double mean_turn;    ///< Of normals, over the surface.
  double beside_turn;  ///< Largest of a triangle beside some handles.
};

/// Vertices within the radius of a patch of the handle's and joined to it, or beside it.
std::vector<int> patch_around(int vertex, const Positions& rest, const Lists& ring) {
  std::vector<int> patch{vertex};
  std::unordered_set<int> met{vertex};
  for (size_t next = 0; next < patch.size(); ++next) {
    for (const int v : ring[patch[next]]) {
      const bool is_near = next == 0 || (rest.row(v) - rest.row(vertex)).norm() <= kPatch;
      if (is_near && met.insert(v).second) patch.push_back(v);
    }
  }
  return patch;
}

Eigen::Matrix3d mean_transform(const std::vector<int>& patch, const Lists& around, const Transforms& transforms) {
  Eigen::Matrix<double, 1, 9> sum = Eigen::Matrix<double, 1, 9>::Zero();
  int count = 0;
  for (const int v : patch) {
    for (const int t : around[v]) {
      sum += transforms.row(t);
      ++count;
    }
  }
  sum /= std::max(count, 1);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(sum.data());
}

/// Handles in dimples are held by the surface around them, which goes with them as it is stretched.
class Patches {
 public:
  Patches(const ReshapePlan& plan, const std::vector<Hold>& dimpled, const Transforms& transforms)
      : rest_(plan.rest->vertices),
        ring_(one_rings(plan.edges, static_cast<int>(rest_.rows()))),
        around_(triangles_of_vertices(plan.rest->triangles, static_cast<int>(rest_.rows()))),
        dimpled_(dimpled),
        transforms_(transforms) {}

  Holds holds(const Holds& handles, double hardness) const {
    std::set<std::array<int, 3>> replaced;
    for (const Hold& hold : dimpled_) replaced.insert(hold.vertices);
    Holds result{{}, hardness * handles.weight};
    std::copy_if(handles.points.begin(), handles.points.end(), std::back_inserter(result.points),
                 [&](const Hold& hold) { return replaced.count(hold.vertices) == 0; });
    for (const Hold& hold : dimpled_) {
      const std::vector<int> patch = patch_around(hold.vertex(), rest_, ring_);
      const Eigen::Matrix3d transform = mean_transform(patch, around_, transforms_);
      for (const int v : patch) {
        const Eigen::Vector3d offset = transform * (rest_.row(v) - hold.point(rest_)).transpose();
        result.points.push_back(
            Hold::at(v, hold.target + offset.transpose(), kShareOfPatch / static_cast<double>(patch.size())));
      }
    }
    return result;
  }

 private:
  const Positions& rest_;
  Lists ring_, around_;
  const std::vector<Hold>& dimpled_;
  const Transforms& transforms_;
};

/// Holds handles that miss harder and those in dimples by patches, and keeps what that makes better.
class Finisher {
 public:
  Finisher(const ReshapePlan& plan, Iterate& iterate, const GoOn& go_on)
      : plan_(plan),
        iterate_(iterate),
        handles_(iterate.handles),
        go_on_(go_on),
        diagonal_(box_diagonal(plan.rest->vertices.topRows(plan.mesh.positions.rows()))) {}

  /// As the paper repeats its solve.
  void hold_harder(Positions& positions) {
    const Merit before = merit(positions, {});
    if (before.miss <= kMiss * diagonal_) return;
    Holds harder = handles_;
    harder.weight *= std::clamp(2 * before.miss / (kMiss * diagonal_), 2.0, kHardest);
    Positions again = positions;
    const Transforms transforms = iterate_.transforms;
    go_on(harder, again);
    const Merit after = merit(again, {});
    constexpr double kTurn = 1.5, kSmallTurn = 0.01;  // Radians.
    const bool better = after.miss < 0.8 * before.miss && after.mean_turn < kTurn * before.mean_turn + kSmallTurn;
    tell("held harder", before, after, better);
    if (better) {
      positions = std::move(again);
    } else {
      iterate_.transforms = transforms;
    }
  }

  /// Whether there were dimples, and handles near enough.
  bool hold_patches(Positions& positions) {
    const std::vector<Hold> dimpled = dimples(handles_, *plan_.rest, positions);
    if (dimpled.empty() || largest_miss(handles_, positions) > kTooFar * diagonal_) return false;
    const Transforms transforms = iterate_.transforms;
    const Patches patches(plan_, dimpled, transforms);
    const Merit before = merit(positions, dimpled);
    Positions again = positions;
    double hardness = 1, last = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kRounds; ++round) {
      go_on(patches.holds(handles_, hardness), again);
      const double missed = largest_miss(handles_, again) / diagonal_;
      if (missed <= kMissOfPatch || missed > kStuck * last) break;
      last = missed;
      hardness = std::min(1.02 * hardness * std::pow(missed / kMissOfPatch, kHardening), kHardest);
    }
    const Merit after = merit(again, dimpled);
    const bool better =
        after.miss <= std::max(before.miss, kMissOfPatch * diagonal_) && after.beside_turn < before.beside_turn;
    tell(std::to_string(dimpled.size()) + " dimples held by patches", before, after, better);
    if (better) {
      positions = std::move(again);
    } else {
      iterate_.transforms = transforms;
    }
    return true;
  }

  const std::string& told() const { return told_; }

 private:
  void go_on(Holds holds, Positions& positions) {
    iterate_.handles = std::move(holds);
    if (!go_on_(positions)) throw Cancelled();
  }

  Merit merit(const Positions& positions, const std::vector<Hold>& beside) const {
    const Positions normals = unit_normals(positions, plan_.rest->triangles);
    const Positions areas = area_vectors(plan_.rest->vertices, plan_.rest->triangles);
    std::vector<char> is_beside(static_cast<size_t>(plan_.rest->vertices.rows()), 0);
    for (const Hold& hold : beside) is_beside[static_cast<size_t>(hold.vertex())] = 1;
    Merit result{largest_miss(handles_, positions), 0, 0};
    double sum = 0;
    for (Eigen::Index t = 0; t < normals.rows(); ++t) {
      const double turn = normals.row(t).isZero(0)
                              ? std::numbers::pi
                              : std::numbers::pi - dihedral_angle(plan_.rest->normals.row(t), normals.row(t));
      const double area = areas.row(t).norm();
      result.mean_turn += area * turn;
      sum += area;
      for (const int v : Eigen::RowVector3i(plan_.rest->triangles.row(t))) {
        if (is_beside[static_cast<size_t>(v)] != 0) result.beside_turn = std::max(result.beside_turn, turn);
      }
    }
    result.mean_turn /= sum;
    return result;
  }

  void tell(const std::string& what, const Merit& before, const Merit& after, bool better) {
    std::ostringstream words;
    words.precision(3);
    words << (told_.empty() ? "" : "; ") << what << ": handles miss by " << 100 * after.miss / diagonal_
          << " % (before " << 100 * before.miss / diagonal_ << " %), normals turn by "
          << after.mean_turn * 180 / std::numbers::pi << " degrees (before "
          << before.mean_turn * 180 / std::numbers::pi << ")" << (better ? "" : ": not better, left");
    told_ += words.str();
  }

  const ReshapePlan& plan_;
  Iterate& iterate_;
  const Holds handles_;
  const GoOn& go_on_;
  const double diagonal_;
  std::string told_;
};

}  // namespace

std::optional<Positions> finished(const ReshapePlan& plan, Iterate& iterate, const Positions& positions,
                                  const GoOn& go_on, const Poll& poll, std::string& told) {
  if (plan.options.solver == ReshapeSolver::published) return let_go(plan, iterate, positions, poll);
  Finisher finisher(plan, iterate, go_on);
  Positions better = positions;
  if (!finisher.hold_patches(better)) {
    finisher.hold_harder(better);
    finisher.hold_patches(better);  // Held harder, handles may come to sit in some.
  }
  told = finisher.told();
  if (better == positions) return std::nullopt;
  return better;
}

}  // namespace swage
