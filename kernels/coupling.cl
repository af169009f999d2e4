// The transform step's matrix times transforms (reshape paper, eq. 35). All lies in columns but the few shares.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/triangle.h"
#include "shared/coupling.h"
#include "shared/memory.h"

/// One item a triangle. `rest`: what lies along the edges, their directions, normal, then what each of its first three
/// neighbours shares. An absent neighbour is the triangle itself.
kernel void couple(const int count, const real normal_weight, const real regularizer_weight,
                   global const int* neighbours, global const real* rest, global const real* transforms,
                   global real* products) {
  const int t = get_global_id(0);
  if (t >= count) return;
  const Mat3 transform = column9(transforms, count, t);
  const Mat3 first = column9(transforms, count, neighbours[t]),
             second = column9(transforms, count, neighbours[count + t]),
             third = column9(transforms, count, neighbours[2 * count + t]);
  Mat3 product = own_product(transform, column6(rest, count, 0, t), column6(rest, count, 6, t),
                             column3(rest, count, 12, t), normal_weight, regularizer_weight);
  product = add_mat3(product, shared_product(transform, first, column6(rest, count, 15, t)));
  product = add_mat3(product, shared_product(transform, second, column6(rest, count, 21, t)));
  product = add_mat3(product, shared_product(transform, third, column6(rest, count, 27, t)));
  store_column9(product, products, count, t);
}

/// The neighbours after the third of the few triangles that have more: at offsets[i] .. offsets[i + 1].
kernel void couple_crowded(const int count, const int all_triangles, global const int* triangles,
                           global const int* offsets, global const int* neighbours, global const real* shares,
                           global const real* transforms, global real* products) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int t = triangles[i];
  const Mat3 transform = column9(transforms, all_triangles, t);
  Mat3 product = column9(products, all_triangles, t);
  for (int k = offsets[i]; k < offsets[i + 1]; ++k) {
    product = add_mat3(product,
                       shared_product(transform, column9(transforms, all_triangles, neighbours[k]), row6(shares, k)));
  }
  store_column9(product, products, all_triangles, t);
}

/// One item a triangle with sphericity. `rest`: axis, cosines, sines, three unit sides, sphericity weight.
kernel void couple_corners(const int count, const int all_triangles, global const int* triangles,
                           global const real* rest, global const real* transforms, global real* products) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int t = triangles[i];
  Corners turns;
  turns.axis = column3(rest, count, 0, i);
  turns.cosines = column3(rest, count, 3, i);
  turns.sines = column3(rest, count, 6, i);
  const Sides directions = sides(column3(rest, count, 9, i), column3(rest, count, 12, i), column3(rest, count, 15, i));
  const Mat3 pull = corner_pull(turns, column9(transforms, all_triangles, t), directions);
  store_column9(add_mat3(column9(products, all_triangles, t), scale_mat3(rest[18 * count + i], pull)), products,
                all_triangles, t);
}
