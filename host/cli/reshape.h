// `swage reshape` and the part of it that `swage demo` shares.
#pragma once

#include <optional>
#include <string>

#include "edit.h"
#include "gesture_options.h"
#include "options.h"
#include "straight.h"
#include "swage/reshape.h"

namespace swage::cli {

struct ReshapeJob : EditFiles {
  std::string method = "slippage";
  std::string solver = "steady";
  std::string linear_solver = "auto";
  std::string curvature;          ///< A .fk file; empty to compute.
  std::string straight = "none";  ///< Straight chains: auto finds them, none, or a file of them.
  StraightFinding finding;
  double feature_angle = 105;  ///< Interior dihedral angle, degrees.
  bool no_finalise = false;
  std::string remesh = "auto", scaffold = "auto";
  std::optional<double> handle_weight;  ///< Of the methods compared with; handles are met exactly where none is given.
  std::string scaffold_mesh;            ///< For the tetrahedra; empty for nowhere.
};

/// Reads, solves, then writes. Throws before anything is written.
ReshapeResult run(const ReshapeJob& job, const GestureRecipe& recipe, const CommonOptions& common);

}  // namespace swage::cli
