// A sparse symmetric positive definite system whose unknowns come in groups, such as the three of a vertex.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cancel.h"
#include "factor.h"
#include "swage/error.h"

namespace swage {

/// A matrix that is not positive definite, first seen at a group.
class Indefinite : public Unsolvable {
 public:
  Indefinite(Eigen::Index unknowns, int element);
  Eigen::Index unknowns() const { return unknowns_; }
  int element() const { return element_; }

 private:
  Eigen::Index unknowns_;
  int element_;
};

/// The unknowns of a group stand in rows of three. Two groups couple row by row: through a 3 × 3 block that joins
/// their first rows, the same or another for the second, and so on. So a vertex is a group of one row, and a
/// triangle's 3 × 3 transform is a group of three.
///
/// Groups are kept in an order that fills the factor little, chosen once from the couplings. Values are added in
/// place, and the factor reads them in place.
class BlockSystem {
 public:
  /// `couplings`: pairs of different groups that share a term, in any order, repeats allowed. Without `kind` the factor
  /// is the one that is faster at this size, of those that this build has; of kind none, groups stay in the order
  /// given, and nothing that needs a factor may be called. Throws Unsolvable where the factor would have more entries
  /// than int counts.
  BlockSystem(int group_count, int rows_per_group, const std::vector<std::pair<int, int>>& couplings,
              std::optional<FactorKind> kind = {});

  /// The same couplings and values, in an order that both share; its factor is its own, and not made yet.
  BlockSystem unfactored() const;

  void set_zero() { values().setZero(); }
  /// All values of the matrix, to keep a constant part and start the next assembly from it.
  Eigen::Map<Eigen::VectorXd> values() { return {matrix_.valuePtr(), matrix_.nonZeros()}; }

  /// Adds the symmetric `block`, as wide as a group, at (group, group).
  void add(int group, const Eigen::Ref<const Eigen::MatrixXd>& block);
  /// Adds `block` at (i, j) and its transpose at (j, i), for row `row` of the groups.
  void add(int i, int j, int row, const Eigen::Matrix3d& block);

  /// Pairs of groups of one row, seen from each group, with where their blocks stand.
  struct Stars {
    struct Ray {
      int pair, above;  ///< `above`: where the pair's block begins in the columns of the group, -1 in the other's.
    };
    std::vector<int> offsets;  ///< Rays of a group stand at offsets[group] .. offsets[group + 1], by pair.
    std::vector<Ray> rays;
  };
  /// Pairs are coupled, and of different groups.
  Stars stars(const Eigen::Ref<const Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>>& pairs) const;
  /// Adds the matrix of sum_pairs (x_i - x_j)' block (x_i - x_j), blocks as xx, xy, xz, yy, yz, zz.
  void add_differences(const Stars& stars, const Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>& blocks);

  /// Throws Unsolvable, naming the group, where the matrix is not positive definite. Asks between analysing the
  /// pattern and making the factor, but not within either.
  void factor(const Poll& poll = {});
  /// The solutions for right-hand sides, a column each, of all groups one after the other. factor() comes first.
  /// May be called from several threads.
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& right_hand_sides) const;

  /// For systems solved over and over from a guess: keeps the factor in single precision alone, where it is made of
  /// dense blocks and a solve by it leaves less than a tenth of the error. Returns whether it does.
  bool keep_single();
  /// A guess at the solution, improved by one solve in single precision for what it leaves of the right-hand side.
  /// May be called from several threads. keep_single() comes first.
  Eigen::VectorXd improved(const Eigen::Ref<const Eigen::VectorXd>& right_hand_side,
                           const Eigen::Ref<const Eigen::VectorXd>& guess) const;
  /// The solution from a guess: exactly, by a factor made for it, or to 1e-5 of the guess's error, by conjugate
  /// gradients that the last factor preconditions, whichever is less work. forget_factor() makes it the former.
  Eigen::VectorXd solve_near(const Eigen::Ref<const Eigen::VectorXd>& right_hand_side,
                             const Eigen::Ref<const Eigen::VectorXd>& guess);
  void forget_factor() { factor_is_near_ = false; }
  bool single() const { return panels_.has_value(); }

  /// The matrix times a vector of all groups one after the other.
  Eigen::VectorXd times(const Eigen::Ref<const Eigen::VectorXd>& vector) const;

  bool has_factor() const { return factor_ || panels_; }
  Eigen::Index unknowns() const { return matrix_.rows(); }
  Eigen::Index factor_entries() const { return factor_ && analyzed_ ? factor_->entries() : kept_entries_; }
  /// Of the matrix and its factor.
  std::size_t bytes() const;

 private:
  /// y = matrix x, both in order.
  void multiply(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::VectorXd& y) const;
  template <int kRows>
  void multiply_rows(const double* x, double* y) const;
  /// Group after group as given ⇄ in the order of elimination.
  void into_order(const Eigen::Ref<const Eigen::MatrixXd>& columns, Eigen::MatrixXd& ordered) const;
  Eigen::MatrixXd as_given(const Eigen::MatrixXd& ordered) const;
  void lay_out();
  /// Where the first entry of block (above, column's group) stands in each of the column's entries.
  int offset(int above, int group) const;

  struct Ray {
    int place, above;  // Whose column, and where in it.
  };
  struct Pattern {
    std::vector<int> place;               // Group → its place in the order.
    std::vector<std::vector<int>> above;  // For each place the places before it that it couples to, ascending.
    std::vector<std::vector<Ray>> below;  // For each place the others' blocks above whose place it is.
    bool as_given = false;                // Whether places are those of the groups.
    FactorKind kind = FactorKind::simplicial;
  };
  static std::shared_ptr<const Pattern> pattern(int group_count, int width,
                                                const std::vector<std::pair<int, int>>& couplings,
                                                std::optional<FactorKind> kind);
  static Pattern order(int group_count, const std::vector<std::pair<int, int>>& couplings, bool as_given);
  /// Entries of the factor below its diagonal and on it, by blocks. Throws where int cannot count them.
  static std::int64_t expected_entries(const Pattern& pattern, int width);
  BlockSystem(int width, std::shared_ptr<const Pattern> pattern);

  int width_;  // Unknowns of a group.
  std::shared_ptr<const Pattern> pattern_;
  SparseMatrix matrix_;  // Upper triangle, groups in order.
  std::unique_ptr<Factor> factor_;
  std::optional<SinglePanels> panels_;  // In its place.
  Eigen::Index kept_entries_ = 0;
  bool factor_is_near_ = false;  // Whether it is worth preconditioning with.
  bool analyzed_ = false;
};

}  // namespace swage
