// Slippage of triangles, the cells of a grid that they touch, and vertices in the grid's trilinear maps (Kraevoy,
// Sheffer, Shamir, Cohen-Or 2008, sections 4 and 5).
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "cpu_steps.h"
#include "swage/thrown.h"

namespace swage {
namespace {

using Eigen::Array3d;
using Eigen::Array3i;
using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::RowVector3d;

/// A row a corner.
Matrix3d corners_of(const Mesh& mesh, Index triangle) {
  Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = mesh.positions.row(mesh.triangles(triangle, k));
  return corners;
}

/// A row a side, from corner k to corner k + 1.
Matrix3d sides_of(const Matrix3d& corners) {
  Matrix3d sides;
  for (int k = 0; k < 3; ++k) sides.row(k) = corners.row((k + 1) % 3) - corners.row(k);
  return sides;
}

/// 0 where there is none.
RowVector3d normal_of(const Matrix3d& corners) {
  Matrix3d sides = sides_of(corners);
  const double longest = sides.rowwise().norm().maxCoeff();
  if (longest == 0) return RowVector3d::Zero();
  sides /= longest;
  const RowVector3d area = sides.row(0).cross(sides.row(1));
  return area.norm() > CarryStep::kLeastHeight ? RowVector3d(area.normalized()) : RowVector3d(RowVector3d::Zero());
}

/// From corner k of a triangle to the next.
std::pair<int, int> ends_of(const Triangles& triangles, int side) {
  return {triangles(side / 3, side % 3), triangles(side / 3, (side + 1) % 3)};
}

RowVector3d mean_slippage(const CarryStep::Rest& rest, Index triangle) {
  const Mesh& mesh = *rest.mesh;
  const Matrix3d corners = corners_of(mesh, triangle);
  const RowVector3d normal = normal_of(corners);
  if (normal.isZero(0)) return RowVector3d::Zero();
  const Eigen::Vector3d lengths = sides_of(corners).rowwise().norm();
  RowVector3d sum = RowVector3d::Zero();
  double weights = 0;
  for (int k = 0; k < 3; ++k) {
    const int own = static_cast<int>(3 * triangle) + k;
    sum += lengths[k] * normal.cwiseAbs();
    weights += lengths[k];
    int side = rest.next_sides.data()[own];
    for (int seen = 0; side != own && seen < CarryStep::kMostBeside; side = rest.next_sides.data()[side], ++seen) {
      const bool same_way = ends_of(mesh.triangles, side) == ends_of(mesh.triangles, own);
      const RowVector3d other = (same_way ? -1 : 1) * normal_of(corners_of(mesh, side / 3));
      const double weight = lengths[k] * std::max(0.0, normal.dot(other));
      sum += weight * other.cwiseAbs();
      weights += weight;
    }
  }
  return sum / weights;
}

/// A box of cells: from `first` to `end` along each axis, the latter left out.
struct Block {
  Array3i first, end;

  Array3i counts() const { return end - first; }
};

/// In units of cells from the grid's corner; in the middle of the cell along an axis in which the grid has no extent.
Matrix3d in_cells(const GridShape& shape, const Matrix3d& points) {
  Matrix3d places = Matrix3d::Constant(0.5);
  for (int u = 0; u < 3; ++u) {
    if (shape.extends(u)) places.col(u) = (points.col(u).array() - shape.corner[u]) / shape.size[u] * shape.cells[u];
  }
  return places;
}

Array3i cells_at(const GridShape& shape, const Array3d& place) {
  Array3i cells;
  for (int u = 0; u < 3; ++u) cells[u] = static_cast<int>(std::clamp(std::floor(place[u]), 0.0, shape.cells[u] - 1.0));
  return cells;
}

/// Which cells of a grid a triangle touches: blocks of cells that it meets are halved, down to single ones.
class Touch {
 public:
  Touch(const GridShape& shape, const Matrix3d& points, double margin)
      : shape_(shape), corners_(in_cells(shape, points)), margin_(margin) {
    const Matrix3d sides = sides_of(corners_);
    axes_.row(0) = sides.row(0).cross(sides.row(1));
    for (int u = 0; u < 3; ++u) {
      axes_.row(1 + u) = RowVector3d::Unit(u);
      for (int k = 0; k < 3; ++k) axes_.row(4 + 3 * u + k) = RowVector3d::Unit(u).cross(sides.row(k));
    }
    const Eigen::Matrix<double, 13, 3> at = axes_ * corners_.transpose();
    low_ = at.rowwise().minCoeff();
    high_ = at.rowwise().maxCoeff();
  }

  /// Ascending.
  std::vector<int> cells() {
    const Array3d low = corners_.colwise().minCoeff(), high = corners_.colwise().maxCoeff();
    add({cells_at(shape_, low - margin_), cells_at(shape_, high + margin_) + 1});
    std::sort(cells_.begin(), cells_.end());
    return std::move(cells_);
  }

