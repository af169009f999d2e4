// The transform step: invert, fit_edges and map_corners of the transforms, fit_triangles and place_corners of the
// positions. One item LANES elements. What is gathered and what is the host's lies in rows, the rest in columns.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/transform.h"
#include "shared/triangle.h"
#include "shared/lane_memory.h"
#include "shared/lane_sums.h"

/// Triangles. Sums: damped, regularizer.
kernel void invert(const int items, const int count, global const host_scalar* transforms, global scalar* inverses,
                   global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const Mat3 transform = gather_host9(transforms, own_elements(i, count));
  const Inverse inverse = damped_inverse(transform);
  const real present = present_lanes(i, count);
  store_sums(i, sums, present * inverse.damped, present * distance_from_identity(transform), (real)0);
  store_rows9(inverse.matrix, inverses, i, count);
}

/// Edges. `beside`: their two triangles, or the one twice where there is one only or crowded.cl sees to the others, and
/// where one of them has the edge's length weight. `rest`: vector, unit vector between the opposite vertices,
/// similarity weight, kept target length or 0. Sums: transform_normal, connect, similarity.
kernel void fit_edges(const int items, const int count, const scalar normal_weight, const scalar scale,
                      global const int* beside, global const scalar* rest, global const scalar* weights,
                      global const scalar* normals, global const host_scalar* transforms, global const scalar* inverses,
                      global host_scalar* blocks, global host_scalar* sides, global host_scalar* targets,
                      global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const lane_index t = load_indices(beside, 3, 0, i), s = load_indices(beside, 3, 1, i);
  const Vec3 edge = load_tile3(rest, 8, 0, i), opposite = load_tile3(rest, 8, 3, i);
  // First what needs the transforms: there are no registers for all matrices at once.
  const Mat3 transform = gather_host9(transforms, t), other = gather_host9(transforms, s);
  const Mat3 difference = sub_mat3(transform, other);
  const real along = disagreement(difference, edge), across = disagreement(difference, opposite);
  const Vec3 mapped = apply3(transform, edge), mapped_by_other = apply3(other, edge);
  const EdgeSum sum = add_sides(edge_side(mapped, gather9(inverses, t), gather3(normals, t), edge),
                                edge_side(mapped_by_other, gather9(inverses, s), gather3(normals, s), edge));
  const real share = (real)0.5 + (real)0.5 * one_where(t != s);
  const EdgeQuadratic q =
      edge_quadratic(sum, (real)0.5 * sum.length, share, edge, gather(weights, load_indices(beside, 3, 2, i)),
                     load_tile(rest, 8, 7, i), (real)normal_weight, (real)scale);
  const real present = present_lanes(i, count), per_square = present / dot3(edge, edge);
  store_sums(i, sums, per_square * share * sum.turned, per_square * along, present * load_tile(rest, 8, 6, i) * across);
  const int elements = elements_of(i, count);
  store_host3(vec3(q.block.xx, q.block.xy, q.block.xz), blocks + 6 * LANES * i, 6, elements);
  store_host3(vec3(q.block.yy, q.block.yz, q.block.zz), blocks + 6 * LANES * i + 3, 6, elements);
  store_host3(q.side, sides + 3 * LANES * i, 3, elements);
  store_host_entries(q.target, targets + LANES * i, 1, elements);
}

