#include "sampled.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "swage/error.h"

namespace swage {
namespace {

/// A pixel and the next one, and how near the second is.
struct Between {
  int low = 0, high = 0;
  double share = 0;
};

Between between(const Pixels& pixels, double at) {
  double low = std::floor(at - 0.5);
  const double share = at - 0.5 - low;
  const double count = pixels.count;
  const auto number = [&](double i) {
    i = pixels.repeats ? i - count * std::floor(i / count) : std::clamp(i, 0.0, count - 1);
    return pixels.first + std::min(static_cast<int>(i), pixels.count - 1);
  };
  return {number(low), number(low + 1), share};
}

}  // namespace

void check(const char* function, const NormalPicture& picture) {
  const size_t numbers =
      3 * static_cast<size_t>(std::max(0, picture.width)) * static_cast<size_t>(std::max(0, picture.height));
  if (numbers > 0 && picture.normals.size() == numbers) return;
  throw InvalidInput(std::string(function) + ": picture: " + std::to_string(picture.normals.size()) +
                     " numbers are no normals of " + std::to_string(picture.width) + " x " +
                     std::to_string(picture.height) + " pixels; give three a pixel");
}

Eigen::Vector3d sampled(const NormalPicture& picture, const Pixels& columns, const Pixels& rows, double x, double y) {
  const Between across = between(columns, x), down = between(rows, y);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double whole = 0;
  const auto add = [&](int column, int row, double weight) {
    const size_t at = static_cast<size_t>(row) * static_cast<size_t>(picture.width) + static_cast<size_t>(column);
    const Eigen::Vector3d normal = Eigen::Map<const Eigen::Vector3f>(&picture.normals[3 * at]).cast<double>();
    if (normal.isZero(0) || weight == 0) return;
    sum += weight * normal;
    whole += weight;
  };
  add(across.low, down.low, (1 - across.share) * (1 - down.share));
  add(across.high, down.low, across.share * (1 - down.share));
  add(across.low, down.high, (1 - across.share) * down.share);
  add(across.high, down.high, across.share * down.share);
  if (!(whole > 0)) return Eigen::Vector3d::Zero();
  return sum / whole;
}

}  // namespace swage
