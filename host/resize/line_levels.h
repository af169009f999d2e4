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
  Values<Scalar> across;                  // Sum of a vertex's weights along the first two axes.

  Eigen::Index layer() const { return extents.stride(2); }
  void sum_across();
  /// Sum of all weights of a vertex.
  Scalar diagonal(Eigen::Index at) const {
    return across[at] + weights[2][at] + (at < layer() ? 0 : weights[2][at - layer()]);
  }
  /// x · product.
  double multiply(const Values<Scalar>& x, Values<Scalar>& product) const;
  /// What x leaves of the side.
  void subtract(const Values<Scalar>& side, const Values<Scalar>& x, Values<Scalar>& rest) const;
};

/// A level's vectors and what ties change of its matrix, for one thread at a time.
struct LineLevelWork {
  LineMatrix<float> matrix;  // None on the finest level, where ties are kept.
  Values<float> along;       // Weights by which lines are solved, on the finest level.
  Values<float> inverse_pivots;
  Values<float> residual, error, image;
  std::array<Values<float>, 4> twice;  // For going down twice.
};

struct LineWork {
  std::vector<LineLevelWork> levels;
  Ties ties;
  bool tied = false;
};

class LineLevels {
 public:
  explicit LineLevels(const LineMatrix<double>& matrix);

  const LineMatrix<float>& finest() const { return levels_[0].matrix; }
  LineWork work() const;
  /// Takes over a work that may be one of other levels of the same grid; `loose`: nothing is tied yet.
  void start(LineWork& work, bool loose) const;
  /// Takes over the work's ties, after those before.
  void tie(LineWork& work) const;
  /// One cycle, symmetric, among vertices as they are tied.
  void cycle(const Values<float>& residual, Values<float>& error, LineWork& work) const;

 private:
  struct Level {
    LineMatrix<float> matrix;
    Values<float> inverse_pivots;
  };

  void tie_finest(LineWork& work) const;
  void stiffen(LineWork& work) const;
  void descend(size_t at, const Values<float>& residual, Values<float>& error, LineWork& work) const;
  void descend_twice(size_t at, LineWork& work) const;

  std::vector<Level> levels_;
};

}  // namespace swage
