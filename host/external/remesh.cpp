#include "swage/remesh.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "by_place.h"
#include "distinct.h"
#include "measures.h"
#include "messages.h"
#include "remesher.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr int kFewest = 100, kMost = 1'000'000;  // Triangles.
constexpr int kFiner = 3;                        // How many times more features may ask for.

void check_range(const char* option, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw InvalidInput(std::string("remesh: options.") + option + ": " + digits(value) + " is not in [" + digits(low) +
                     ", " + digits(high) + "]");
}

void check_above(const char* option, double value, double bound) {
  if (value > bound) return;
  throw InvalidInput(std::string("remesh: options.") + option + ": " + digits(value) + " is not above " +
                     digits(bound));
}

void check_options(const RemeshOptions& options) {
  check_range("triangles", options.triangles, kFewest, kMost);
  check_above("feature_angle", options.feature_angle, 0);
  check_range("feature_angle", options.feature_angle, 0, std::numbers::pi);
  check_range("iterations", options.iterations, 1, 100);
  check_range("wrap_alpha", options.wrap_alpha, 0.002, 1);
  check_above("time_limit", options.time_limit, 0);
}

/// Side of the equilateral triangle.
double side_of(double area) { return std::sqrt(4 / std::sqrt(3) * area); }

/// The mesh welded and enlarged by a power of two to a size of about 1, which no coordinate's digits see; in an order
/// and without last digits that would decide what edges are split and flipped first.
struct Scaled {
  Mesh mesh;
  double scale;
};

Scaled scaled(const PositionsRef& positions, const TrianglesRef& triangles) {
  const Distinct surface = distinct(positions, triangles, FlatTriangles::kept);
  Scaled result{{positions(surface.vertices, Eigen::all), surface.triangles}, 1};
  Positions& points = result.mesh.positions;
  if (distinct(points, surface.triangles).triangles.rows() == 0) {
    throw InvalidInput("remesh: triangles: none has an area; check the mesh's units and coordinates");
  }
  const double extent = (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
  result.scale = std::ldexp(1, std::min(-std::ilogb(extent), 1000));
  points = rounded(points * result.scale);
  result.mesh = in_order(result.mesh, by_place(result.mesh));
  begin_with_first(result.mesh.triangles);
  return result;
}

RemeshTask task_of(const Scaled& input, const RemeshOptions& options) {
  const auto& [positions, triangles] = input.mesh;
  const double area = area_vectors(positions, triangles).rowwise().norm().sum() / 2;
  const double diagonal = box_diagonal(positions);
  RemeshTask task{input.mesh};
  task.edge_length = side_of(area / options.triangles);
  if (options.edge_length != 0) {
    const double finest = std::min(side_of(area / kMost), diagonal);
    check_range("edge_length", options.edge_length, finest / input.scale, diagonal / input.scale);
    task.edge_length = options.edge_length * input.scale;
  }
  const double expected = std::pow(side_of(area) / task.edge_length, 2);
  task.triangle_limit = kFiner * static_cast<int>(std::max<double>(expected, options.triangles));
  task.feature_angle = options.feature_angle;
  task.wrap_alpha = options.wrap ? options.wrap_alpha * diagonal : 0;
  task.iterations = options.iterations;
  return task;
}

Mesh run(const RemeshTask& task, const RemeshOptions& options, const Poll& poll) {
  HelperLimits limits;
  limits.seconds = options.time_limit;
  try {
    return remeshed(task, limits, poll);
  } catch (const Unsolvable& error) {
    throw Unsolvable(std::string("remesh: ") + error.what());
  }
}

void check_answer(const Mesh& mesh) {
  try {
    check(mesh.positions, mesh.triangles);
  } catch (const InvalidInput& error) {
    throw Unsolvable(std::string("remesh: swage-remesh returns no mesh: ") + error.what());
  }
}

}  // namespace

Mesh remesh(const PositionsRef& positions, const TrianglesRef& triangles, const RemeshOptions& options,
            const ProgressFn& progress) {
  check(positions, triangles);
  check_options(options);
  const Poll poll = sparing([&] { return !progress || progress({.stage = "remesh"}); });
  try {
    const Scaled input = scaled(positions, triangles);
    const Mesh answer = run(task_of(input, options), options, poll);
    check_answer(answer);
    const Distinct result = distinct(answer.positions, answer.triangles);
    if (result.triangles.rows() == 0)
      throw Unsolvable("remesh: nothing is left of the surface; ask for more triangles");
    return {answer.positions(result.vertices, Eigen::all) / input.scale, result.triangles};
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace swage
