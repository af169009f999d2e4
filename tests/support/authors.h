// The models and gestures of the authors' program, where the folder with them is.
#pragma once

#include <string>

#include "swage/reshape.h"

namespace swage::test {

struct AuthorsGesture {
  Mesh mesh;
  ReshapeOptions options;  ///< Those given, with the model's curvatures and straight chains.
  Gesture gesture;
};

/// Of a model such as "phone" the gesture such as "def_v1". Throws InvalidInput where it is not there.
AuthorsGesture authors_gesture(const std::string& model, const std::string& label, const ReshapeOptions& options);

/// The positions that their program found, `suffix` ".expected.obj" or ".unfinished.obj", in the unit box.
Positions authors_result(const std::string& model, const std::string& label,
                         const std::string& suffix = ".expected.obj");

}  // namespace swage::test
