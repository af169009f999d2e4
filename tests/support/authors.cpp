#include "authors.h"

#include <algorithm>

#include "places.h"
#include "swage/error.h"
#include "swage/mesh_io.h"

namespace swage::test {
namespace {

std::filesystem::path folder(const std::string& model) { return shared("oracle/reshape/") / model; }

}  // namespace

void PrintTo(const AuthorsName& name, std::ostream* out) { *out << name.model << " " << name.gesture; }

std::string test_name(const std::string& model, const std::string& gesture) {
  std::string name = model + "_" + gesture;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<AuthorsName> authors_names() {
  return {{"cylinder_1kF", "def_v0"},   {"cylinder_1kF", "def_v1"}, {"cylinder_1kF", "def_v2"},
          {"cylinder_1kF", "def_v3"},   {"phone", "def_v1"},        {"cutlery_s26-1", "def_v1"},
          {"e_car_extruded", "def_v1"}, {"espresso", "def_v1"}};
}

AuthorsGesture authors_gesture(const std::string& model, const std::string& label, ReshapeSolver solver) {
  AuthorsGesture made{read_mesh(folder(model) / (model + ".obj")).mesh, {}, {}};
  made.options.solver = solver;
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
