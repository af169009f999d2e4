#include "resize_targets.h"

#include <spdlog/fmt/fmt.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <limits>

#include "failure.h"
#include "options.h"
#include "swage/error.h"

namespace swage::cli {
namespace {

constexpr AxisRange kFactors{1e-6, 1e6, "a factor from 1e-6 to 1e6"};
constexpr AxisRange kSizes{std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max(),
                           "a size above 0, in mesh units"};

ResizeAnchor anchor_named(const std::string& name, const std::string& text) {
  if (name == "low") return ResizeAnchor::low;
  if (name == "center") return ResizeAnchor::center;
  if (name == "high") return ResizeAnchor::high;
  throw WrongUsage(
      fmt::format("--anchor {}: '{}' is not low, center or high: give one, or three such as "
                  "low,center,high",
                  text, name));
}

std::array<ResizeAnchor, 3> anchors_of(const std::string& text) {
  std::vector<std::string> names = CLI::detail::split(text, ',');
  if (names.size() == 1) names.resize(3, names.front());
  if (names.size() != 3) {
    throw WrongUsage(fmt::format("--anchor {}: give one of low, center and high, or three, for x, y and z", text));
  }
  std::array<ResizeAnchor, 3> anchors = {};
  for (size_t u = 0; u < 3; ++u) anchors[u] = anchor_named(CLI::detail::trim_copy(names[u]), text);
  return anchors;
}

}  // namespace

void add_target_options(CLI::App& app, TargetOptions& options) {
  const std::string group = "Target";
  CLI::Option* const scale =
      app.add_option("--scale", options.scales,
                     "The new size over the old along each axis, 1e-6 to 1e6, such as 2,1,1; may be repeated, for "
                     "several results of one analysis")
          ->group(group)
          ->allow_extra_args(false)
          ->type_name("SX,SY,SZ");
  app.add_option("--size", options.sizes,
                 "Instead: the new size, mesh units, such as 300,-,120, where - leaves an axis as it is; may be "
                 "repeated")
      ->group(group)
      ->allow_extra_args(false)
      ->type_name("X,Y,Z")
      ->excludes(scale);
  app.add_option("--anchor", options.anchor,
                 "What side stays in its place: low, center or high, or three of them for x, y and z (low)")
      ->group(group)
      ->type_name("SIDE|X,Y,Z");
  app.add_option("--keep", options.keep,
                 "What vulnerable parts keep: shape: they may grow and shrink, as in the paper; size: they stay as "
                 "large as they are where there is room (shape)")
      ->group(group)
      ->check(CLI::IsMember({"shape", "size"}));
  app.add_option("--keep-weight", options.keep_weight, "How much --keep size counts (10)")
      ->group(group)
      ->check(between(1e-9, 1e9));
}

TargetRecipe::TargetRecipe(const TargetOptions& options)
    : texts_(options.sizes.empty() ? options.scales : options.sizes), are_sizes_(!options.sizes.empty()) {
  for (const std::string& text : texts_) {
    lists_.push_back(are_sizes_ ? axis_list("--size", text, kSizes) : axis_list("--scale", text, kFactors));
  }
  usual_.anchors = anchors_of(options.anchor);
  if (options.keep == "size") usual_.keep = ResizeKeep::size;
  if (options.keep_weight && usual_.keep != ResizeKeep::size) {
    throw WrongUsage("--keep-weight is for --keep size: add that, or leave it out");
  }
  usual_.size_weight = options.keep_weight.value_or(usual_.size_weight);
}

std::vector<ResizeTarget> TargetRecipe::on(const GridShape& shape, const std::string& mesh) const {
  std::vector<ResizeTarget> targets(lists_.size(), usual_);
  for (size_t t = 0; t < targets.size(); ++t) targets[t].factors = factors_of(t, shape, mesh);
  return targets;
}

Eigen::RowVector3d TargetRecipe::factors_of(size_t target, const GridShape& shape, const std::string& mesh) const {
  Eigen::RowVector3d factors(1, 1, 1);
  for (int u = 0; u < 3; ++u) {
    const std::optional<double> asked = lists_[target][static_cast<size_t>(u)];
    if (!asked) continue;
    factors[u] = *asked;
    if (!are_sizes_) continue;
    const auto refuse = [&](const std::string& why) {
      throw InvalidInput(fmt::format("{}: --size {}: along {} {}", mesh, texts_[target], "xyz"[u], why));
    };
    if (!shape.extends(u)) refuse("the model has no extent that could be resized: give - there");
    factors[u] = *asked / shape.size[u];
    if (!(factors[u] >= kFactors.low && factors[u] <= kFactors.high)) {
      refuse(fmt::format("the model is {:.6g} long, and that is {:.3g} times as much: ask for {:.3g} to {:.3g}",
                         shape.size[u], factors[u], kFactors.low * shape.size[u], kFactors.high * shape.size[u]));
    }
  }
  return factors;
}

std::string words(const Eigen::RowVector3d& factors) {
  return fmt::format("{:.4g} × {:.4g} × {:.4g}", factors[0], factors[1], factors[2]);
}

}  // namespace swage::cli
