// Scales and grid vertices against small dense systems, made from the energies' terms one by one.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "assemble.h"
#include "bounded.h"
#include "cell_maps.h"
#include "scales.h"

namespace swage::test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Factors = Eigen::RowVector3d;

/// Sum of (row · x - target)² as it grows.
struct Squares {
  explicit Squares(Index unknowns) : matrix(MatrixXd::Zero(unknowns, unknowns)), side(VectorXd::Zero(unknowns)) {}

  void add(double weight, const std::vector<std::pair<Index, double>>& row, double target) {
    for (const auto& [i, a] : row) {
      for (const auto& [j, b] : row) matrix(i, j) += weight * a * b;
      side[i] += weight * a * target;
    }
  }

  MatrixXd matrix;
  VectorXd side;
};

/// Minimum subject to constraints · x = due, by Lagrange multipliers.
VectorXd constrained(const Squares& squares, const MatrixXd& constraints, const VectorXd& due) {
  const Index n = squares.side.size(), m = due.size();
  MatrixXd matrix = MatrixXd::Zero(n + m, n + m);
  matrix.topLeftCorner(n, n) = squares.matrix;
  matrix.topRightCorner(n, m) = constraints.transpose();
  matrix.bottomLeftCorner(m, n) = constraints;
  VectorXd side(n + m);
  side << squares.side, due;
  return matrix.fullPivLu().solve(side).head(n);
}

template <typename Work>
void each_cell(const Extents& cells, const Work& work) {
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) work(std::array<int, 3>{i, j, k}, cells.at(i, j, k));
    }
  }
}

Squares scale_energy(const GridShape& shape, const CellMap& map, const Factors& S, double g, double size_weight) {
  const Index count = shape.cells.count();
  Squares squares(3 * count);
  each_cell(shape.cells, [&](const std::array<int, 3>& at, Index c) {
    const auto a = [&](int u) { return map.theta(c, u) * g + (1 - map.theta(c, u)) * S[u]; };
    for (const auto& [u, v] : {std::pair{0, 1}, {1, 2}, {0, 2}}) {
      const double weight = std::max(std::min(map.theta(c, u), map.theta(c, v)), 1e-4);
      squares.add(weight, {{u * count + c, 1 / a(u)}, {v * count + c, -1 / a(v)}}, 0);
    }
    for (int w = 0; w < 3; ++w) {
      squares.add(size_weight * map.theta(c, w), {{w * count + c, 1}}, 1);
      if (at[static_cast<size_t>(w)] + 1 == shape.cells[w]) continue;
      const Index d = c + shape.cells.stride(w);
      for (int u = 0; u < 3; ++u) {
        if (u == w) continue;
        squares.add(4.0 / 3 * map.phi[c] * map.phi[d], {{u * count + c, 1}, {u * count + d, -1}}, 0);
      }
    }
  });
  return squares;
}

/// A row each for the sums of rows of cells; `due` are their lengths.
MatrixXd row_sums(const GridShape& shape, const Factors& S, VectorXd& due) {
  const Index count = shape.cells.count();
  std::vector<std::pair<int, Index>> rows;
  each_cell(shape.cells, [&](const std::array<int, 3>& at, Index c) {
    for (int u = 0; u < 3; ++u) {
      if (at[static_cast<size_t>(u)] == 0) rows.emplace_back(u, c);
    }
  });
  MatrixXd sums = MatrixXd::Zero(static_cast<Index>(rows.size()), 3 * count);
  due.resize(sums.rows());
  for (Index r = 0; r < sums.rows(); ++r) {
    const auto& [u, first] = rows[static_cast<size_t>(r)];
    for (int i = 0; i < shape.cells[u]; ++i) sums(r, u * count + first + i * shape.cells.stride(u)) = 1;
    due[r] = S[u] * shape.cells[u];
  }
  return sums;
}

VectorXd stacked(const AxisValues& values) {
  VectorXd result(values.size());
  result << values.col(0), values.col(1), values.col(2);
  return result;
}

/// That x is least where entries · x = least or above it, and constraints · x stay: the slope is what constraints and
/// entries at their bound pull, and those only from below. How many are at the bound.
Index expect_least(const Squares& squares, const MatrixXd& constraints, const MatrixXd& entries, const VectorXd& least,
                   const VectorXd& x) {
  const VectorXd above = entries * x - least;
  EXPECT_GT(above.minCoeff(), -1e-9);
  std::vector<Index> at_bound;
  for (Index e = 0; e < above.size(); ++e) {
    if (above[e] < 1e-9) at_bound.push_back(e);
  }
  const auto held = static_cast<Index>(at_bound.size());
  MatrixXd pulls(x.size(), constraints.rows() + held);
  pulls.leftCols(constraints.rows()) = constraints.transpose();
  for (Index h = 0; h < held; ++h) pulls.col(constraints.rows() + h) = entries.row(at_bound[static_cast<size_t>(h)]);
  const VectorXd slope = squares.matrix * x - squares.side;
  const VectorXd multipliers = pulls.completeOrthogonalDecomposition().solve(slope);
  EXPECT_LT((pulls * multipliers - slope).cwiseAbs().maxCoeff(), 1e-8);
  if (held > 0) {
    EXPECT_GT(multipliers.tail(held).minCoeff(), -1e-8);
  }
  return held;
}

