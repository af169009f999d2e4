// The global step of local-global methods: for the matrices of elements the vertices whose edges fit them best. A
// sparse system, the same for x, y and z.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "factor.h"
#include "swage/mesh.h"
#include "swage/steps.h"

namespace swage {

/// Where sum over elements n and their pairs p of w_p |e_p - M_n e0_p|² is least, e the edge and e0 the edge at rest:
/// laplacian · vertices = right-hand sides of the matrices M.
class LaplacianSystem {
 public:
  LaplacianSystem() = default;
  explicit LaplacianSystem(const PairsRest& pairs);

  /// #V × #V. A vertex of no pair has 1 on its diagonal.
  const SparseMatrix& laplacian() const { return laplacian_; }
  Eigen::Index element_count() const { return element_count_; }

  /// #V × 3; `matrices`: #N × 9. Of vertices of no pair where they are at rest.
  Positions right_hand_sides(const Transforms& matrices) const;

  std::size_t bytes() const;

 private:
  /// sum over the pairs of an element that end at a vertex of w e0, those that begin there with the other sign.
  struct Pull {
    int element;
    Eigen::Vector3d edges;
  };
  using EndPull = std::pair<int, Pull>;  // A vertex, and what it gets.

  static std::vector<EndPull> pulls(const PairsRest& pairs);

  SparseMatrix laplacian_;
  Eigen::Index element_count_ = 0;
  Positions rest_;
  std::vector<int> offsets_ = {};  // Of a vertex the pulls stand at offsets_[v] .. offsets_[v + 1], by element.
  std::vector<Pull> pulls_ = {};
};

/// A point of up to three vertices that is drawn to its target: the weight of |point - target|².
struct SoftPoint {
  std::array<int, 3> vertices;
  Eigen::Vector3d factors;
  double weight;
  bool operator==(const SoftPoint&) const = default;
};

/// What is held, and where.
struct HeldPoints {
  std::vector<int> fixed = {};  ///< Vertices, ascending, each once.
  Positions fixed_targets = {};
  std::vector<SoftPoint> soft = {};
  Positions soft_targets = {};
};

/// The laplacian with points held, factored once for all targets and matrices. The same bytes from any number of
/// threads.
class HeldLaplacian {
 public:
  /// Throws Indefinite, naming a vertex, where what is left to find is singular.
  HeldLaplacian(const LaplacianSystem& system, const HeldPoints& points);

  /// Whether the same points are held, wherever.
  bool holds(const HeldPoints& points) const { return points.fixed == fixed_ && points.soft == soft_; }

  /// All vertices, the points at their targets. `right_hand_sides`: #V × 3, of the matrices alone.
  Positions solve(const Positions& right_hand_sides, const HeldPoints& points) const;

  std::size_t coupling_bytes() const;
  std::size_t factor_bytes() const;

 private:
  void place_free(const SparseMatrix& matrix);
  SparseMatrix among_free(const SparseMatrix& matrix) const;
  void couple(const SparseMatrix& matrix);

  std::vector<int> fixed_;
  std::vector<SoftPoint> soft_;
  std::vector<int> free_;   // In the order of elimination.
  std::vector<int> place_;  // Of each vertex in free_; below 0 where it is fixed.
  SparseMatrix coupling_;   // #free × #fixed
  std::unique_ptr<Factor> factor_;
  std::optional<AxisPanels> panels_;  // In its place, of a factor made of dense blocks.
};

/// The last one made, for whoever holds the same points next. Threads may share it.
class LastHeld {
 public:
  std::shared_ptr<const HeldLaplacian> get(const LaplacianSystem& system, const HeldPoints& points);

 private:
  std::mutex mutex_;
  std::shared_ptr<const HeldLaplacian> last_;
};

}  // namespace swage
