// Multigrid for the scale solve: about the inverse of its matrix among scales that leave the rows' sums alone.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "scale_rows.h"

namespace swage {

class ScaleLevels {
 public:
  /// Of a matrix that has its weights.
  explicit ScaleLevels(const ScaleMatrix<double>& matrix);

  const ScaleMatrix<float>& finest() const { return levels_[0].matrix; }
  /// Of the cells, as they are held.
  Rows rows() const { return levels_[0].rows(); }
  /// Takes over the matrix's own and pairs.
  void fill(const ScaleMatrix<double>& matrix);
  /// `free`: 1 where a scale may change, else 0; as long as the matrix is. `all`: whether all may.
  void hold(const Values<float>& free, bool all);
  /// One cycle. Symmetric; the error is 0 where no scale may change.
  void cycle(const Values<float>& residual, Values<float>& error);

 private:
  struct Level {
    explicit Level(const ScaleLayout& layout) : matrix(layout) {}
    ScaleMatrix<float> matrix;
    Values<float> all_free;  // The matrix's own, where no scale is held.
    Values<float> jacobi;    // 1 / diagonal, or 0 where a scale is held.
    Values<float> inverse_sums;
    Values<float> residual, error, image;

    Rows rows() const { return {matrix.layout, jacobi, inverse_sums}; }
    std::array<Values<float>, 4> twice;  // For going down twice.
  };

  void merge_weights(const Level& fine, Level& coarse) const;
  void merge_values(const Level& fine, Level& coarse) const;
  void prepare_smoother(Level& level) const;
  void stiffen();
  void factor_coarsest();
  void solve_coarsest(const Values<float>& residual, Values<float>& error) const;
  void descend(size_t at, const Values<float>& residual, Values<float>& error);
  void descend_twice(size_t at);
  void correct(size_t at, const Values<float>& residual, Values<float>& error);

  std::vector<Level> levels_;
  Values<float> free_;
  bool all_free_ = true;
  std::vector<Eigen::Index> coarsest_;  // Where its unknowns lie.
  Eigen::LLT<Eigen::MatrixXd> factor_;
};

}  // namespace swage
