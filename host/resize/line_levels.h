// Multigrid for the assembly along one axis: lines of grid vertices that are coupled strongly, or hardly, along the
// lines and across them. Lines are solved whole, and two by two of them become one on the next level; the last level is
// one line.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "merge.h"
#include "ties.h"

namespace swage {

/// Vertices with the axis of the lines as their last. The first and the last layer are held: zeros there.
template <typename Scalar>
struct LineMatrix {
  Extents extents;
  std::array<Values<Scalar>, 3> weights;  // Between a vertex and the one after it along each axis, or 0.
  Values<Scalar> diagonal;

  Eigen::Index layer() const { return extents.stride(2); }
  /// Of the weights.
  void sum_diagonal();
  void multiply(const Values<Scalar>& x, Values<Scalar>& product) const;
};

/// Tridiagonal matrices of all lines.
struct LineFactor {
  Values<float> weights, inverse_pivots;
};

/// Vectors of each level, for one thread at a time.
struct LineWork {
  struct Level {
    Values<float> residual, error, image;
  };
  std::vector<Level> levels;
  Ties ties;
  LineFactor finest;  // With the ties.
};

class LineLevels {
 public:
  explicit LineLevels(const LineMatrix<double>& matrix);

  LineWork work() const;
  /// Takes over the work's ties.
  void tie(LineWork& work) const;
  /// One V-cycle in single precision, symmetric, among vertices as they are tied.
  void cycle(const Values<double>& residual, Values<double>& error, LineWork& work) const;

 private:
  struct Level {
    LineMatrix<float> matrix;
    LineFactor lines;

    void factor();
    /// In place.
    void solve_lines(const LineFactor& factor, Values<float>& sides) const;
  };

  void descend(size_t at, LineWork& work) const;

  std::vector<Level> levels_;
};

}  // namespace swage
