// The rotation step. One item LANES elements.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/lane_rows.h"
#include "shared/procrustes.h"
#include "shared/pair_sums.h"

/// Rotations in rows.
kernel void fit_rotations(const int items, const int count, const host_scalar per_length, const int with_normals,
                          global const int* offsets, global const int* pairs, global const scalar* edges,
                          global const scalar* normals, global const host_scalar* positions,
                          global const host_scalar* targets, global host_scalar* rotations) {
  const int i = get_global_id(0);
  if (i >= items) return;
  Mat3 sum = pair_sums(i, count, offsets, pairs, edges, positions, per_length);
  if (with_normals) sum = add_mat3(sum, normal_terms(i, count, normals, targets));
  store_host_rows9(closest_rotation(sum), rotations, i, count);
}

/// Of matrices that are there already, in columns.
kernel void closest_rotations(const int items, const int stride, global const scalar* matrices,
                              global scalar* rotations) {
  const int i = get_global_id(0);
  if (i >= items) return;
  store_lanes9(closest_rotation(load_lanes9(matrices, stride, i)), rotations, stride, i);
}
