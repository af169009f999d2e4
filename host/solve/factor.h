// The Cholesky factor of a sparse symmetric positive definite matrix, whoever makes it.
#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <vector>

#include "panels.h"

namespace swage {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Column by column, or by dense blocks of columns that share their rows; or none, for a matrix that only multiplies.
enum class FactorKind { none, simplicial, supernodal };

/// Reads the matrix's upper triangle, whose columns stand in an order that fills the factor little. Several factors may
/// work at once, each in one thread, and several threads may solve by one.
class Factor {
 public:
  virtual ~Factor() = default;
  virtual void analyze(const SparseMatrix& matrix) = 0;
  /// Of a matrix with the analysed pattern. Returns the first column eliminated whose pivot is not positive, -1 where
  /// all are.
  virtual int factorize(const SparseMatrix& matrix) = 0;
  /// Right-hand sides, a column each, become solutions.
  virtual void solve(Eigen::Ref<Eigen::MatrixXd> columns) const = 0;
  /// Of factors made of dense blocks: what panels copy.
  virtual std::optional<Supernodes> supernodes() const { return std::nullopt; }
  /// Entries held for the factor.
  virtual Eigen::Index entries() const = 0;
};

/// The factor laid out as panels, SinglePanels or AxisPanels, where it is made of dense blocks.
template <class Panels>
std::optional<Panels> panels_of(const Factor& factor) {
  const std::optional<Supernodes> supernodes = factor.supernodes();
  if (!supernodes) return std::nullopt;
  return Panels(*supernodes);
}

std::unique_ptr<Factor> simplicial_factor();

/// Whether this build has CHOLMOD, without which the two below throw Unavailable.
bool has_cholmod();
std::unique_ptr<Factor> supernodal_factor();
/// An order of the graph's nodes, first to last, that fills a factor little. Found by METIS.
std::vector<int> nested_dissection(const SparseMatrix& graph);

/// An order that fills a factor little, however it is found in this build. Reads the upper triangle, diagonal included.
std::vector<int> elimination_order(const SparseMatrix& graph);

}  // namespace swage
