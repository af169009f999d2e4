// The sums that rotation and similarity fit: gather_pairs, and add_normals where there are any. Sums lie in columns, an
// element's entries `stride` apart, positions in rows.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/memory.h"

/// One item an element: sum_p b_p (w_p a_p)ᵀ. `edges`: w_p a_p.
kernel void gather_pairs(const int count, const int stride, global const int* offsets, global const int* pairs,
                         global const real* edges, global const real* positions, global real* sums) {
  const int i = get_global_id(0);
  if (i >= count) return;
  Mat3 sum = mat3(vec3(0, 0, 0), vec3(0, 0, 0), vec3(0, 0, 0));
  for (int p = offsets[i]; p < offsets[i + 1]; ++p) {
    const Vec3 b = sub3(row3(positions, pairs[2 * p + 1]), row3(positions, pairs[2 * p]));
    sum = add_mat3(sum, outer3(b, row3(edges, p)));
  }
  store_column9(sum, sums, stride, i);
}

/// One item an element: `sums` and t (w_n n)ᵀ. `normals`: w_n n.
kernel void add_normals(const int count, const int stride, global const real* sums, global const real* normals,
                        global const real* targets, global real* with_normals) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const Mat3 normal = outer3(column3(targets, count, 0, i), column3(normals, count, 0, i));
  store_column9(add_mat3(column9(sums, stride, i), normal), with_normals, stride, i);
}
