// What is kept of a model between resizings, and the verbs that solve() is told in.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "assemble.h"
#include "grid.h"
#include "preparation.h"
#include "scales.h"
#include "stopwatch.h"
#include "swage/resize.h"

namespace swage {

/// Vulnerability from which a cell counts as protected where the user is told.
constexpr double kProtected = 0.5;

/// What depends on the map.
struct GridSolves {
  ScaleSolve scales;
  Assembly assembly;
};

struct ResizePlan {
  ResizeOptions options;
  std::shared_ptr<const Mesh> mesh;
  GridShape shape;

  // Filled by prepare().
  Vulnerability vulnerability = {};
  CellMap found = {}, map = {};                ///< As faces have it, and as it counts.
  AxisValues said = {};                        ///< #C × 3: the user's say, -1 where there is none.
  std::map<std::string, double> seconds = {};  ///< Of the preparation, by stage.
  bool prepared = false;

  std::unique_ptr<GridSolves> solves = {};  ///< None where the map is new.
  std::mutex preparing = {};
};

// check.cpp
void check_options(const PositionsRef& positions, const ResizeOptions& options);
void check_target(const GridShape& shape, const ResizeTarget& target);

// prepare.cpp
/// The grid of a box.
GridShape shape_of(const PositionsRef& positions, const ResizeOptions& options);
/// Once. False where `progress` cancelled: another call begins anew.
bool prepare(ResizePlan& plan, const ProgressFn& progress);
/// As found.
void reset_map(ResizePlan& plan);
/// Makes the map that counts: as faces have it, what is enclosed, and the user's say over all.
void count_map(ResizePlan& plan);
/// Those of the map as it counts.
const GridSolves& solves_of(ResizePlan& plan);

// protect.cpp
void protect(ResizePlan& plan, const Protection& protection);

// tell.cpp
/// Says in the report what the target could not be given.
void tell(const ResizePlan& plan, const ResizeTarget& target, ResizeResult& result);

}  // namespace swage
