// What size is asked for: --scale or --size, --anchor and --keep.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "axis_list.h"
#include "swage/resize.h"

namespace swage::cli {

struct TargetOptions {
  std::vector<std::string> scales;  ///< SX,SY,SZ
  std::vector<std::string> sizes;   ///< X,Y,Z; none where there are scales.
  std::string anchor = "low";       ///< One of low, center and high, or three.
  std::string keep = "shape";
  std::optional<double> keep_weight;

  bool any() const { return !scales.empty() || !sizes.empty(); }
  size_t count() const { return scales.size() + sizes.size(); }
};

void add_target_options(CLI::App& app, TargetOptions& options);

/// The options understood as far as that goes without the mesh.
class TargetRecipe {
 public:
  /// Throws WrongUsage where one is not understood or out of its range.
  explicit TargetRecipe(const TargetOptions& options);

  /// In the order given. Throws InvalidInput, naming the mesh and the axis, where a size is asked for that the model
  /// cannot have.
  std::vector<ResizeTarget> on(const GridShape& shape, const std::string& mesh) const;

 private:
  Eigen::RowVector3d factors_of(size_t target, const GridShape& shape, const std::string& mesh) const;

  std::vector<std::string> texts_;
  std::vector<AxisList> lists_;
  bool are_sizes_;
  ResizeTarget usual_;  ///< But for its factors.
};

/// "2 × 1 × 1"
std::string words(const Eigen::RowVector3d& factors);

}  // namespace swage::cli
