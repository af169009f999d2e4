// What the transform step does where more than two triangles meet, after transform.cl. One item an element; edges' and
// triangles' arrays as there.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/transform.h"
#include "shared/memory.h"

/// The few edges with more triangles than transform.cl takes: the item's at offsets[i] .. offsets[i + 1] of `beside`,
/// the first of them summed there. Terms: transform_normal.
kernel void fit_crowded_edges(const int count, const real normal_weight, const real scale, global const int* edges,
                              global const int* offsets, global const int* beside, global const real* rest,
                              global const int* weight_places, global const real* weights, global const real* normals,
                              global const host_scalar* transforms, global const real* inverses,
                              global host_scalar* blocks, global host_scalar* sides, global host_scalar* targets,
                              global real* terms) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int e = edges[i], first = offsets[i], last = offsets[i + 1];
  const Vec3 edge = tile3(rest, 8, 0, e);
  EdgeSum sum = edge_side(apply3(host_row9(transforms, beside[first]), edge), row9(inverses, beside[first]),
                          row3(normals, beside[first]), edge);
  const real turned = sum.turned;
  for (int k = first + 1; k < last; ++k) {
    const int t = beside[k];
    sum = add_sides(sum, edge_side(apply3(host_row9(transforms, t), edge), row9(inverses, t), row3(normals, t), edge));
  }
  terms[i] = (sum.turned - turned) / dot3(edge, edge);
  const EdgeQuadratic q = edge_quadratic(sum, sum.length / (real)(last - first), 1, edge, weights[weight_places[e]],
                                         tile(rest, 8, 7, e), normal_weight, scale);
  store_host_row3(vec3(q.block.xx, q.block.xy, q.block.xz), blocks, 2 * e);
  store_host_row3(vec3(q.block.yy, q.block.yz, q.block.zz), blocks, 2 * e + 1);
  store_host_row3(q.side, sides, e);
  targets[e] = (host_scalar)q.target;
}

/// Pairs of triangles that transform.cl does not see. `rest` as of its edges, in rows. Terms: connect, similarity, a
/// row a pair.
kernel void compare_pairs(const int count, global const int* pairs, global const real* rest,
                          global const host_scalar* transforms, global real* terms) {
  const int p = get_global_id(0);
  if (p >= count) return;
  global const real* own = rest + 8 * p;
  const Mat3 difference = sub_mat3(host_row9(transforms, pairs[2 * p]), host_row9(transforms, pairs[2 * p + 1]));
  const Vec3 edge = row3(own, 0);
  terms[2 * p] = disagreement(difference, edge) / dot3(edge, edge);
  terms[2 * p + 1] = own[6] * disagreement(difference, row3(own, 1));
}
