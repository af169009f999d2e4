// The field step on a device.
#include <algorithm>
#include <optional>

#include "kernel.h"
#include "lane_items.h"
#include "opencl_steps.h"
#include "tape_setup.h"

namespace swage {
namespace {

using Eigen::Index;

constexpr const char* kStem = "field";
constexpr int kBlock = 4;                                 // As the kernel's BLOCK, where there are lanes.
constexpr int kManyGroups = 1024;                         // So many have places to work in, at most; of processors so
constexpr int kGroupsOfUnit = 4;                          // many for each unit, that the places stay in the cache;
constexpr std::size_t kScratch = std::size_t{256} << 20;  // of so many bytes in all.

std::vector<int> code_of(const Tape& tape) {
  std::vector<int> code;
  for (const auto& [op, a, b] : tape.body) code.insert(code.end(), {static_cast<int>(op), a, b});
  return code;
}

Index units_of(const cl::Device& device) { return static_cast<Index>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()); }

class OpenClField final : public FieldStep {
 public:
  OpenClField(const Queue& queue, const Tape& tape)
      : queue_(queue),
        tape_(tape),
        lanes_(queue.context->lanes(kStem)),
        most_groups_(lanes_ == 1 ? kManyGroups : kGroupsOfUnit * units_of(queue.context->device())),
        code_(queue, code_of(tape)),
        fixed_(queue, tape.uniform_count()),
        run_(queue, kStem, "run_tape") {}

  void evaluate(const Positions& points, const Eigen::VectorXd& parameters, FieldDerivatives derivatives,
                FieldValues& field) override {
    check_rows("FieldStep::evaluate", "parameters", parameters.size(), tape_.parameter_count);
    const Index count = points.rows();
    field.values.resize(count);
    if (derivatives != FieldDerivatives::none) field.gradients.resize(count, 3);
    if (derivatives == FieldDerivatives::all) field.by_parameters.resize(count, tape_.parameter_count);
    if (count == 0) return;
    const int groups = groups_for(count);
    if (!asked_ || asked_->count != count || asked_->derivatives < derivatives) {
      asked_.emplace(queue_, tape_, count, derivatives, slots_of(groups));
    }
    const TapeSetup setup(tape_, parameters, derivatives == FieldDerivatives::all);
    fixed_.upload(setup.values);
    const Ints offsets(queue_, setup.offsets), uses(queue_, setup.slots);
    const Reals weights(queue_, setup.weights);
    const Visit visit(queue_, {&asked_->points, &asked_->values, &asked_->gradients, &asked_->by_parameters});
    asked_->points.show(points);
    asked_->values.lend(field.values);
    if (derivatives != FieldDerivatives::none) asked_->gradients.lend(field.gradients);
    if (derivatives == FieldDerivatives::all) asked_->by_parameters.lend(field.by_parameters);
    run_.launch(Index{groups} * kGroup, static_cast<int>(count), tape_.uniform_count(),
                static_cast<int>(tape_.body.size()), tape_.root, static_cast<int>(derivatives), tape_.parameter_count,
                code_, fixed_, offsets, uses, weights, asked_->points, asked_->slots, asked_->slopes, asked_->values,
                asked_->gradients, asked_->by_parameters);
    asked_->values.take_back(field.values);
    if (derivatives != FieldDerivatives::none) asked_->gradients.take_back(field.gradients);
    if (derivatives == FieldDerivatives::all) asked_->by_parameters.take_back(field.by_parameters);
  }

 private:
  /// For the last number of points.
  struct Asked {
    Asked(const Queue& queue, const Tape& tape, Index of, FieldDerivatives with, Index slot_count)
        : count(of),
          derivatives(with),
          points(queue, 3 * of),
          values(queue, of),
          gradients(queue, with == FieldDerivatives::none ? 1 : 3 * of),
          by_parameters(queue, with == FieldDerivatives::all ? of * tape.parameter_count : 1),
          slots(queue, slot_count),
          slopes(queue, with == FieldDerivatives::none ? 1 : slot_count) {}
    Index count;
    FieldDerivatives derivatives;
    HostRows points, values, gradients, by_parameters;
    Reals slots, slopes;
  };

  /// Points that a group works on at a time.
  Index group_width() const { return lanes_ == 1 ? kGroup : kBlock * lanes_; }
  Index slots_of(int groups) const { return groups * group_width() * tape_.slot_count(); }
  int groups_for(Index count) const {
    const Index wanted = (count + group_width() - 1) / group_width();
    const auto each = static_cast<std::size_t>(group_width() * tape_.slot_count()) * sizeof(double);
    const auto room = static_cast<Index>(std::max<std::size_t>(1, kScratch / each));
    return static_cast<int>(std::min({wanted, room, most_groups_}));
  }

  Queue queue_;
  Tape tape_;
  int lanes_;
  Index most_groups_;
  Ints code_;
  Reals fixed_;
  std::optional<Asked> asked_;
  Kernel run_;
};

}  // namespace

std::unique_ptr<FieldStep> opencl_field(const SharedContext& context, const Tape& tape) {
  return std::make_unique<OpenClField>(Queue(context), tape);
}

}  // namespace swage
