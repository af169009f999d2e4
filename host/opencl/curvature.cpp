// The curvature step on a device.
#include "kernel.h"
#include "opencl_steps.h"

namespace swage {
namespace {

using Eigen::Index;
using Rest = CurvatureStep::Rest;

// Until the rows are orthogonal but for rounding.
constexpr int kSweeps = 6;

/// 1 / the shape's size, which the device has as unit. So single precision bears any size and any place.
double inverse_extent(const Positions& positions) {
  if (positions.rows() == 0) return 1;
  const double extent = (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).maxCoeff();
  return extent > 0 ? 1 / extent : 1;
}

/// #V × 6: positions about the first vertex, and what rounding to single precision takes from them.
Eigen::Matrix<double, Eigen::Dynamic, 6> places(const Positions& positions, double per_length, Precision precision) {
  Eigen::Matrix<double, Eigen::Dynamic, 6> table(positions.rows(), 6);
  if (positions.rows() == 0) return table;
  const Positions scaled = (positions.rowwise() - positions.row(0).eval()) * per_length;
  table.leftCols<3>() = scaled;
  table.rightCols<3>().setZero();
  if (precision == Precision::single) table.rightCols<3>() = scaled - scaled.cast<float>().cast<double>();
  return table;
}

Eigen::Map<const Eigen::VectorXi> vector(const std::vector<int>& list) {
  return {list.data(), static_cast<Index>(list.size())};
}

class OpenClCurvature final : public CurvatureStep {
 public:
  OpenClCurvature(const Queue& queue, const Rest& rest)
      : count_(rest.positions.rows()),
        per_length_(inverse_extent(rest.positions)),
        offsets_(queue, vector(rest.offsets)),
        neighbours_(queue, vector(rest.neighbours)),
        places_(queue, places(rest.positions, per_length_, queue.context->precision()), Layout::rows),
        normals_(queue, rest.normals, Layout::rows),
        units_(queue, count_ * 2),
        rows_(queue, count_ * 30),
        curvatures_(queue, count_ * 2),
        fold_neighbours_(queue, "curvature", "fold_neighbours"),
        sweep_rows_(queue, "curvature", "sweep_rows"),
        fit_curvatures_(queue, "curvature", "fit_curvatures") {}

  void fit(Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>& curvatures) override {
    fold_neighbours_.launch(count_, offsets_, neighbours_, places_, normals_, units_, rows_);
    for (int i = 0; i < kSweeps; ++i) sweep_rows_.launch(count_, rows_);
    fit_curvatures_.launch(count_, units_, rows_, curvatures_);
    curvatures.resize(count_, 2);
    curvatures_.download(curvatures);
    curvatures *= per_length_;
  }

 private:
  Index count_;
  double per_length_;
  Ints offsets_, neighbours_;
  Reals places_, normals_, units_, rows_, curvatures_;
  Kernel fold_neighbours_, sweep_rows_, fit_curvatures_;
};

}  // namespace

std::unique_ptr<CurvatureStep> opencl_curvature(const SharedContext& context, const Rest& rest) {
  return std::make_unique<OpenClCurvature>(Queue(context), rest);
}

}  // namespace swage
