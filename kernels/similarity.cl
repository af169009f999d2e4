// The similarity step. One item LANES elements.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/lane_rows.h"
#include "shared/procrustes.h"
#include "shared/pair_sums.h"

/// Similarities in rows.
kernel void fit_similarities(const int items, const int count, const host_scalar per_length, const int with_normals,
                             global const int* offsets, global const int* pairs, global const scalar* edges,
                             global const scalar* normals, global const scalar* inverse_spreads,
                             global const host_scalar* positions, global const host_scalar* targets,
                             global host_scalar* similarities) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const Mat3 sum = pair_sums(i, count, offsets, pairs, edges, positions, per_length);
  Mat3 all = sum;
  if (with_normals) all = add_mat3(all, normal_terms(i, count, normals, targets));
  const Mat3 rotation = closest_rotation(all);
  const real scale = closest_scale(rotation, sum, load_tile(inverse_spreads, 1, 0, i));
  store_host_rows9(scale_mat3(scale, rotation), similarities, i, count);
}
