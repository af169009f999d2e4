// The curvature step on a device.
#include <algorithm>
#include <numeric>
#include <optional>

#include "kernel.h"
#include "opencl_steps.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = CurvatureStep::Rest;

constexpr const char* kStem = "curvature";
// Fewer neighbours than coefficients tell nothing.
constexpr int kFewestNeighbours = 5;
// Vertices of so many in a row may change places, so that those of an item have as many neighbours: little is filled
// up, whatever the lists, and what an item reads stays near. A multiple of the lanes.
constexpr Index kWindow = 4096;

/// 1 / the shape's size, which the device has as unit. So single precision bears any size and any place.
double inverse_extent(const Positions& positions) {
  if (positions.rows() == 0) return 1;
  const double extent = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  return extent > 0 ? 1 / extent : 1;
}

/// Numbers a row of places.
int width(Precision precision) { return precision == Precision::single ? 6 : 3; }

/// Positions about the first vertex and, in single precision, what rounding takes from them.
Eigen::MatrixXd places(const Positions& positions, double per_length, Precision precision) {
  Eigen::MatrixXd table(positions.rows(), width(precision));
  if (positions.rows() == 0) return table;
  const Positions scaled = (positions.rowwise() - positions.row(0).eval()) * per_length;
  table.leftCols<3>() = scaled;
  if (precision == Precision::single) table.rightCols<3>() = scaled - scaled.cast<float>().cast<double>();
  return table;
}

int neighbours_of(const Rest& rest, int v) {
  const auto at = static_cast<size_t>(v);
  const int count = rest.offsets[at + 1] - rest.offsets[at];
  return count < kFewestNeighbours ? 0 : count;
}

/// The vertices lane by lane, those with the most neighbours first; the last one again in the lanes left over.
Eigen::VectorXi in_lanes(const Rest& rest, int lanes) {
  const Index count = rest.positions.rows();
  Eigen::VectorXi vertices((count + lanes - 1) / lanes * lanes);
  std::iota(vertices.begin(), vertices.end(), 0);
#pragma omp parallel for schedule(dynamic)
  for (Index w = 0; w < count; w += kWindow) {
    std::stable_sort(vertices.begin() + w, vertices.begin() + std::min(w + kWindow, count),
                     [&](int a, int b) { return neighbours_of(rest, a) > neighbours_of(rest, b); });
  }
  if (count > 0) vertices.tail(vertices.size() - count).setConstant(vertices[count - 1]);
  return vertices;
}

/// Where the slots of each item begin: its vertices, and as many neighbours as its first vertex has.
Eigen::VectorXi first_slots(const Rest& rest, const Eigen::VectorXi& vertices, int lanes) {
  Eigen::VectorXi first = Eigen::VectorXi::Zero(vertices.size() / lanes + 1);
  for (Index i = 1; i < first.size(); ++i) first[i] = first[i - 1] + 1 + neighbours_of(rest, vertices[(i - 1) * lanes]);
  return first;
}

using Slots = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A slot a row, filled up with the lane's vertex itself; vertices by where their rows of `width` numbers begin.
Slots slots_of(const Rest& rest, const Eigen::VectorXi& vertices, const Eigen::VectorXi& first, int lanes, int width) {
  Slots slots(first.tail<1>()[0], lanes);
#pragma omp parallel for schedule(static)
  for (Index item = 0; item < first.size() - 1; ++item) {
    for (int lane = 0; lane < lanes; ++lane) {
      const int v = vertices[item * lanes + lane], known = neighbours_of(rest, v);
      const int* const neighbours = rest.neighbours.data() + rest.offsets[static_cast<size_t>(v)];
      auto own = slots.col(lane).segment(first[item], first[item + 1] - first[item]);
      for (Index k = 0; k < own.size(); ++k) own[k] = width * (k > 0 && k <= known ? neighbours[k - 1] : v);
    }
  }
  return slots;
}

class OpenClCurvature final : public CurvatureStep {
 public:
  OpenClCurvature(const Queue& queue, const Rest& rest)
      : OpenClCurvature(queue, rest, in_lanes(rest, queue.context->lanes(kStem))) {}

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) override {
    if (!directions_) directions_.emplace(queue_, 0);
    launch(0);
    take(curvatures);
  }

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures, Positions& directions) override {
    if (!directions_ || directions_->size() == 0) directions_.emplace(queue_, Index{3} * stride_);
    launch(1);
    take(curvatures);
    Positions in_lanes(stride_, 3);
    directions_->download(in_lanes, Layout::rows);
    directions.resize(count_, 3);
    directions(vertices_.head(count_), Eigen::all) = in_lanes.topRows(count_);
  }

 private:
  OpenClCurvature(const Queue& queue, const Rest& rest, const Eigen::VectorXi& vertices)
      : OpenClCurvature(queue, rest, vertices, first_slots(rest, vertices, queue.context->lanes(kStem))) {}

  OpenClCurvature(const Queue& queue, const Rest& rest, const Eigen::VectorXi& vertices, const Eigen::VectorXi& first)
      : queue_(queue),
        count_(rest.positions.rows()),
        items_(static_cast<int>(first.size()) - 1),
        stride_(static_cast<int>(vertices.size())),
        per_length_(inverse_extent(rest.positions)),
        vertices_(vertices),
        first_slots_(queue, first),
        slots_(queue, slots_of(rest, vertices, first, queue.context->lanes(kStem), width(queue.context->precision())),
               Layout::rows),
        places_(queue, places(rest.positions, per_length_, queue.context->precision()), Layout::rows),
        normals_(queue, Positions(rest.normals(vertices, Eigen::all))),  // An expression would be copied by blocks.
        curvatures_(queue, Index{2} * stride_),
        curvatures_in_lanes_(stride_, 2),
        fit_(queue, kStem, "fit_curvatures") {}

  void launch(int with_directions) {
    fit_.launch(items_, stride_, first_slots_, slots_, places_, normals_, curvatures_, with_directions, *directions_);
  }

  void take(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) {
    curvatures_.download(curvatures_in_lanes_, Layout::rows);
    curvatures.resize(count_, 2);
    curvatures(vertices_.head(count_), Eigen::all) = per_length_ * curvatures_in_lanes_.topRows(count_);
  }

  Queue queue_;
  Index count_;
  int items_, stride_;
  double per_length_;
  Eigen::VectorXi vertices_;
  Ints first_slots_, slots_;
  Reals places_, normals_, curvatures_;
  std::optional<Reals> directions_;  // None, until they are asked for.
  Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> curvatures_in_lanes_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<CurvatureStep> opencl_curvature(const SharedContext& context, const Rest& rest) {
  return std::make_unique<OpenClCurvature>(Queue(context), rest);
}

}  // namespace swage
