// The curvature step on a device.
#include <algorithm>
#include <numeric>

#include "kernel.h"
#include "opencl_steps.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = CurvatureStep::Rest;

// Fewer neighbours than coefficients tell nothing.
constexpr int kFewestNeighbours = 5;
// Vertices this near in order may change places, so that those of an item have as many neighbours: no list is then
// filled up much, and what an item reads stays near.
constexpr Index kWindow = 4096;

/// 1 / the shape's size, which the device has as unit. So single precision bears any size and any place.
double inverse_extent(const Positions& positions) {
  if (positions.rows() == 0) return 1;
  const double extent = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  return extent > 0 ? 1 / extent : 1;
}

/// #V × 8: positions about the first vertex, and what rounding to single precision takes from them.
Eigen::Matrix<double, Eigen::Dynamic, 8> places(const Positions& positions, double per_length, Precision precision) {
  Eigen::Matrix<double, Eigen::Dynamic, 8> table = Eigen::Matrix<double, Eigen::Dynamic, 8>::Zero(positions.rows(), 8);
  if (positions.rows() == 0) return table;
  const Positions scaled = (positions.rowwise() - positions.row(0).eval()) * per_length;
  table.leftCols<3>() = scaled;
  if (precision == Precision::single) table.middleCols<3>(4) = scaled - scaled.cast<float>().cast<double>();
  return table;
}

int neighbours_of(const Rest& rest, int v) {
  const auto at = static_cast<size_t>(v);
  const int count = rest.offsets[at + 1] - rest.offsets[at];
  return count < kFewestNeighbours ? 0 : count;
}

/// The vertices as the device has them: `lanes` an item, and the first vertex in the lanes left over.
struct Items {
  Items(const Rest& rest, int lanes);

  Eigen::VectorXi vertices, slots, neighbours;  ///< As the kernel says.
};

Items::Items(const Rest& rest, int lanes) {
  const Index count = rest.positions.rows(), items = (count + lanes - 1) / lanes;
  vertices.setZero(items * lanes);
  std::iota(vertices.begin(), vertices.begin() + count, 0);
  for (Index w = 0; w < count; w += kWindow) {
    std::stable_sort(vertices.begin() + w, vertices.begin() + std::min(w + kWindow, count),
                     [&](int a, int b) { return neighbours_of(rest, a) > neighbours_of(rest, b); });
  }
  slots.setZero(items + 1);
  for (Index i = 0; i < items; ++i) {
    int most = 0;
    for (const int v : vertices.segment(i * lanes, lanes)) most = std::max(most, neighbours_of(rest, v));
    slots[i + 1] = slots[i] + 1 + most;
  }
  neighbours.resize(Index{slots[items]} * lanes);
  for (Index i = 0; i < items * lanes; ++i) {
    const int v = vertices[i], *first = rest.neighbours.data() + rest.offsets[static_cast<size_t>(v)];
    const int known = i < count ? neighbours_of(rest, v) : 0;
    Index at = Index{slots[i / lanes]} * lanes + i % lanes;
    neighbours[at] = v;
    for (int k = 0; k + 1 < slots[i / lanes + 1] - slots[i / lanes]; ++k)
      neighbours[at += lanes] = k < known ? first[k] : v;
  }
}

class OpenClCurvature final : public CurvatureStep {
 public:
  OpenClCurvature(const Queue& queue, const Rest& rest)
      : OpenClCurvature(queue, rest, {rest, queue.context->lanes()}) {}

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) override {
    fit_.launch(stride_ / lanes_, stride_, slots_, neighbours_, places_, normals_, curvatures_);
    Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> of_lanes(stride_, 2);
    curvatures_.download(of_lanes);
    curvatures.resize(count_, 2);
    for (Index i = 0; i < count_; ++i) curvatures.row(vertices_[i]) = per_length_ * of_lanes.row(i);
  }

 private:
  OpenClCurvature(const Queue& queue, const Rest& rest, Items&& items)
      : count_(rest.positions.rows()),
        lanes_(queue.context->lanes()),
        stride_(static_cast<int>(items.vertices.size())),
        per_length_(inverse_extent(rest.positions)),
        vertices_(std::move(items.vertices)),
        slots_(queue, items.slots),
        neighbours_(queue, items.neighbours),
        places_(queue, places(rest.positions, per_length_, queue.context->precision()), Layout::rows),
        normals_(queue, rest.normals(vertices_, Eigen::all)),
        curvatures_(queue, Index{2} * stride_),
        fit_(queue, "curvature", "fit_curvatures") {}

  Index count_;
  int lanes_, stride_;
  double per_length_;
  Eigen::VectorXi vertices_;
  Ints slots_, neighbours_;
  Reals places_, normals_, curvatures_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<CurvatureStep> opencl_curvature(const SharedContext& context, const Rest& rest) {
  return std::make_unique<OpenClCurvature>(Queue(context), rest);
}

}  // namespace swage
