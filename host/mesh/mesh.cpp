#include "swage/mesh.h"

#include <cmath>
#include <string>

#include "swage/error.h"

namespace swage {
namespace {

constexpr double kLargestCoordinate = 1e12;  // Squares of lengths and their sums stay far from overflow.

void check_positions(const PositionsRef& positions) {
  for (Eigen::Index v = 0; v < positions.rows(); ++v) {
    if (!(positions.row(v).array().abs() <= kLargestCoordinate).all()) {
      throw InvalidInput("check: positions: vertex " + std::to_string(v) +
                         " has a coordinate that is not a number, infinite or beyond 1e12; rescale or repair the mesh");
    }
  }
}

void check_triangles(const TrianglesRef& triangles, Eigen::Index vertex_count) {
  for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int v = triangles(t, k);
      if (v < 0 || v >= vertex_count) {
        throw InvalidInput("check: triangles: triangle " + std::to_string(t) + " names vertex " + std::to_string(v) +
                           ", but vertices run from 0 to " + std::to_string(vertex_count - 1) + "; mend or remove it");
      }
    }
  }
}

}  // namespace

void check(const PositionsRef& positions, const TrianglesRef& triangles) {
  if (positions.rows() == 0) throw InvalidInput("check: positions: the mesh has no vertices; give a row for each");
  if (triangles.rows() == 0) throw InvalidInput("check: triangles: the mesh has no triangles; give a row for each");
  check_positions(positions);
  check_triangles(triangles, positions.rows());
}

double box_diagonal(const PositionsRef& positions) {
  return (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
}

}  // namespace swage