 private:
  void add(const Block& block) {
    if (!meets(block)) return;
    const Array3i counts = block.counts();
    int longest = 0;
    if (counts.maxCoeff(&longest) == 1) {
      cells_.push_back(static_cast<int>(shape_.cells.at(block.first[0], block.first[1], block.first[2])));
      return;
    }
    Block low = block, high = block;
    low.end[longest] = high.first[longest] = block.first[longest] + counts[longest] / 2;
    add(low);
    add(high);
  }

  bool meets(const Block& block) const {
    const Eigen::Vector3d half = 0.5 * block.counts().cast<double>() + margin_;
    const Eigen::Vector3d middle = 0.5 * (block.first + block.end).cast<double>();
    const Eigen::Vector<double, 13> at = axes_ * middle, reach = axes_.cwiseAbs() * half;
    return ((low_ - at).array() <= reach.array()).all() && ((high_ - at).array() >= -reach.array()).all();
  }

  const GridShape& shape_;
  Matrix3d corners_;
  double margin_;
  // Separating axes, the triangle's normal, the cells', and the products of their edges; and the triangle along them.
  Eigen::Matrix<double, 13, 3> axes_;
  Eigen::Vector<double, 13> low_, high_;
  std::vector<int> cells_;
};

RowVector3d carried_to(const GridShape& shape, const AxisValues& grid, const RowVector3d& point) {
  const Extents vertices = shape.vertices();
  const Matrix3d places = in_cells(shape, point.replicate<3, 1>());
  const Array3i cell = cells_at(shape, places.row(0).transpose().array());
  RowVector3d part = places.row(0) - cell.cast<double>().matrix().transpose(), off = RowVector3d::Zero();
  for (int u = 0; u < 3; ++u) {
    if (shape.extends(u)) continue;
    part[u] = 0;
    off[u] = point[u] - shape.corner[u];
  }
  RowVector3d sum = off;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1, j = corner >> 1 & 1, k = corner >> 2;
    const double weight =
        (i == 1 ? part[0] : 1 - part[0]) * (j == 1 ? part[1] : 1 - part[1]) * (k == 1 ? part[2] : 1 - part[2]);
    sum += weight * grid.row(vertices.at(cell[0] + i, cell[1] + j, cell[2] + k));
  }
  return sum;
}

class CpuCarry final : public CarryStep {
 public:
  explicit CpuCarry(Rest rest) : rest_(std::move(rest)) {}

  void slippage(Slice triangles, AxisValues& means) override {
    check_rows("CarryStep::slippage", "next_sides", rest_.next_sides.rows(), rest_.mesh->triangles.rows());
    means.resize(triangles.count(), 3);
#pragma omp parallel for schedule(static)
    for (Index i = 0; i < triangles.count(); ++i) means.row(i) = mean_slippage(rest_, triangles.first + i);
  }

  void count_cells(const GridShape& shape, Slice triangles, Eigen::VectorXi& counts) override {
    counts.resize(triangles.count());
    Thrown thrown;
#pragma omp parallel for schedule(dynamic, 16)
    for (Index i = 0; i < triangles.count(); ++i) {
      thrown.keep([&] { counts[i] = static_cast<int>(touched(shape, triangles.first + i).size()); });
    }
    thrown.rethrow();
  }

  void list_cells(const GridShape& shape, Slice triangles, const Eigen::VectorXi& counts,
                  Eigen::VectorXi& cells) override {
    check_rows("CarryStep::list_cells", "counts", counts.size(), triangles.count());
    std::vector<Index> firsts(static_cast<size_t>(counts.size()) + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), firsts.begin() + 1, [](Index a, Index b) { return a + b; });
    cells.resize(firsts.back());
    Thrown thrown;
#pragma omp parallel for schedule(dynamic, 16)
    for (Index i = 0; i < triangles.count(); ++i) {
      thrown.keep([&] {
        const std::vector<int> found = touched(shape, triangles.first + i);
        std::copy(found.begin(), found.end(), cells.begin() + firsts[static_cast<size_t>(i)]);
      });
    }
    thrown.rethrow();
  }

  void carry(const GridShape& shape, const AxisValues& grid, Positions& carried) override {
    check_rows("CarryStep::carry", "grid", grid.rows(), shape.vertices().count());
    const Positions& positions = rest_.mesh->positions;
    carried.resize(positions.rows(), 3);
#pragma omp parallel for schedule(static)
    for (Index v = 0; v < positions.rows(); ++v) carried.row(v) = carried_to(shape, grid, positions.row(v));
  }

 private:
  std::vector<int> touched(const GridShape& shape, Index triangle) const {
    return Touch(shape, corners_of(*rest_.mesh, triangle), cell_rounding(shape) / 2).cells();
  }

  Rest rest_;
};

}  // namespace

std::unique_ptr<CarryStep> cpu_carry(CarryStep::Rest rest) { return std::make_unique<CpuCarry>(std::move(rest)); }

}  // namespace swage
