// The models and gestures of the authors' program, where the folder with them is.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "swage/reshape.h"

namespace swage::test {

struct AuthorsName {
  const char* model;
  const char* gesture;
};
void PrintTo(const AuthorsName& name, std::ostream* out);
/// As tests may be called.
std::string test_name(const std::string& model, const std::string& gesture);

/// Those that come with results.
std::vector<AuthorsName> authors_names();

struct AuthorsGesture {
  Mesh mesh;
  ReshapeOptions options;  ///< The model's curvatures and straight chains.
  Gesture gesture;
};

/// Of a model such as "phone" the gesture such as "def_v1". Throws InvalidInput where it is not there.
AuthorsGesture authors_gesture(const std::string& model, const std::string& label, ReshapeSolver solver);

/// The positions that their program found, `suffix` ".expected.obj" or ".unfinished.obj", in the unit box.
Positions authors_result(const std::string& model, const std::string& label,
                         const std::string& suffix = ".expected.obj");

}  // namespace swage::test
