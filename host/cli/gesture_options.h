// Handles from the command line: --gesture, --pin and --move.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "swage/handles.h"

namespace swage::cli {

struct GestureOptions {
  std::string gesture;             ///< FILE or FILE:LABEL
  std::vector<std::string> pins;   ///< SELECT
  std::vector<std::string> moves;  ///< SELECT=dx,dy,dz
};

bool asks_for_handles(const GestureOptions& options);

void add_gesture_options(CLI::App& app, GestureOptions& options);

/// The options understood as far as that goes without the mesh.
class GestureRecipe {
 public:
  /// Throws WrongUsage where there is no handle, or a selection or displacement is not understood.
  explicit GestureRecipe(const GestureOptions& options);

  /// Throws InvalidInput and UnreadableFile, as reading gestures and selecting vertices do, and where two handles
  /// hold one vertex.
  Gesture on(const MeshFile& file) const;

 private:
  struct Move {
    std::string words;  ///< The option, as given.
    Selection selection;
    Eigen::RowVector3d displacement;
  };
  std::string file_;
  std::vector<Move> moves_;  ///< Pins are moves by nothing.
};

}  // namespace swage::cli
