#include "factor.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace swage {
namespace {

class Simplicial : public Factor {
 public:
  void analyze(const SparseMatrix& matrix) override { ldlt_.analyzePattern(matrix); }

  int factorize(const SparseMatrix& matrix) override {
    ldlt_.factorize(matrix);
    // The factorisation stops at a zero pivot only: a negative or undefined one goes on as if nothing were.
    const auto pivots = ldlt_.vectorD();
    Eigen::Index first = 0;
    while (first < pivots.size() && pivots[first] > 0) ++first;
    return first == pivots.size() && std::isfinite(pivots.sum()) ? -1 : static_cast<int>(first);
  }

  void solve(Eigen::Ref<Eigen::MatrixXd> columns) const override {
    const bool coupled = ldlt_.matrixL().nestedExpression().nonZeros() > 0;
    if (coupled) ldlt_.matrixL().solveInPlace(columns);
    columns = ldlt_.vectorD().asDiagonal().inverse() * columns;
    if (coupled) ldlt_.matrixU().solveInPlace(columns);
  }

  Eigen::Index entries() const override { return ldlt_.matrixL().nestedExpression().nonZeros(); }

 private:
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt_;
};

}  // namespace

std::unique_ptr<Factor> simplicial_factor() { return std::make_unique<Simplicial>(); }

}  // namespace swage
