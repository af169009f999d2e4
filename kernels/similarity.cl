// The similarity step: gather_pairs, add_normals where there are any, turn_near, fit_similarities.
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/memory.h"
#include "shared/procrustes.h"
#include "shared/procrustes_pairs.h"

/// One item an element. `sums` have the normals in them, `edges` do not; without normals they are the same.
kernel void fit_similarities(const int count, global const real* sums, global const real* turns,
                             global const real* edges, global const real* inverse_spreads, global real* similarities) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Mat3 rotation = load_rotation(sums, turns, count, i);
  const real scale = closest_scale(rotation, column9(edges, count, i), inverse_spreads[i]);
  store_column9(scale_mat3(scale, rotation), similarities, count, i);
}
