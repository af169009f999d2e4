// The cells of a cube that the zero set of a field may pass.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cancel.h"
#include "swage/steps.h"

namespace swage {

using Place = std::array<int, 3>;

/// A cube of `count` cells along each axis.
struct Lattice {
  Eigen::RowVector3d corner;
  double width;  ///< Of a cell.
  int count;

  Eigen::RowVector3d at(const Place& p) const { return corner + width * Eigen::RowVector3d(p[0], p[1], p[2]); }
  /// Of a corner or cell.
  std::int64_t key(const Place& p) const {
    const std::int64_t side = count + 1;
    return p[0] + side * (p[1] + side * p[2]);
  }
};

/// Cells that the surface may pass, and of those that it seems to the lowest and highest along each axis.
struct NearCells {
  Lattice lattice;
  std::vector<Place> cells;
  Place low = {}, high = {};

  /// Cells along the longest side of the box.
  int extent() const;
  bool touch_border() const;
};

/// A field with its parameters.
struct FieldAt {
  FieldStep& step;
  const Eigen::VectorXd& parameters;

  void evaluate(const Positions& points, FieldDerivatives derivatives, FieldValues& values) const {
    step.evaluate(points, parameters, derivatives, values);
  }
};

/// Halves the cells of the cube [-64, 64]³ until those that the surface may pass are `resolution` along their longest
/// side at least. None where there is no surface.
NearCells cells_near(const FieldAt& field, int resolution, const Poll& poll);

}  // namespace swage
