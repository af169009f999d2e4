// What whole reshapings are measured on: the authors' models and gestures, where the folder with them is, and a
// generated one.
#pragma once

#include <string>
#include <vector>

#include "swage/reshape.h"

namespace swage::bench {

struct Model {
  std::string name;
  Mesh mesh;
  ReshapeOptions options;         ///< Its curvatures and straight chains.
  std::vector<Gesture> gestures;  ///< Each with a label.
};

/// The names of the authors' models, by size.
const std::vector<std::string>& reference_names();
/// No model where there is no such folder.
std::vector<Model> reference_model(const std::string& name);
/// All there are.
std::vector<Model> reference_models();

/// A cylinder one of whose vertices is lifted. Its curvatures are left to the solve.
Model lifted_cylinder(int segments, int rings);

/// The same shape with each triangle in four, at the middles of its sides, which inherit its curvatures. Vertices keep
/// their numbers, so gestures stay; chains run over the middles too.
Model subdivided(const Model& model);

/// Of an even number the mean of the two in the middle. Not of none.
double median(std::vector<double> values);

}  // namespace swage::bench
