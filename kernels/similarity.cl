// The similarity step, after pairs.cl.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/procrustes.h"

/// One item LANES elements. `sums` have the normals in them, `edges` do not; without normals they are the same.
kernel void fit_similarities(const int count, const int stride, global const scalar* sums, global const scalar* edges,
                             global const scalar* inverse_spreads, global scalar* similarities) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Mat3 rotation = closest_rotation(load_lanes9(sums, stride, i));
  const real scale = closest_scale(rotation, load_lanes9(edges, stride, i), load_lanes(inverse_spreads, i));
  store_lanes9(scale_mat3(scale, rotation), similarities, stride, i);
}
