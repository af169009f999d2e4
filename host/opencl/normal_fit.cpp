// The normal_fit step on a device.
#include "kernel.h"
#include "lane_items.h"
#include "opencl_steps.h"

namespace swage {
namespace {

constexpr const char* kStem = "normal_fit";

class OpenClNormalFit final : public NormalFitStep {
 public:
  OpenClNormalFit(const Queue& queue, const Rest& rest)
      : queue_(queue),
        triangle_count_(rest.triangle_count),
        vertices_{static_cast<int>(rest.offsets.size()) - 1, queue.context->lanes(kStem)},
        offsets_(queue, rest.offsets),
        triangles_(queue, rest.triangles),
        area_vectors_(queue, Eigen::Index{3} * triangle_count_),
        directions_(queue, Eigen::Index{9} * vertices_.count),
        spreads_(queue, Eigen::Index{3} * vertices_.count),
        fit_(queue, kStem, "fit_normals") {}

  void fit(const Positions& area_vectors, Transforms& directions, Positions& spreads) override {
    check_rows("NormalFitStep::fit", "area_vectors", area_vectors.rows(), triangle_count_);
    directions.resize(vertices_.count, 9);
    spreads.resize(vertices_.count, 3);
    const Visit visit(queue_, {&area_vectors_, &directions_, &spreads_});
    area_vectors_.show(area_vectors);
    directions_.lend(directions);
    spreads_.lend(spreads);
    fit_.launch(vertices_.items(), vertices_.count, offsets_, triangles_, area_vectors_, directions_, spreads_);
    directions_.take_back(directions);
    spreads_.take_back(spreads);
  }

 private:
  Queue queue_;
  int triangle_count_;
  LaneItems vertices_;
  Ints offsets_, triangles_;
  HostRows area_vectors_, directions_, spreads_;
  Kernel fit_;
};

}  // namespace

std::unique_ptr<NormalFitStep> opencl_normal_fit(const SharedContext& context, const NormalFitStep::Rest& rest) {
  return std::make_unique<OpenClNormalFit>(Queue(context), rest);
}

}  // namespace swage