struct ExactCase {
  GridShape shape;
  CellMap map;
};

std::vector<ExactCase> cases() {
  std::vector<ExactCase> result;
  for (const GridShape& shape : {unit_cells(4, 3, 5), unit_cells(6, 6, 6)}) {
    for (const CellMap& map : {random_map(shape, 1), checkered_map(shape), one_cell_map(shape), ball_map(shape, 0.4)}) {
      result.push_back({shape, map});
    }
  }
  return result;
}

double unit(const Factors& S) { return std::clamp(1.0, S.minCoeff(), S.maxCoeff()); }

TEST(ScaleSolve, EqualsADenseSolveWhereNoBoundIsMet) {
  int compared = 0;
  for (const auto& [shape, map] : cases()) {
    for (const Factors& S : {Factors(1.4, 1, 1), Factors(1, 1, 0.8), Factors(1.2, 1.5, 1.1)}) {
      VectorXd due;
      const MatrixXd sums = row_sums(shape, S, due);
      const VectorXd x = constrained(scale_energy(shape, map, S, unit(S), 0), sums, due);
      const Scales scales = ScaleSolve(shape, map).solve(S, {0, 1e-12});
      if (x.minCoeff() < kLeastScale) continue;
      EXPECT_EQ(scales.at_bound, 0);
      EXPECT_LT((stacked(scales.values) - x).cwiseAbs().maxCoeff(), 1e-8) << S;
      ++compared;
    }
  }
  EXPECT_GT(compared, 15);
}

