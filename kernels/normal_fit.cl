// The normal_fit step. One item LANES vertices.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/lane_rows.h"
#include "shared/principal.h"

/// The entries of one vertex's moment, LANES apart: of area vectors v, sum v vᵀ / (2 |v|).
INLINE void sum_moment(int first, int last, global const int* triangles, global const host_scalar* area_vectors,
                       scalar* sum) {
  scalar xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (int i = first; i < last; ++i) {
    const scalar4 v = to_scalar4((host_scalar4)(vload3((size_t)triangles[i], area_vectors), 0));
    const scalar size = length(v);
    const scalar4 part = size > 0 ? v * ((scalar)0.5 / size) : v;
    xx += part.x * v.x, xy += part.x * v.y, xz += part.x * v.z;
    yy += part.y * v.y, yz += part.y * v.z, zz += part.z * v.z;
  }
  sum[0] = xx, sum[LANES] = xy, sum[2 * LANES] = xz;
  sum[3 * LANES] = yy, sum[4 * LANES] = yz, sum[5 * LANES] = zz;
}

/// Directions and spreads in rows.
kernel void fit_normals(const int items, const int count, global const int* offsets, global const int* triangles,
                        global const host_scalar* area_vectors, global host_scalar* directions,
                        global host_scalar* spreads) {
  const int i = get_global_id(0);
  if (i >= items) return;
  scalar s[6 * LANES];
  for (int k = 0; k < LANES; ++k) {
    const int v = min(LANES * i + k, count - 1);
    sum_moment(offsets[v], offsets[v + 1], triangles, area_vectors, s + k);
  }
  const real xx = VLOAD(0, s), yy = VLOAD(3, s), zz = VLOAD(5, s), size = xx + yy + zz + (real)1e-37;
  const Symmetric moment = symmetric(xx, VLOAD(1, s), VLOAD(2, s), yy, VLOAD(4, s), zz);
  const Principal p = principal(scale_symmetric((real)1 / size, moment));
  store_host_rows9(p.directions, directions, i, count);
  global host_scalar* own = spreads + 3 * LANES * (long)i;
  const int elements = elements_of(i, count);
  store_host_entries(size * p.rest.xx, own, 3, elements);
  store_host_entries(size * p.rest.yy, own + 1, 3, elements);
  store_host_entries(size * p.rest.zz, own + 2, 3, elements);
}
