#include "grid.h"

#include <cmath>
#include <cstdint>
#include <string>

#include "messages.h"
#include "swage/error.h"

namespace swage {
namespace {

constexpr double kLargestFactor = 1e6;

[[noreturn]] void refuse(const char* caller, const std::string& what) {
  throw InvalidInput(std::string(caller) + ": " + what);
}

std::string axis_name(int axis) { return {"xyz"[axis]}; }

void check_shape(const char* caller, const GridShape& shape) {
  std::int64_t count = 1;
  for (int u = 0; u < 3; ++u) {
    const std::string along = " along " + axis_name(u);
    if (!(shape.size[u] >= 0 && std::isfinite(shape.size[u]) && std::isfinite(shape.corner[u]))) {
      refuse(caller, "shape: its box is not finite or its size below 0" + along + "; mend it");
    }
    if (shape.cells[u] < 1) refuse(caller, "shape: " + std::to_string(shape.cells[u]) + " cells" + along + ", below 1");
    if (!shape.extends(u) && shape.cells[u] != 1)
      refuse(caller, "shape: more than one cell" + along + ", where it has no extent; give 1");
    count *= shape.cells[u];
    if (count > 100'000'000) refuse(caller, "shape: more than 100 million cells; give fewer");
  }
}

}  // namespace

AxisValues rest_vertices(const GridShape& shape) {
  const Extents vertices = shape.vertices();
  AxisValues result(vertices.count(), 3);
  for (int k = 0; k < vertices[2]; ++k) {
    for (int j = 0; j < vertices[1]; ++j) {
      for (int i = 0; i < vertices[0]; ++i) {
        const std::array<int, 3> at = {i, j, k};
        for (int u = 0; u < 3; ++u) {
          const double part = static_cast<double>(at[static_cast<size_t>(u)]) / shape.cells[u];
          result(vertices.at(i, j, k), u) = shape.corner[u] + part * shape.size[u];
        }
      }
    }
  }
  return result;
}

void check(const char* caller, const GridShape& shape, const CellMap& map) {
  check_shape(caller, shape);
  const Eigen::Index count = shape.cells.count();
  const std::string due = " rows, but there are " + std::to_string(count) + " cells; give one for each";
  if (map.theta.rows() != count) refuse(caller, "map.theta: " + std::to_string(map.theta.rows()) + due);
  if (map.phi.size() != count) refuse(caller, "map.phi: " + std::to_string(map.phi.size()) + due);
  for (Eigen::Index c = 0; c < count; ++c) {
    for (int u = 0; u < 3; ++u) {
      if (!(map.theta(c, u) >= 0 && map.theta(c, u) <= 1)) {
        refuse(caller, "map.theta: " + digits(map.theta(c, u)) + " in cell " + std::to_string(c) + " along " +
                           axis_name(u) + " is not in [0, 1]");
      }
    }
    if (!(map.phi[c] >= 1e-3 && map.phi[c] <= 1e3)) {
      refuse(caller, "map.phi: " + digits(map.phi[c]) + " in cell " + std::to_string(c) + " is not in [0.001, 1000]");
    }
  }
}

void check_factors(const char* caller, const GridShape& shape, const Eigen::RowVector3d& factors) {
  for (int u = 0; u < 3; ++u) {
    if (shape.extends(u) && !(factors[u] >= 1 / kLargestFactor && factors[u] <= kLargestFactor)) {
      refuse(caller, "factors: " + digits(factors[u]) + " along " + axis_name(u) + " is not in [1e-6, 1e6]");
    }
  }
}

}  // namespace swage
