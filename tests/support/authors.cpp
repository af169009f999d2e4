#include "authors.h"

#include <algorithm>

#include "places.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

std::filesystem::path folder(const std::string& model) { return shared("oracle/reshape/") / model; }

}  // namespace

AuthorsGesture authors_gesture(const std::string& model, const std::string& label, const ReshapeOptions& options) {
  AuthorsGesture made{read_mesh(folder(model) / (model + ".obj")).mesh, options, {}};
  made.options.unit_box_curvatures =
      read_unit_box_curvatures(folder(model) / (model + ".fk"), static_cast<int>(made.mesh.triangles.rows()));
  const std::filesystem::path straight = folder(model) / (model + ".straight");
  if (std::filesystem::exists(straight)) {
    made.options.straight_chains = read_straight_chains(straight, static_cast<int>(made.mesh.positions.rows()));
  }
  const std::vector<Gesture> gestures = read_gestures(folder(model) / (model + ".deform"), made.mesh.positions);
  const auto found =
      std::find_if(gestures.begin(), gestures.end(), [&](const Gesture& gesture) { return gesture.label == label; });
  if (found == gestures.end()) throw InvalidInput("authors_gesture: " + model + " has no gesture " + label);
  made.gesture = *found;
  return made;
}

Positions authors_result(const std::string& model, const std::string& label, const std::string& suffix) {
  return read_mesh(folder(model) / (label + suffix)).mesh.positions;
}

}  // namespace swage::test
