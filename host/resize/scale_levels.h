// Multigrid for the scale solve: about the inverse of its matrix among scales that leave the rows' sums alone.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "scale_matrix.h"

namespace swage {

class ScaleLevels {
 public:
  /// Of a matrix that has its weights.
  explicit ScaleLevels(const ScaleMatrix<double>& matrix);

  /// Takes over the matrix's diagonal and pairs.
  void fill(const ScaleMatrix<double>& matrix);
  /// `free`: 1 where a scale may change, else 0; as long as the matrix is. `all`: whether all may.
  void hold(const Values<double>& free, bool all);
  /// One V-cycle in single precision. Symmetric; the error is 0 where no scale may change.
  void cycle(const Values<double>& residual, Values<double>& error);

 private:
  struct Level {
    explicit Level(const ScaleLayout& layout) : matrix(layout) {}
    ScaleMatrix<float> matrix;
    Values<float> jacobi;  // 1 / diagonal.
    Values<float> inverse_sums;
    Values<float> residual, error, image;
  };

  RowSpread<float> smoother(const Level& level) const {
    return {level.matrix.layout, level.jacobi, level.inverse_sums};
  }
  void merge_weights(const Level& fine, Level& coarse) const;
  void merge_values(const Level& fine, Level& coarse) const;
  void factor_coarsest();
  void solve_coarsest(Level& level) const;
  void descend(size_t at);

  std::vector<Level> levels_;
  Values<double> free_, inverse_free_;
  Values<float> mask_, inverse_mask_;  // The same.
  bool all_free_ = true;
  std::vector<Eigen::Index> coarsest_;  // Where its unknowns lie.
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace swage
