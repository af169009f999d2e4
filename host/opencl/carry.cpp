// The carry step on a device.
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "kernel.h"
#include "opencl_steps.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr const char* kStem = "carry";

/// Of single precision, in places along the longest count of cells.
constexpr double kSingleRounding = 1e-6;

using Rows3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// As kernels/carry.cl takes a grid, from `origin`.
Rows3 grid_of(const GridShape& shape, const Eigen::RowVector3d& origin, double place_without_extent) {
  Rows3 grid;
  for (int u = 0; u < 3; ++u) {
    const bool extends = shape.extends(u);
    grid.row(u) << shape.corner[u] - origin[u], extends ? shape.cells[u] / shape.size[u] : 0,
        extends ? 0 : place_without_extent;
  }
  return grid;
}

/// Where each one's begin.
Eigen::VectorXi offsets_of(const Eigen::VectorXi& counts) {
  Eigen::VectorXi offsets(counts.size());
  std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
  return offsets;
}

class OpenClCarry final : public CarryStep {
 public:
  OpenClCarry(const Queue& queue, Rest rest)
      : queue_(queue),
        rest_(std::move(rest)),
        rounds_(queue.context->precision() == Precision::single && !queue.context->in_host_memory()),
        grid_(queue, 9),
        positions_(queue, rest_.mesh->positions.size()),
        residues_(queue, rounds_ ? rest_.mesh->positions.size() : 0),
        shown_(queue_, {&positions_}) {
    const Positions& positions = rest_.mesh->positions;
    if (!rounds_ || positions.rows() == 0) {
      positions_.show(positions);
      return;
    }
    origin_ = positions.colwise().minCoeff();
    const Positions off = positions.rowwise() - origin_;
    positions_.show(off);
    residues_.upload(off - off.cast<float>().cast<double>(), Layout::rows);
  }

  void slippage(Slice triangles, AxisValues& means) override {
    check_rows("CarryStep::slippage", "next_sides", rest_.next_sides.rows(), rest_.mesh->triangles.rows());
    if (!next_sides_) next_sides_.emplace(queue_, rest_.next_sides, Layout::rows);
    means.resize(triangles.count(), 3);
    HostRows result(queue_, means.size());
    const Visit visit(queue_, {&result});
    result.lend(means);
    mean_slippages_.launch(triangles.count(), static_cast<int>(triangles.first), kMostBeside, HostNumber{kLeastHeight},
                           corners(), *next_sides_, positions_, residues_, result);
    result.take_back(means);
  }

  void count_cells(const GridShape& shape, Slice triangles, Eigen::VectorXi& counts) override {
    counts.resize(triangles.count());
    const Ints numbers(queue_, counts.size());
    touch(shape, triangles, 0, numbers, numbers);
    numbers.download(counts);
  }

  void list_cells(const GridShape& shape, Slice triangles, const Eigen::VectorXi& counts,
                  Eigen::VectorXi& cells) override {
    check_rows("CarryStep::list_cells", "counts", counts.size(), triangles.count());
    cells.resize(counts.cast<Index>().sum());
    const Ints result(queue_, cells.size());
    touch(shape, triangles, 1, Ints(queue_, offsets_of(counts)), result);
    result.download(cells);
  }

  double cell_rounding(const GridShape& shape) const override {
    if (!rounds_) return CarryStep::cell_rounding(shape);
    return kSingleRounding * std::max({shape.cells[0], shape.cells[1], shape.cells[2]});
  }

  void carry(const GridShape& shape, const AxisValues& grid, Positions& carried) override {
    check_rows("CarryStep::carry", "grid", grid.rows(), shape.vertices().count());
    carried.resize(rest_.mesh->positions.rows(), 3);
    HostRows vertices(queue_, grid.size()), result(queue_, carried.size());
    const Rows3 numbers = grid_of(shape, origin_, 0);
    const Visit visit(queue_, {&grid_, &vertices, &result});
    grid_.show(numbers);
    rounds_ ? vertices.show(AxisValues(grid.rowwise() - origin_)) : vertices.show(grid);
    result.lend(carried);
    carry_vertices_.launch(carried.rows(), shape.cells[0], shape.cells[1], shape.cells[2], grid_, vertices, positions_,
                           residues_, result);
    result.take_back(carried);
    if (rounds_) carried.rowwise() += origin_;
  }

 private:
  void touch(const GridShape& shape, Slice triangles, int lists, const Ints& numbers, const Ints& cells) {
    const Rows3 grid = grid_of(shape, origin_, 0.5);
    const Visit visit(queue_, {&grid_});
    grid_.show(grid);
    touch_cells_.launch(triangles.count(), static_cast<int>(triangles.first), shape.cells[0], shape.cells[1],
                        shape.cells[2], HostNumber{cell_rounding(shape) / 2}, grid_, corners(), positions_, residues_,
                        lists, numbers, cells);
  }

  const Ints& corners() {
    if (!corners_) corners_.emplace(queue_, rest_.mesh->triangles, Layout::rows);
    return *corners_;
  }

  Queue queue_;
  Rest rest_;
  bool rounds_;  // Whether the device sees other positions than the host has: those from the origin, and residues.
  Eigen::RowVector3d origin_ = Eigen::RowVector3d::Zero();
  HostRows grid_, positions_;
  Reals residues_;
  Visit shown_;                               // As long as this lives.
  std::optional<Ints> corners_, next_sides_;  // None, until they are asked for.
  Kernel mean_slippages_{queue_, kStem, "mean_slippages"};
  Kernel touch_cells_{queue_, kStem, "touch_cells"};
  Kernel carry_vertices_{queue_, kStem, "carry_vertices"};
};

}  // namespace

std::unique_ptr<CarryStep> opencl_carry(const SharedContext& context, CarryStep::Rest rest) {
  return std::make_unique<OpenClCarry>(Queue(context), std::move(rest));
}

}  // namespace swage
