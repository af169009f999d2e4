// The local_map step. One item LANES elements.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/lane_memory.h"
#include "shared/lane_rows.h"
#include "shared/pair_sums.h"
#include "shared/principal.h"
#include "shared/nearest_unit.h"

/// v turned by the shortest rotation from a to b, unit vectors; where they are opposite, by any.
INLINE scalar4 turned_from(scalar4 v, scalar4 a, scalar4 b) {
  const scalar cosine = dot(a, b);
  if (cosine < (scalar)-0.999999) return -v;
  const scalar4 axis = cross(a, b);
  return cosine * v + cross(axis, v) + axis * (dot(axis, v) / (1 + cosine));
}

INLINE scalar4 row3(global const host_scalar* rows, int i) {
  return to_scalar4((host_scalar4)(vload3((size_t)i, rows), 0));
}
INLINE scalar4 own_row3(global const scalar* rows, int i) { return (scalar4)(vload3((size_t)i, rows), 0); }

/// Adds the neighbours' turned maps: what they make of each axis, a column. `sum`: entries LANES apart.
INLINE void sum_neighbours(int element, global const int* offsets, global const int* neighbours,
                           global const scalar* smoothing, global const scalar* rest_normals,
                           global const host_scalar* normals, global const host_scalar* last, scalar* sum) {
  const scalar4 rest = own_row3(rest_normals, element), now = row3(normals, element);
  for (int k = offsets[element]; k < offsets[element + 1]; ++k) {
    const int j = neighbours[k];
    const scalar4 other_rest = own_row3(rest_normals, j), other_now = row3(normals, j);
    const scalar4 x = row3(last, 3 * j), y = row3(last, 3 * j + 1), z = row3(last, 3 * j + 2);
    for (int axis = 0; axis < 3; ++axis) {
      const scalar4 unit = (scalar4)(axis == 0, axis == 1, axis == 2, 0);
      const scalar4 from = turned_from(unit, rest, other_rest);
      const scalar4 image = turned_from((scalar4)(dot(x, from), dot(y, from), dot(z, from), 0), other_now, now);
      sum[axis * LANES] += smoothing[k] * image.x;
      sum[(3 + axis) * LANES] += smoothing[k] * image.y;
      sum[(6 + axis) * LANES] += smoothing[k] * image.z;
    }
  }
}

INLINE Mat3 neighbour_sums(int i, int count, global const int* offsets, global const int* neighbours,
                           global const scalar* smoothing, global const scalar* rest_normals,
                           global const host_scalar* normals, global const host_scalar* last) {
  scalar s[9 * LANES];
  for (int k = 0; k < 9 * LANES; ++k) s[k] = 0;
  for (int k = 0; k < LANES; ++k) {
    const int e = min(LANES * i + k, count - 1);
    sum_neighbours(e, offsets, neighbours, smoothing, rest_normals, normals, last, s + k);
  }
  return mat3(vec3(VLOAD(0, s), VLOAD(1, s), VLOAD(2, s)), vec3(VLOAD(3, s), VLOAD(4, s), VLOAD(5, s)),
              vec3(VLOAD(6, s), VLOAD(7, s), VLOAD(8, s)));
}

INLINE Symmetric load_symmetric(global const scalar* tiles, int i) {
  return symmetric(load_tile(tiles, 6, 0, i), load_tile(tiles, 6, 1, i), load_tile(tiles, 6, 2, i),
                   load_tile(tiles, 6, 3, i), load_tile(tiles, 6, 4, i), load_tile(tiles, 6, 5, i));
}

/// Normals in rows: those that fit best, near the given ones. `inverses`: (P sum_p w_p a_p a_pᵀ P)⁺ in tiles. `guides`:
/// what holds normals to those given, in tiles.
kernel void turn_normals(const int items, const int count, const host_scalar per_length, const int with_normals,
                         global const int* offsets, global const int* pairs, global const scalar* edges,
                         global const scalar* weighted_normals, global const scalar* inverses,
                         global const scalar* rest_normals, global const scalar* guides,
                         global const host_scalar* positions, global const host_scalar* normals,
                         global host_scalar* turned) {
  (void)with_normals, (void)weighted_normals;  // As all fits of pairs have them.
  const int i = get_global_id(0);
  if (i >= items) return;
  const Mat3 image = pair_sums(i, count, offsets, pairs, edges, positions, per_length);
  const lane_index own = own_elements(i, count);
  const Mat3 fitted = times_symmetric(image, load_symmetric(inverses, i));
  // Of image inverse imageᵀ.
  const Symmetric h = symmetric(dot3(fitted.x, image.x), dot3(fitted.x, image.y), dot3(fitted.x, image.z),
                                dot3(fitted.y, image.y), dot3(fitted.y, image.z), dot3(fitted.z, image.z));
  const Vec3 b =
      add3(apply3(image, gather3(rest_normals, own)), scale3(load_tile(guides, 1, 0, i), gather_host3(normals, own)));
  const real size = h.xx + h.yy + h.zz + sqrt(dot3(b, b)) + (real)1e-30;
  const Vec3 n = nearest_unit(scale_symmetric((real)1 / size, h), scale3((real)1 / size, b));
  global host_scalar* to = turned + 3 * LANES * (long)i;
  const int elements = elements_of(i, count);
  store_host_entries(n.x, to, 3, elements);
  store_host_entries(n.y, to + 1, 3, elements);
  store_host_entries(n.z, to + 2, 3, elements);
}

/// Maps in rows. `inverses`: (P (sum_p w_p a_p a_pᵀ + sum_j w_j I) P)⁺ in tiles.
kernel void fit_maps(const int items, const int count, const host_scalar per_length, const int with_normals,
                     global const int* offsets, global const int* pairs, global const scalar* edges,
                     global const scalar* weighted_normals, global const scalar* inverses,
                     global const scalar* rest_normals, const int smooths, global const int* neighbour_offsets,
                     global const int* neighbours, global const scalar* smoothing, global const host_scalar* last,
                     global const host_scalar* positions, global const host_scalar* normals, global host_scalar* maps) {
  (void)with_normals, (void)weighted_normals;  // As all fits of pairs have them.
  const int i = get_global_id(0);
  if (i >= items) return;
  Mat3 image = pair_sums(i, count, offsets, pairs, edges, positions, per_length);
  if (smooths) {
    image = add_mat3(image,
                     neighbour_sums(i, count, neighbour_offsets, neighbours, smoothing, rest_normals, normals, last));
  }
  const lane_index own = own_elements(i, count);
  const Vec3 rest = gather3(rest_normals, own), now = gather_host3(normals, own);
  const Mat3 fitted = times_symmetric(image, load_symmetric(inverses, i));
  // P' fitted = fitted - n' (n'ᵀ fitted)
  const Vec3 along = apply3(transpose3(fitted), now);
  store_host_rows9(add_mat3(fitted, outer3(now, sub3(rest, along))), maps, i, count);
}
