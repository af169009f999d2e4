// The rotation step, after pairs.cl.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/procrustes.h"

/// One item LANES elements.
kernel void fit_rotations(const int count, const int stride, global const scalar* sums, global scalar* rotations) {
  const int i = get_global_id(0);
  if (i >= count) return;
  store_lanes9(closest_rotation(load_lanes9(sums, stride, i)), rotations, stride, i);
}
