// The transform step's matrix times transforms (reshape paper, eq. 35). Matrices lie in rows, a triangle's nine numbers
// one after the other; what corners compare in columns.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/triangle.h"
#include "shared/row.h"
#include "shared/rows.h"
#include "shared/coupling.h"
#include "shared/memory.h"
#include "shared/row_memory.h"

/// One item a triangle. `rest`, 36 numbers each: what lies along the edges, their directions, normal, then what each of
/// its first three neighbours shares. An absent neighbour is the triangle itself.
kernel void couple(const int count, const real normal_weight, const real regularizer_weight,
                   global const int* neighbours, global const real* rest, global const host_scalar* transforms,
                   global host_scalar* products) {
  const int t = get_global_id(0);
  if (t >= count) return;
  global const real* own = rest + 36 * t;
  const Rows transform = load_host_rows(transforms + 9 * t);
  const Rows first = load_host_rows(transforms + 9 * neighbours[3 * t]),
             second = load_host_rows(transforms + 9 * neighbours[3 * t + 1]),
             third = load_host_rows(transforms + 9 * neighbours[3 * t + 2]);
  Rows product = own_product(transform, load_symmetric_rows(own), load_symmetric_rows(own + 6), vload4(0, own + 12),
                             normal_weight, regularizer_weight);
  product = add_rows(product, shared_product(transform, first, load_symmetric_rows(own + 15)));
  product = add_rows(product, shared_product(transform, second, load_symmetric_rows(own + 21)));
  product = add_rows(product, shared_product(transform, third, load_symmetric_rows(own + 27)));
  store_host_rows(product, products + 9 * t);
}

/// The neighbours after the third of the few triangles that have more: at offsets[i] .. offsets[i + 1]. `shares`: eight
/// numbers each.
kernel void couple_crowded(const int count, global const int* triangles, global const int* offsets,
                           global const int* neighbours, global const real* shares,
                           global const host_scalar* transforms, global host_scalar* products) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int t = triangles[i];
  const Rows transform = load_host_rows(transforms + 9 * t);
  Rows product = load_host_rows(products + 9 * t);
  for (int k = offsets[i]; k < offsets[i + 1]; ++k) {
    const Rows neighbour = load_host_rows(transforms + 9 * neighbours[k]);
    product = add_rows(product, shared_product(transform, neighbour, load_symmetric_rows(shares + 8 * k)));
  }
  store_host_rows(product, products + 9 * t);
}

/// One item a triangle with sphericity. `rest`: axis, cosines, sines, three unit sides, sphericity weight.
kernel void couple_corners(const int count, global const int* triangles, global const real* rest,
                           global const host_scalar* transforms, global host_scalar* products) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int t = triangles[i];
  Corners turns;
  turns.axis = column3(rest, count, 0, i);
  turns.cosines = column3(rest, count, 3, i);
  turns.sines = column3(rest, count, 6, i);
  const Sides unit = sides(column3(rest, count, 9, i), column3(rest, count, 12, i), column3(rest, count, 15, i));
  const Mat3 pull = corner_pull(turns, host_row9(transforms, t), unit);
  const Mat3 product = add_mat3(host_row9(products, t), scale_mat3(rest[18 * count + i], pull));
  store_host_row9(product, products, t);
}
