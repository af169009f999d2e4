// What a picture of normals shows between its pixels.
#pragma once

#include <Eigen/Core>

#include "swage/style_io.h"

namespace swage {

/// Throws InvalidInput, naming the `function`, where the picture has not the pixels it says, or none.
void check(const char* function, const NormalPicture& picture);

/// Rows or columns of a picture that are looked at. Beyond are its first and last, or all of them again.
struct Pixels {
  int first = 0, count = 0;
  bool repeats = false;
};

/// The mean of the four pixels around a place, by nearness, or of those of them that have a normal; zero where none
/// has. x is from the left and y from the top, in pixels, whose middles are at halves. Of any length.
Eigen::Vector3d sampled(const NormalPicture& picture, const Pixels& columns, const Pixels& rows, double x, double y);

}  // namespace swage