TEST(ScaleSolve, KeepsSizesAsADenseSolveDoes) {
  const GridShape shape = unit_cells(4, 3, 5);
  const CellMap map = random_map(shape, 4);
  const Factors S(1.5, 1.2, 1.1);
  VectorXd due;
  const MatrixXd sums = row_sums(shape, S, due);
  const VectorXd x = constrained(scale_energy(shape, map, S, 1, 0.7), sums, due);
  ASSERT_GT(x.minCoeff(), kLeastScale);
  EXPECT_LT((stacked(ScaleSolve(shape, map).solve(S, {0.7, 1e-12}).values) - x).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(ScaleSolve, IsLeastWithinTheBounds) {
  Index held = 0;
  for (const auto& [shape, map] : cases()) {
    for (const Factors& S : {Factors(0.05, 1, 1), Factors(1, 20, 1), Factors(0.3, 1, 3), Factors(2, 1, 1)}) {
      SCOPED_TRACE(S);
      VectorXd due;
      const MatrixXd sums = row_sums(shape, S, due);
      const Scales scales = ScaleSolve(shape, map).solve(S, {0, 1e-12});
      EXPECT_TRUE(scales.converged);
      const VectorXd x = stacked(scales.values);
      EXPECT_LT((sums * x - due).cwiseAbs().maxCoeff(), 1e-10);
      AxisValues least(shape.cells.count(), 3);
      for (int u = 0; u < 3; ++u) least.col(u).setConstant(kLeastScale * std::min(1.0, S[u]));
      held += expect_least(scale_energy(shape, map, S, unit(S), 0), sums, MatrixXd::Identity(x.size(), x.size()),
                           stacked(least), x);
    }
  }
  EXPECT_GT(held, 200);
}

/// Scales that no grid could have.
AxisValues clashing_scales(const GridShape& shape, double from, double to) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> part(from, to);
  AxisValues scales(shape.cells.count(), 3);
  for (Index i = 0; i < scales.size(); ++i) scales.data()[i] = part(random);
  return scales;
}

/// Along the axis u, in mesh units.
Squares assembly_energy(const GridShape& shape, const CellMap& map, const AxisValues& scales, int u) {
  const Extents vertices = shape.vertices();
  Squares squares(vertices.count());
  each_cell(shape.cells, [&](const std::array<int, 3>& at, Index c) {
    for (int v = 0; v < 3; ++v) {
      for (int corner = 0; corner < 8; ++corner) {
        if ((corner >> v & 1) == 1) continue;
        const Index first = vertices.at(at[0] + (corner & 1), at[1] + (corner >> 1 & 1), at[2] + (corner >> 2));
        const double length = shape.size[u] / shape.cells[u];
        squares.add(v == u ? std::max(map.theta(c, u), 1e-3) : 0.05 * map.phi[c],
                    {{first + vertices.stride(v), 1}, {first, -1}}, v == u ? scales(c, u) * length : 0);
      }
    }
  });
  return squares;
}

/// Rows for the vertices on the outer faces across u, and for the edges along u.
struct AssemblyRows {
  AssemblyRows(const GridShape& shape, int u, double factor) {
    const Extents vertices = shape.vertices();
    std::vector<std::pair<Index, double>> held;
    std::vector<Index> firsts;
    each_cell(vertices, [&](const std::array<int, 3>& at, Index v) {
      const int along = at[static_cast<size_t>(u)];
      if (along == 0) held.emplace_back(v, shape.corner[u]);
      if (along == shape.cells[u]) held.emplace_back(v, shape.corner[u] + factor * shape.size[u]);
      if (along < shape.cells[u]) firsts.push_back(v);
    });
    faces = MatrixXd::Zero(static_cast<Index>(held.size()), vertices.count());
    places.resize(faces.rows());
    for (Index r = 0; r < faces.rows(); ++r) {
      faces(r, held[static_cast<size_t>(r)].first) = 1;
      places[r] = held[static_cast<size_t>(r)].second;
    }
    edges = MatrixXd::Zero(static_cast<Index>(firsts.size()), vertices.count());
    for (Index e = 0; e < edges.rows(); ++e) {
      edges(e, firsts[static_cast<size_t>(e)]) = -1;
      edges(e, firsts[static_cast<size_t>(e)] + vertices.stride(u)) = 1;
    }
  }

  MatrixXd faces, edges;
  VectorXd places;
};

TEST(Assembly, EqualsADenseSolveWhereNoBoundIsMet) {
  const GridShape shape = {{{4, 3, 5}}, {-1, 2, 3}, {2, 3, 4}};
  const CellMap map = random_map(shape, 6);
  const AxisValues scales = clashing_scales(shape, 0.8, 1.3);
  const Factors S(1.3, 0.9, 1);
  const GridVertices placed = Assembly(shape, map).place(scales, S, {1e-12});
  EXPECT_EQ(placed.at_bound, 0);
  EXPECT_EQ(placed.stiffened, 0);
  for (int u = 0; u < 3; ++u) {
    const AssemblyRows rows(shape, u, S[u]);
    const VectorXd x = constrained(assembly_energy(shape, map, scales, u), rows.faces, rows.places);
    EXPECT_LT((placed.positions.col(u) - x).cwiseAbs().maxCoeff(), 1e-8);
  }
}

TEST(Assembly, IsLeastWithinTheBounds) {
  Index held = 0;
  int free_of_folds = 0;
  for (const auto& [shape, map] : cases()) {
    // Edges far shorter than the bound are asked for along one axis: no cell folds by that alone.
    for (int u = 0; u < 3; ++u) {
      AxisValues scales = AxisValues::Ones(shape.cells.count(), 3);
      scales.col(u) = clashing_scales(shape, -3, 4).col(u);
      const GridVertices placed = Assembly(shape, map).place(scales, {1, 1, 1}, {1e-12});
      EXPECT_TRUE(placed.converged);
      if (placed.stiffened > 0) continue;
      ++free_of_folds;
      const AssemblyRows rows(shape, u, 1);
      EXPECT_LT((rows.faces * placed.positions.col(u) - rows.places).cwiseAbs().maxCoeff(), 1e-12);
      held += expect_least(assembly_energy(shape, map, scales, u), rows.faces, rows.edges,
                           VectorXd::Constant(rows.edges.rows(), kLeastEdge), placed.positions.col(u));
    }
  }
  EXPECT_GT(free_of_folds, 12);
  EXPECT_GT(held, 50);
}

TEST(BlockPivoting, FindsWhatTryingAllSetsFinds) {
  constexpr int kCount = 8;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::srand(seed);
    // Entries of both signs: all at once may go round in circles.
    const MatrixXd root = MatrixXd::Random(kCount, kCount);
    const MatrixXd matrix = root.transpose() * root + 1e-3 * MatrixXd::Identity(kCount, kCount);
    const VectorXd side = VectorXd::Random(kCount);
    const auto least = [&](const AtBound& at_bound) {
      MatrixXd free = matrix;
      VectorXd right = side;
      for (int i = 0; i < kCount; ++i) {
        if (at_bound[static_cast<size_t>(i)] == 0) continue;
        free.row(i).setZero();
        free(i, i) = 1;
        right[i] = 0;
      }
      return VectorXd(free.fullPivLu().solve(right));
    };
    VectorXd best = VectorXd::Zero(kCount);
    const auto energy = [&](const VectorXd& x) { return 0.5 * x.dot(matrix * x) - side.dot(x); };
    for (int set = 0; set < 1 << kCount; ++set) {
      AtBound at_bound(kCount);
      for (int i = 0; i < kCount; ++i) at_bound[static_cast<size_t>(i)] = static_cast<char>(set >> i & 1);
      const VectorXd x = least(at_bound);
      if (x.minCoeff() >= -1e-12 && energy(x) < energy(best)) best = x;
    }
    AtBound at_bound(kCount, 0);
    BlockPivoting pivoting;
    VectorXd x;
    int rounds = 0;
    while (true) {
      x = least(at_bound);
      const VectorXd slope = matrix * x - side;
      Eigen::ArrayXd measure(kCount);
      for (int i = 0; i < kCount; ++i) measure[i] = at_bound[static_cast<size_t>(i)] != 0 ? slope[i] : x[i];
      if (!pivoting.exchange(measure, 1e-12, at_bound)) break;
      ASSERT_LT(++rounds, 1000) << seed;
    }
    EXPECT_LT((x - best).cwiseAbs().maxCoeff(), 1e-9) << seed;
  }
}

}  // namespace
}  // namespace swage::test
