#include "reference_models.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "refined.h"
#include "shapes.h"
#include "swage/mesh_io.h"

namespace swage::bench {

const std::vector<std::string>& reference_names() {
  static const std::vector<std::string> kNames = {"cylinder_1kF", "phone",       "cutlery_s26-1", "e_car_extruded",
                                                  "espresso",     "screwdriver", "m0839_sofa",    "f5-1_antique_chair"};
  return kNames;
}

std::vector<Model> reference_model(const std::string& name) {
  const std::filesystem::path stem = std::filesystem::path(SWAGE_SHARED) / "oracle/reshape" / name / name;
  auto with = [&](const char* extension) { return stem.string() + extension; };
  if (!std::filesystem::exists(with(".obj"))) return {};
  Model model{name, read_mesh(with(".obj")).mesh, {}, {}};
  model.options.unit_box_curvatures =
      read_unit_box_curvatures(with(".fk"), static_cast<int>(model.mesh.triangles.rows()));
  if (std::filesystem::exists(with(".straight"))) {
    model.options.straight_chains =
        read_straight_chains(with(".straight"), static_cast<int>(model.mesh.positions.rows()));
  }
  model.gestures = read_gestures(with(".deform"), model.mesh.positions);
  return {std::move(model)};
}

std::vector<Model> reference_models() {
  std::vector<Model> models;
  for (const std::string& name : reference_names()) {
    for (Model& model : reference_model(name)) models.push_back(std::move(model));
  }
  return models;
}

Model lifted_cylinder(int segments, int rings) {
  Model model{"generated_cylinder", test::cylinder(0.5, 1, segments, rings), {}, {{"lifted", {}}}};
  Gesture& gesture = model.gestures.front();
  gesture.add(0, model.mesh.positions.row(0));
  gesture.add(1, model.mesh.positions.row(1) + Eigen::RowVector3d(0, 0.5, 0));
  return model;
}

Model subdivided(const Model& model) {
  Mesh fine = test::subdivided(model.mesh);
  ReshapeOptions options = test::refined(model.options, model.mesh.triangles, fine.triangles);
  return {model.name, std::move(fine), std::move(options), model.gestures};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
}

}  // namespace swage::bench
