// The assembly along one axis: in units of cells at rest, solved for as what vertices differ by from plain scaling.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "bounded.h"
#include "cancel.h"
#include "correction.h"
#include "line_levels.h"

namespace swage {

/// The grid turned so that the axis u is its last.
struct TurnedGrid {
  TurnedGrid(const Extents& of_cells, int u);

  int axis;
  Extents cells, vertices;
  /// Of a vertex or cell of the grid as it is.
  Eigen::Index vertex(int i, int j, int k) const { return turned(vertices, i, j, k); }
  Eigen::Index cell(int i, int j, int k) const { return turned(cells, i, j, k); }

 private:
  Eigen::Index turned(const Extents& extents, int i, int j, int k) const;
};

struct AxisResult {
  int iterations = 0, rounds = 0;
  Eigen::Index at_bound = 0;
  bool converged = true;
};

struct AxisWork;

class AxisAssembly {
 public:
  AxisAssembly(const Extents& cells, const CellMap& map, int u);

  const TurnedGrid& grid() const { return grid_; }
  const LineLevels& levels() const { return levels_; }
  /// Leaves what vertices differ by from plain scaling in `work`. `scales`: of the cells. `again`: from what is there.
  AxisResult solve(const Eigen::VectorXd& scales, double factor, double tolerance, bool again, const Poll& poll,
                   AxisWork& work) const;

 private:
  using Vector = Values<double>;

  void pull(const Eigen::VectorXd& scales, double factor, AxisWork& work) const;
  void tie(double least, AxisWork& work) const;
  Correction improve(Approach& approach, const Poll& poll, AxisWork& work) const;
  void measure(double least, const Approach& approach, AxisWork& work) const;
  void pull_in(double least, AxisWork& work) const;

  TurnedGrid grid_;
  Vector theta_;  // Of turned cells, as the weights have it.
  LineMatrix<double> matrix_;
  LineLevels levels_;
};

struct AxisWork {
  explicit AxisWork(const AxisAssembly& of) : levels(of.levels().work()) {}

  LineWork levels;
  CorrectionWork correction;
  Values<double> side, change, rest;  // Rest: what the change leaves of the side.
  Values<double> kept;                // The same, of tied vertices together.
  Eigen::ArrayXd measure;
  double first = -1;  // Of the approach.
};

}  // namespace swage
