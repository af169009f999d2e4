#include "merge.h"

#include <algorithm>

namespace swage {
namespace {

using Eigen::Index;

/// Lines of a coarse array, and of each the lines of the fine one that are merged into it.
template <typename Work>
void each_line(const Extents& fine, const Merged& merged, const Work& work) {
  const Extents coarse = merge(fine, merged);
  const int y_step = merged[1] ? 2 : 1, z_step = merged[2] ? 2 : 1;
#pragma omp parallel for schedule(static) if (fine.count() > kManyEntries)
  for (int line = 0; line < coarse[1] * coarse[2]; ++line) {
    const int j = line % coarse[1] * y_step, k = line / coarse[1] * z_step;
    for (int z = k; z < std::min(k + z_step, fine[2]); ++z) {
      for (int y = j; y < std::min(j + y_step, fine[1]); ++y) {
        work(fine.at(0, y, z), Index{line} * coarse[0], y == j && z == k);
      }
    }
  }
}

}  // namespace

Extents merge(const Extents& fine, const Merged& merged) {
  Extents coarse = fine;
  for (int axis = 0; axis < 3; ++axis) {
    if (merged[static_cast<size_t>(axis)]) coarse[axis] = (coarse[axis] + 1) / 2;
  }
  return coarse;
}

template <typename Scalar>
void gather(const Extents& fine, const Merged& merged, const Scalar* from, Scalar* to) {
  each_line(fine, merged, [&](Index line, Index coarse, bool first) {
    const Scalar* source = from + line;
    Scalar* sums = to + coarse;
    const int count = fine[0];
    if (!merged[0]) {
      for (int i = 0; i < count; ++i) sums[i] = first ? source[i] : sums[i] + source[i];
      return;
    }
    for (int i = 0; i < count / 2; ++i) {
      const Scalar sum = source[2 * i] + source[2 * i + 1];
      sums[i] = first ? sum : sums[i] + sum;
    }
    if (count % 2 == 1) sums[count / 2] = first ? source[count - 1] : sums[count / 2] + source[count - 1];
  });
}

template <typename Scalar>
void scatter_add(const Extents& fine, const Merged& merged, const Scalar* from, Scalar* to) {
  each_line(fine, merged, [&](Index line, Index coarse, bool) {
    const Scalar* source = from + coarse;
    Scalar* target = to + line;
    const int count = fine[0];
    if (!merged[0]) {
      for (int i = 0; i < count; ++i) target[i] += source[i];
      return;
    }
    for (int i = 0; i < count / 2; ++i) {
      target[2 * i] += source[i];
      target[2 * i + 1] += source[i];
    }
    if (count % 2 == 1) target[count - 1] += source[count / 2];
  });
}

void gather_weights(const Extents& fine, const Merged& merged, int axis, const float* from, float* to) {
  const Index stride = fine.stride(axis);
  Values<float> between(fine.count());
  for (Index c = 0; c < between.size(); ++c) {
    between[c] = c / stride % fine[axis] % 2 == 0 ? 0.0F : kLongerWay * from[c];
  }
  gather(fine, merged, between.data(), to);
}

template void gather(const Extents&, const Merged&, const float*, float*);
template void scatter_add(const Extents&, const Merged&, const float*, float*);

}  // namespace swage
