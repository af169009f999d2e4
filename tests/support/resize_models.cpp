#include "resize_models.h"

#include "shapes.h"

namespace swage::test {

const std::vector<TableLine>& table_1() {
  // Its grids, with y upwards as our models have it.
  static const std::vector<TableLine> kLines = {
      {"car", car, 1.12, 29636, 40, {73, 35, 30}, {1.8, 1, 1}, 7.3, 4.2},
      {"candelabrum", candelabrum, 0.98, 11284, 87, {80, 64, 25}, {1.65, 1, 1}, 8.8, 6.5},
      {"clock", clock_of_parts, 1.68, 55725, 267, {50, 115, 22}, {1.4, 1, 1}, 8.7, 5.8},
      {"fan", fan, 2.3, 501956, 309, {20, 57, 20}, {1, 0.65, 1}, 1.5, 0.7},
      {"phone", phone, 1.38, 29416, 22, {50, 29, 42}, {1.5, 1, 1}, 4.5, 2.6},
      {"fuel tank", tank, 1.18, 9236, 61, {40, 17, 14}, {2, 1, 1}, 0.8, 0.4},
      {"church", church, 1.46, 39306, 129, {80, 52, 50}, {1.4, 1, 1}, 15.2, 11.8},
      {"camera", camera, 1.54, 6868, 29, {60, 38, 56}, {1.8, 1, 1}, 9.6, 4.8},
      {"wrench", wrench, 1.18, 3092, 4, {60, 5, 17}, {1.7, 1, 1}, 2.5, 1.6},
      {"lantern", lantern, 1.02, 2125, 7, {61, 60, 61}, {1, 1.5, 1}, 15.5, 10.9},
      {"fountain", fountain, 1.08, 42988, 766, {50, 23, 38}, {1.5, 1, 1}, 2.4, 1.5},
  };
  return kLines;
}

Assembled bolted_plate(bool ribs, double detail) {
  Assembler made(detail);
  made.add("plate", plate(3, 2, 20, 3, {{0, 0}, {2, 0}, {0, 1}, {2, 1}}, 3, 4 * made.steps(8)));
  if (ribs) {
    for (const double z : {-19.0, 19.0}) made.add("rib", moved(box({60, 4, 2}, made.steps(4)), {-30, 1.5, z - 1}));
    for (const double x : {-3.0, 3.0}) made.add("rib", moved(box({2, 4, 36}, made.steps(4)), {x - 1, 1.5, -18}));
  }
  return made.assembled();
}

Assembled boxes() {
  Assembler made(1);
  const auto add = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& size) {
    made.add("box", moved(box(size, 4), low));
  };
  add({0, 0, 0}, {40, 6, 24});
  add({4, 6, 4}, {12, 14, 16});
  add({16, 6, 4}, {12, 8, 16});
  add({30, 6, 2}, {6, 20, 6});
  return made.assembled();
}

}  // namespace swage::test
