#include "swage/scaffold.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "by_place.h"
#include "distinct.h"
#include "intersections.h"
#include "messages.h"
#include "swage/error.h"
#include "tetrahedra.h"

namespace swage {
namespace {

constexpr int kBoxCorners = 8;

void check_options(const ScaffoldOptions& options) {
  if (!(options.enlargement >= 1.01 && options.enlargement <= 1000)) {
    throw InvalidInput("scaffold: options.enlargement: " + digits(options.enlargement) + " is not in [1.01, 1000]");
  }
  if (!(options.time_limit > 0)) {
    throw InvalidInput("scaffold: options.time_limit: " + digits(options.time_limit) + " is not above 0");
  }
}

/// Corner i is at the high end of axis k where bit k of i is set.
Positions box_around(const Positions& points, double enlargement) {
  const Eigen::RowVector3d low = points.colwise().minCoeff(), high = points.colwise().maxCoeff();
  const Eigen::RowVector3d room = Eigen::RowVector3d::Constant((enlargement - 1) / 2 * (high - low).maxCoeff());
  Positions corners(kBoxCorners, 3);
  for (int i = 0; i < kBoxCorners; ++i) {
    for (int k = 0; k < 3; ++k) corners(i, k) = (i >> k & 1) != 0 ? high[k] + room[k] : low[k] - room[k];
  }
  return corners;
}

/// In an order and without last digits that would decide what tetrahedra there are where more than four points lie on a
/// sphere.
void put_in_order(Distinct& surface, Positions& points) {
  const Mesh given{rounded(points), surface.triangles};
  const Numbering numbering = by_place(given);
  Mesh mesh = in_order(given, numbering);
  begin_with_first(mesh.triangles);
  points = std::move(mesh.positions);
  surface.triangles = std::move(mesh.triangles);
  const auto put = [](std::vector<int>& numbers, const std::vector<int>& order) {
    std::vector<int> result;
    result.reserve(order.size());
    for (const int i : order) result.push_back(numbers[static_cast<size_t>(i)]);
    numbers = std::move(result);
  };
  put(surface.vertices, numbering.vertices);
  put(surface.originals, numbering.triangles);
}

/// The surface within a box, enlarged by a power of two to a size of about 1, which no coordinate's digits see.
struct Task {
  Distinct surface;
  Complex complex;
  double scale = 1;
};

Task make_task(const Positions& positions, const Triangles& triangles, double enlargement) {
  Task task{distinct(positions, triangles), {}, 1};
  if (task.surface.triangles.rows() == 0)
    throw InvalidInput("scaffold: triangles: none has an area; check the mesh's units and coordinates");
  Positions points = positions(task.surface.vertices, Eigen::all);
  const double extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
  task.scale = std::ldexp(1, std::min(-std::ilogb(extent), 1000));

  points *= task.scale;
  put_in_order(task.surface, points);
  Complex& complex = task.complex;
  const auto count = static_cast<int>(points.rows());
  complex.points.resize(count + kBoxCorners, 3);
  complex.points << points, box_around(points, enlargement);
  complex.triangles = task.surface.triangles;
  complex.quadrilaterals.resize(6, 4);
  complex.quadrilaterals << 0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5;
  complex.quadrilaterals.array() += count;
  return task;
}

/// Triangles that cross or overlap others, ascending; where very many do, some of them. TetGen would find them too, but
/// may crash over them.
std::vector<int> crossing_triangles(const Complex& complex, const Poll& poll) {
  constexpr std::size_t kMostPairs = 1'000'000;
  const Crossings found = self_intersections(complex.points, complex.triangles, kMostPairs, [&](double) {
    ask(poll);
    return true;
  });
  std::vector<int> crossing;
  for (const auto& [t, other] : found.pairs) crossing.insert(crossing.end(), {t, other});
  std::sort(crossing.begin(), crossing.end());
  crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
  return crossing;
}

std::vector<int> all_of(const Complex& complex) {
  std::vector<int> all(static_cast<size_t>(complex.triangles.rows()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// Takes them out of the complex, and tells which of the mesh's they are.
void leave_out(Task& task, const std::vector<int>& crossing, std::vector<int>& left_out) {
  std::vector<int>& originals = task.surface.originals;
  std::vector<int> kept;
  for (int t = 0; t < task.complex.triangles.rows(); ++t) {
    if (std::binary_search(crossing.begin(), crossing.end(), t)) {
      left_out.push_back(originals[static_cast<size_t>(t)]);
    } else {
      originals[kept.size()] = originals[static_cast<size_t>(t)];
      kept.push_back(t);
    }
  }
  originals.resize(kept.size());
  task.complex.triangles = Triangles(task.complex.triangles(kept, Eigen::all));
}

[[noreturn]] void refuse_crossing(const Task& task, const std::vector<int>& crossing) {
  constexpr size_t kNamed = 10;
  std::vector<int> triangles;
  triangles.reserve(crossing.size());
  for (const int t : crossing) triangles.push_back(task.surface.originals.at(static_cast<size_t>(t)));
  std::sort(triangles.begin(), triangles.end());
  std::string text = "scaffold: triangles ";
  for (size_t i = 0; i < std::min(kNamed, triangles.size()); ++i) {
    text += (i > 0 ? ", " : "") + std::to_string(triangles[i]);
  }
  if (crossing.size() > kNamed) text += " and " + std::to_string(crossing.size() - kNamed) + " more";
  throw Unsolvable(text + " cross or overlap others; repair them, or leave them out (leave_out_crossing)");
}

using Face = std::array<int, 3>;

Face face(int a, int b, int c) {
  Face corners{a, b, c};
  std::sort(corners.begin(), corners.end());
  return corners;
}

[[noreturn]] void refuse_answer(const std::string& what) {
  throw Unsolvable("scaffold: TetGen returns " + what + "; repair what nearly touches or overlaps");
}

void check_indices(const Filling& filling) {
  const auto& tetrahedra = filling.tetrahedra;
  if (tetrahedra.rows() == 0) refuse_answer("no tetrahedra");
  if (tetrahedra.minCoeff() < 0 || tetrahedra.maxCoeff() >= filling.points.rows())
    refuse_answer("corners that are none");
}

/// That each triangle is a face of a tetrahedron.
void check_faces(const Task& task, const Filling& filling) {
  std::vector<Face> faces;
  for (const auto& t : task.complex.triangles.rowwise()) faces.push_back(face(t[0], t[1], t[2]));
  std::sort(faces.begin(), faces.end());
  std::vector<bool> found(faces.size(), false);
  for (const auto& t : filling.tetrahedra.rowwise()) {
    for (const Face& side :
         {face(t[0], t[1], t[2]), face(t[0], t[1], t[3]), face(t[0], t[2], t[3]), face(t[1], t[2], t[3])}) {
      const auto at = std::lower_bound(faces.begin(), faces.end(), side);
      if (at != faces.end() && *at == side) found[static_cast<size_t>(at - faces.begin())] = true;
    }
  }
  const auto lost = std::count(found.begin(), found.end(), false);
  if (lost > 0) refuse_answer("tetrahedra that lack " + std::to_string(lost) + " of the triangles as faces");
}

double volume(const Positions& positions, const Eigen::RowVector4i& t) {
  const Eigen::RowVector3d a = positions.row(t[0]), b = positions.row(t[1]), c = positions.row(t[2]),
                           d = positions.row(t[3]);
  return (b - a).cross(c - a).dot(d - a) / 6;
}

/// That they fill the box, none inside out. The smallest have less volume than rounding tells.
void check_volumes(const Task& task, const Filling& filling) {
  constexpr double kRounding = 1e-9;
  const Eigen::Index corners = task.complex.points.rows() - kBoxCorners;
  const Eigen::RowVector3d diagonal =
      task.complex.points.row(corners + kBoxCorners - 1) - task.complex.points.row(corners);
  const double box = diagonal.prod();
  double sum = 0;
  for (const auto& t : filling.tetrahedra.rowwise()) {
    const double part = volume(filling.points, t);
    if (part < -kRounding * box) refuse_answer("a tetrahedron that is inside out");
    sum += part;
  }
  if (!(std::abs(sum - box) < kRounding * box)) refuse_answer("tetrahedra that do not fill the box");
}

void check_filling(const Task& task, const Filling& filling) {
  const Eigen::Index count = task.complex.points.rows();
  if (filling.points.rows() < count || filling.points.topRows(count) != task.complex.points)
    refuse_answer("other points");
  if (!filling.points.allFinite()) refuse_answer("points that are not finite");
  check_indices(filling);
  check_faces(task, filling);
  check_volumes(task, filling);
}

/// The filling with the mesh's own vertices, all of them, in front.
Scaffold assemble(const PositionsRef& positions, const Task& task, const Filling& filling) {
  const auto used = static_cast<int>(task.surface.vertices.size());
  const auto count = static_cast<int>(positions.rows());
  const Eigen::Index added = filling.points.rows() - used;
  Scaffold result;
  result.positions.resize(count + added, 3);
  result.positions << positions, filling.points.bottomRows(added) / task.scale;
  result.tetrahedra = filling.tetrahedra.unaryExpr(
      [&](int v) { return v < used ? task.surface.vertices[static_cast<size_t>(v)] : v - used + count; });
  return result;
}

Filling fill(const Task& task, const ScaffoldOptions& options, const Poll& poll) {
  HelperLimits limits;
  limits.seconds = options.time_limit;
  try {
    return tetrahedra_of(task.complex, options.quality, limits, poll);
  } catch (const Unsolvable& error) {
    throw Unsolvable(std::string("scaffold: ") + error.what());
  }
}

}  // namespace

Scaffold scaffold(const PositionsRef& positions, const TrianglesRef& triangles, const ScaffoldOptions& options,
                  const ProgressFn& progress) {
  check(positions, triangles);
  check_options(options);
  const Poll poll = sparing([&] { return !progress || progress({.stage = "scaffold"}); });
  try {
    Task task = make_task(positions, triangles, options.enlargement);
    std::vector<int> left_out;
    if (options.faces) {
      const std::vector<int> crossing = crossing_triangles(task.complex, poll);
      if (!crossing.empty() && !options.leave_out_crossing) refuse_crossing(task, crossing);
      leave_out(task, crossing, left_out);
    } else {
      leave_out(task, all_of(task.complex), left_out);
    }
    Filling filling = fill(task, options, poll);
    if (!filling.crossing.empty() && options.leave_out_crossing) {  // By rounding.
      leave_out(task, filling.crossing, left_out);
      filling = fill(task, options, poll);
    }
    if (!filling.crossing.empty()) refuse_crossing(task, filling.crossing);
    check_filling(task, filling);
    Scaffold result = assemble(positions, task, filling);
    std::sort(left_out.begin(), left_out.end());
    result.left_out = std::move(left_out);
    return result;
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace swage