/// Triangles. `corners`: their vertices. `rest`: their edges' vectors, and 1 over how many triangles each edge has.
/// `weights`: length weights of their edges. Sums: transform, normal, scale.
kernel void fit_triangles(const int items, const int count, const scalar regularizer_weight,
                          const scalar mean_edge_length, global const int* corners, global const host_scalar* positions,
                          global const scalar* residues, global const scalar* inverses, global const scalar* normals,
                          global const scalar* rest, global const scalar* weights, global scalar* next_weights,
                          global host_scalar* right_hand_sides, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const lane_index own = own_elements(i, count);
  const Mat3 inverse = gather9(inverses, own);
  const Vec3 normal = gather3(normals, own);
  const Round now = sides_between(positions, residues, load_indices(corners, 3, 0, i), load_indices(corners, 3, 1, i),
                                  load_indices(corners, 3, 2, i));
  const real mean = (real)mean_edge_length;
  TriangleTerms sum = no_edges((real)regularizer_weight);
  sum = add_edge(sum, inverse, normal, now.first, load_tile3(rest, 12, 0, i), load_tile(weights, 3, 0, i),
                 load_tile(rest, 12, 9, i), mean);
  sum = add_edge(sum, inverse, normal, now.second, load_tile3(rest, 12, 3, i), load_tile(weights, 3, 1, i),
                 load_tile(rest, 12, 10, i), mean);
  sum = add_edge(sum, inverse, normal, now.third, load_tile3(rest, 12, 6, i), load_tile(weights, 3, 2, i),
                 load_tile(rest, 12, 11, i), mean);
  store_tile(length_weight(now.first, mean), next_weights, 3, 0, i);
  store_tile(length_weight(now.second, mean), next_weights, 3, 1, i);
  store_tile(length_weight(now.third, mean), next_weights, 3, 2, i);
  const real present = present_lanes(i, count);
  store_sums(i, sums, present * sum.transform, present * sum.normal, present * sum.scale);
  store_host_rows9(sum.right_hand_side, right_hand_sides, i, count);
}

/// `rest` of a triangle with sphericity: axis, cosines, sines, three unit sides, sphericity weight, 1 over the sides'
/// lengths.
static inline Corners load_turns(global const scalar* rest, int i) {
  Corners turns;
  turns.axis = load_tile3(rest, 22, 0, i);
  turns.cosines = load_tile3(rest, 22, 3, i);
  turns.sines = load_tile3(rest, 22, 6, i);
  return turns;
}

static inline void store_sphericity(global const scalar* rest, Sides now, int i, int count, global scalar* sums) {
  const real weight = present_lanes(i, count) * load_tile(rest, 22, 18, i);
  store_sums(i, sums, weight * sum_of_squares(corner_misses(load_turns(rest, i), now)), (real)0, (real)0);
}

/// Triangles with sphericity. Sum: transform_sphericity.
kernel void map_corners(const int items, const int count, global const int* triangles, global const scalar* rest,
                        global const host_scalar* transforms, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const Mat3 transform = gather_host9(transforms, load_indices(triangles, 1, 0, i));
  const Sides unit = sides(load_tile3(rest, 22, 9, i), load_tile3(rest, 22, 12, i), load_tile3(rest, 22, 15, i));
  store_sphericity(rest, map_sides(transform, unit), i, count, sums);
}

/// Triangles with sphericity. `corners`: their vertices. Sum: sphericity.
kernel void place_corners(const int items, const int count, global const int* corners, global const scalar* rest,
                          global const host_scalar* positions, global const scalar* residues, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const lane_index a = load_indices(corners, 3, 0, i), b = load_indices(corners, 3, 1, i),
                   c = load_indices(corners, 3, 2, i);
  const Vec3 shrink = load_tile3(rest, 22, 19, i);
  const Round now = sides_between(positions, residues, a, b, c);
  const Sides relative = sides(scale3(shrink.x, now.first), scale3(shrink.y, now.second), scale3(shrink.z, now.third));
  store_sphericity(rest, relative, i, count, sums);
}

/// Sums of GROUP items' sums. One item an element.
kernel void add_up(const int count, const int terms, global const scalar* sums, global scalar* sums_of_sums) {
  const int i = get_global_id(0);
  if (i >= count) return;
  scalar4 sum = 0;
  for (int k = GROUP * i; k < min(GROUP * (i + 1), terms); ++k) sum += vload4((size_t)k, sums);
  vstore4(sum, (size_t)i, sums_of_sums);
}
