// Calls of the library that are refused, as the table of refusals has them.
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "shapes.h"
#include "swage/handles.h"
#include "swage/mesh.h"

namespace swage::test {

struct Call {
  const char* text;
  std::function<void()> run;
};

// The text of the call is in the table.
#define CALL(...)                             \
  Call {                                      \
#__VA_ARGS__, [] { (void)(__VA_ARGS__); } \
  }

std::vector<Call> mesh_calls();
std::vector<Call> file_calls();
std::vector<Call> edit_calls();
std::vector<Call> style_calls();
std::vector<Call> resize_calls();
std::vector<Call> template_calls();
std::vector<Call> surface_calls();
std::vector<Call> picture_calls();

inline const double nan = std::numeric_limits<double>::quiet_NaN();
/// Eight vertices, twelve triangles.
inline const Mesh cube = box({1, 1, 1}, 1);
/// Three vertices, one triangle.
inline const Mesh triangle = {(Positions(3, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0).finished(),
                              (Triangles(1, 3) << 0, 1, 2).finished()};
/// Its vertices are on a line.
inline const Mesh line = {(Positions(3, 3) << 0, 0, 0, 1, 0, 0, 3, 0, 0).finished(), triangle.triangles};
/// Its vertices are one point.
inline const Mesh point = {Positions::Ones(3, 3), triangle.triangles};
inline const Gesture up{"up", {{0, {0, 0, 0}}, {7, {1, 1, 2}}}};

/// Options that are as usual but for one.
template <typename Options, typename Member, typename Value>
Options with(Member Options::*member, const Value& value) {
  Options options;
  options.*member = value;
  return options;
}

/// Rows of the value, but for the last row.
template <typename Rows = Positions>
Rows rows(Eigen::Index count, double value = 1, double last = 1) {
  Rows made = Rows::Constant(count, 3, static_cast<typename Rows::Scalar>(value));
  if (count > 0) made.row(count - 1).setConstant(static_cast<typename Rows::Scalar>(last));
  return made;
}

}  // namespace swage::test
