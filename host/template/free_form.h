// Free-form deformation: smooth displacements of space, told by control points around a mesh.
#pragma once

#include <array>
#include <vector>

#include "swage/steps.h"

namespace swage {

/// Displacements d(x) of a mesh at rest: quadratic B-splines of a grid of control points about its box and, since what
/// changes is a width or a height above all and ends at once, of finer ones of x, y or z alone. Between and beyond what
/// is told of them they bend as little as may be: straight legs stay straight.
class FreeForm {
 public:
  FreeForm() = default;
  explicit FreeForm(const Positions& rest);

  /// The displacements of the control points that minimise the mean by weight of (directions_v . d(v) - amounts_v)²
  /// and bending, with no part of the `idle` displacements, each of mean square 1. Of many vertices some are looked at.
  Positions fit(const Positions& directions, const Eigen::VectorXd& amounts, const Eigen::VectorXd& weights,
                const std::vector<Positions>& idle) const;

  /// d(v) of the vertices.
  Positions displacements(const Positions& control) const;
  /// I + grad d(v)
  Transforms maps(const Positions& control) const;

 private:
  static constexpr int kFiner = 8;                       ///< Parts of a cell.
  static constexpr int kOfCell = 27 + 3 * (kFiner + 2);  ///< Control points that count within a cell,
  static constexpr int kOfSite = 27 + 3 * 3;             ///< and where a vertex is.

  /// Where a vertex is: in which cell, and whereabouts, from 0 to 1 along each axis.
  struct Site {
    int cell;
    Eigen::Vector3d at;
  };
  /// The splines that are not zero there: which control points of the cell they are of, and their values and slopes.
  struct Splines {
    std::array<int, kOfSite> of;
    Eigen::Matrix<double, kOfSite, 1> values;
    Eigen::Matrix<double, kOfSite, 3> gradients;
  };

  Splines splines(const Site& site) const;
  std::array<int, kOfCell> control_of(int cell) const;
  std::vector<std::vector<int>> some() const;
  Eigen::MatrixXd bending() const;
  Eigen::MatrixXd squares(int cell, const Positions& rows) const;
  Positions products(const Positions& others) const;

  Eigen::Array3i cells_ = {0, 0, 0};  ///< Along each axis.
  Eigen::Array3d widths_ = {0, 0, 0};
  std::vector<Site> sites_;               ///< Of the vertices.
  std::vector<std::vector<int>> inside_;  ///< Vertices of each cell,
  std::vector<std::vector<int>> seen_;    ///< and those looked at.
  Eigen::MatrixXd bending_;               ///< Its square of the control points.
};

}  // namespace swage
