// The rotation step: gather_pairs, add_normals where there are any, turn_near, fit_rotations.
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/memory.h"
#include "shared/procrustes.h"
#include "shared/procrustes_pairs.h"

/// One item an element.
kernel void fit_rotations(const int count, global const real* sums, global const real* turns,
                          global real* rotations) {
  const int i = get_global_id(0);
  if (i >= count) return;
  store_column9(load_rotation(sums, turns, count, i), rotations, count, i);
}
