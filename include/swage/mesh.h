// A triangle mesh as two matrices, a row an element.
#pragma once

#include <Eigen/Core>

static_assert(EIGEN_DEFAULT_ALIGN_BYTES == 0 || EIGEN_MALLOC_ALREADY_ALIGNED,
              "A matrix made on one side of Swage's border is freed on the other, so both must allocate alike: link "
              "swage::swage with CMake, or define EIGEN_MAX_ALIGN_BYTES=16 and EIGEN_MALLOC_ALREADY_ALIGNED=1");

#pragma GCC visibility push(default)
namespace swage {

/// #V × 3, in mesh units.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// #F × 3 vertex indices from 0, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// Borders take row- and column-major matrices alike.
using PositionsRef = Eigen::Ref<const Positions>;
using TrianglesRef = Eigen::Ref<const Triangles>;

struct Mesh {
  Positions positions;
  Triangles triangles;
};

/// Throws InvalidInput, naming the first offending row, where the mesh is empty, a coordinate is NaN, infinite or
/// beyond 1e12 in magnitude, or an index lies outside [0, #V). Degenerate, duplicate or non-manifold triangles pass.
void check(const PositionsRef& positions, const TrianglesRef& triangles);

/// Length of the bounding box's diagonal, in mesh units. The D by which gestures and errors are measured.
double box_diagonal(const PositionsRef& positions);

}  // namespace swage
#pragma GCC visibility pop
