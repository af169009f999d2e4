// The closest_normal step on a device.
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <optional>

#include "kernel.h"
#include "opencl_steps.h"

namespace swage {
namespace {

using Eigen::Index;

/// As kernels/closest_normal.cl searches it.
struct Tree {
  explicit Tree(const Positions& normals)
      : numbers(static_cast<size_t>(normals.rows())), axes(static_cast<size_t>(normals.rows()), 0) {
    std::iota(numbers.begin(), numbers.end(), 0);
    split(normals, 0, numbers.size());
  }

  /// By the axis along which they spread most.
  void split(const Positions& normals, size_t first, size_t end) {
    if (end - first < 2) return;
    Eigen::AlignedBox3d box;
    for (size_t i = first; i < end; ++i) box.extend(normals.row(numbers[i]).transpose());
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const size_t middle = (first + end) / 2;
    const auto at = [&](size_t i) { return numbers.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(end), [&](int a, int b) { return normals(a, axis) < normals(b, axis); });
    axes[middle] = axis;
    split(normals, first, middle);
    split(normals, middle + 1, end);
  }

  std::vector<int> numbers, axes;  ///< Of the normal in each place.
};

class OpenClClosestNormal final : public ClosestNormalStep {
 public:
  OpenClClosestNormal(const Queue& queue, const Positions& normals)
      : OpenClClosestNormal(queue, normals, Tree(normals)) {}

  void find(const Positions& units, Eigen::VectorXi& closest) override {
    closest.resize(units.rows());
    if (!asked_ || asked_->closest.size() != units.rows()) asked_.emplace(queue_, units.rows());
    const Visit visit(queue_, {&normals_, &asked_->units});
    normals_.show(in_places_);
    asked_->units.show(units);
    find_.launch(units.rows(), static_cast<int>(in_places_.rows()), axes_, numbers_, normals_, asked_->units,
                 asked_->closest);
    asked_->closest.download(closest);
  }

 private:
  struct Asked {
    Asked(const Queue& queue, Index count) : units(queue, 3 * count), closest(queue, count) {}
    HostRows units;
    Ints closest;
  };

  OpenClClosestNormal(const Queue& queue, const Positions& normals, const Tree& tree)
      : queue_(queue),
        in_places_(normals(tree.numbers, Eigen::all)),
        axes_(queue, tree.axes),
        numbers_(queue, tree.numbers),
        normals_(queue, in_places_.size()),
        find_(queue, "closest_normal", "find_closest") {}

  Queue queue_;
  Positions in_places_;
  Ints axes_, numbers_;
  HostRows normals_;
  std::optional<Asked> asked_;  // For the last number of them.
  Kernel find_;
};

}  // namespace

std::unique_ptr<ClosestNormalStep> opencl_closest_normal(const SharedContext& context, const Positions& normals) {
  return std::make_unique<OpenClClosestNormal>(Queue(context), normals);
}

}  // namespace swage
