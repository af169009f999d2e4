// The transform step: invert, fit_edges and map_corners of the transforms, fit_triangles and place_corners of the
// positions. One item LANES elements. What is gathered and what is the host's lies in rows, the rest in tiles.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/wide.h"
#include "shared/transform.h"
#include "shared/triangle.h"
#include "shared/lane_memory.h"
#include "shared/lane_rows.h"
#include "shared/lane_sides.h"
#include "shared/lane_sums.h"

/// What stands by a triangle in a row of 12: its transform's inverse, which invert writes, and its normal.
typedef struct {
  Mat3 inverse;
  Vec3 normal;
} TriangleRow;

INLINE TriangleRow gather_triangle(global const scalar* triangle_rows, lane_index at) {
  const Four first = gather4(triangle_rows, 12 * at), second = gather4(triangle_rows + 4, 12 * at);
  const Four third = gather4(triangle_rows + 8, 12 * at);
  TriangleRow row;
  row.inverse = mat3_of_fours(first, second, third.x);
  row.normal = vec3(third.y, third.z, third.w);
  return row;
}

INLINE void store_inverse(Mat3 m, global scalar* triangle_rows, int i) {
  triangle_rows += 12 * LANES * i;
  scatter4(four(m.x.x, m.x.y, m.x.z, m.y.x), triangle_rows, 12);
  scatter4(four(m.y.y, m.y.z, m.z.x, m.z.y), triangle_rows + 4, 12);
  store_entries(m.z.z, triangle_rows + 8, 12);
}

/// Triangles. Sums: damped, regularizer, that of the normal.
kernel void invert(const int items, const int count, const int maps_normals, global const host_scalar* transforms,
                   global scalar* triangle_rows, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const Mat3 transform = gather_host9(transforms, own_elements(i, count));
  const Vec3 normal = gather_triangle(triangle_rows, own_elements(i, count)).normal;
  Mat3 inverted = transform;
  if (maps_normals) inverted = with_mapped_normal(transform, normal);
  const Inverse inverse = damped_inverse(inverted);
  const real present = present_lanes(i, count);
  store_sums(i, sums, present * inverse.damped, present * distance_from_identity(transform),
             present * distance_from_normal(transform, normal));
  store_inverse(inverse.matrix, triangle_rows, i);
}

INLINE void store_quadratic(EdgeQuadratic q, real target, int first, int elements, global host_scalar* blocks,
                            global host_scalar* sides, global host_scalar* targets) {
  blocks += 6 * first, sides += 3 * first;
  store_wide_entries(q.block.diagonal.x, blocks, 6, elements);
  store_wide_entries(q.block.mixed.x, blocks + 1, 6, elements);
  store_wide_entries(q.block.mixed.y, blocks + 2, 6, elements);
  store_wide_entries(q.block.diagonal.y, blocks + 3, 6, elements);
  store_wide_entries(q.block.mixed.z, blocks + 4, 6, elements);
  store_wide_entries(q.block.diagonal.z, blocks + 5, 6, elements);
  store_wide_entries(q.side.x, sides, 3, elements);
  store_wide_entries(q.side.y, sides + 1, 3, elements);
  store_wide_entries(q.side.z, sides + 2, 3, elements);
  store_host_entries(target, targets + first, 1, elements);
}

INLINE EdgeSum side_of(Vec3 mapped, TriangleRow row, Vec3 edge) {
  return edge_side(mapped, row.inverse, row.normal, edge);
}

/// Edges. `beside`: their two triangles, or the one twice where there is one only or fit_crowded_edges sees to the
/// others, and where one of them has the edge's length weight. `rest`: vector, unit vector between the opposite
/// vertices, similarity weight, kept target length or 0. `target_weights`: length weights of target lengths, for
/// fit_triangles; they replace `weights` where `weighs_targets`. Sums: transform_normal, connect, similarity.
kernel void fit_edges(const int items, const int count, const int weighs_targets, const scalar mean_edge_length,
                      const scalar normal_weight, const scalar scale, global const int* beside,
                      global const scalar* rest, global const scalar* weights, global const host_scalar* transforms,
                      global const scalar* triangle_rows, global scalar* target_weights, global host_scalar* blocks,
                      global host_scalar* sides, global host_scalar* targets, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const lane_index t = load_indices(beside, 3, 0, i), s = load_indices(beside, 3, 1, i);
  const Vec3 edge = load_tile3(rest, 8, 0, i), opposite = load_tile3(rest, 8, 3, i);
  const Mat3 transform = gather_host9(transforms, t), other = gather_host9(transforms, s);
  const Mat3 difference = sub_mat3(transform, other);
  const real along = disagreement(difference, edge), across = disagreement(difference, opposite);
  const EdgeSum sum = add_sides(side_of(apply3(transform, edge), gather_triangle(triangle_rows, t), edge),
                                side_of(apply3(other, edge), gather_triangle(triangle_rows, s), edge));
  const real share = (real)0.5 + (real)0.5 * one_where(t != s);
  const real target = target_length((real)0.5 * sum.length, load_tile(rest, 8, 7, i), edge);
  real weight = length_weight(target * target, (real)mean_edge_length);
  store_lanes(weight, target_weights, i);
  if (!weighs_targets) weight = gather(weights, load_indices(beside, 3, 2, i));
  const EdgeQuadratic q = edge_quadratic(sum, share, edge, weight, target, (real)normal_weight, (real)scale);
  const real present = present_lanes(i, count), per_square = present / dot3(edge, edge);
  store_sums(i, sums, per_square * share * sum.turned, per_square * along, present * load_tile(rest, 8, 6, i) * across);
  store_quadratic(q, target, LANES * i, elements_of(i, count), blocks, sides, targets);
}

// Where more than two triangles meet: few, so that each is an item of its own (Context::program_alone).
#if LANES == 1

/// The few edges with more triangles: the item's at offsets[i] .. offsets[i + 1] of `beside`, the first of them summed
/// by fit_edges. Terms: transform_normal.
kernel void fit_crowded_edges(const int count, const int weighs_targets, const scalar mean_edge_length,
                              const scalar normal_weight, const scalar scale, global const int* edges,
                              global const int* offsets, global const int* beside, global const scalar* rest,
                              global const int* weight_places, global const scalar* weights,
                              global const host_scalar* transforms, global const scalar* triangle_rows,
                              global scalar* target_weights, global host_scalar* blocks, global host_scalar* sides,
                              global host_scalar* targets, global scalar* terms) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int e = edges[i], first = offsets[i], last = offsets[i + 1];
  const Vec3 edge = load_tile3(rest, 8, 0, e);
  EdgeSum sum = no_sides();
  real turned_by_first = 0;
  for (int k = first; k < last; ++k) {
    const Mat3 transform = gather_host9(transforms, beside[k]);
    sum = add_sides(sum, side_of(apply3(transform, edge), gather_triangle(triangle_rows, beside[k]), edge));
    if (k == first) turned_by_first = sum.turned;
  }
  terms[i] = (sum.turned - turned_by_first) / dot3(edge, edge);
  const real target = target_length(sum.length / (real)(last - first), load_tile(rest, 8, 7, e), edge);
  target_weights[e] = length_weight(target * target, mean_edge_length);
  const real weight = weighs_targets ? target_weights[e] : weights[weight_places[e]];
  store_quadratic(edge_quadratic(sum, 1, edge, weight, target, normal_weight, scale), target, e, 1, blocks, sides,
                  targets);
}

/// Pairs of triangles that fit_edges does not see. `rest` as of its edges, in rows. Terms: connect, similarity, a row a
/// pair.
kernel void compare_pairs(const int count, global const int* pairs, global const scalar* rest,
                          global const host_scalar* transforms, global scalar* terms) {
  const int p = get_global_id(0);
  if (p >= count) return;
  global const scalar* own = rest + 8 * p;
  const Mat3 difference = sub_mat3(gather_host9(transforms, pairs[2 * p]), gather_host9(transforms, pairs[2 * p + 1]));
  const Vec3 edge = gather3(own, 0);
  terms[2 * p] = disagreement(difference, edge) / dot3(edge, edge);
  terms[2 * p + 1] = own[6] * disagreement(difference, gather3(own, 1));
}
#endif

/// Of edge k of a triangle: `weights` in tiles, or of its edges those that fit_edges left in `target_weights`.
INLINE real weight_of_edge(int weighs_targets, global const int* edges, global const scalar* target_weights,
                           global const scalar* weights, int k, int i) {
  if (weighs_targets) return gather(target_weights, load_indices(edges, 3, k, i));
  return load_tile(weights, 3, k, i);
}

/// Triangles. `corners`: their vertices. `edges`: their edges. `rest`: their edges' vectors, and 1 over how many
/// triangles each edge has. `weights`: length weights of their edges. Sums: transform, normal, scale.
kernel void fit_triangles(const int items, const int count, const int weighs_targets, const scalar regularizer_weight,
                          const scalar normal_regularizer_weight, const scalar mean_edge_length,
                          global const int* corners, global const int* edges, global const host_scalar* positions,
                          global const scalar* residues, global const scalar* triangle_rows, global const scalar* rest,
                          global const scalar* target_weights, global const scalar* weights,
                          global scalar* next_weights, global host_scalar* right_hand_sides, global scalar* sums) {
  const int i = get_global_id(0);
  if (i >= items) return;
  const TriangleRow row = gather_triangle(triangle_rows, own_elements(i, count));
  const Sides now = sides_between(positions, residues, load_indices(corners, 3, 0, i), load_indices(corners, 3, 1, i),
                                  load_indices(corners, 3, 2, i));
  const real mean = (real)mean_edge_length;
  TriangleTerms sum = no_edges(row.normal, (real)regularizer_weight, (real)normal_regularizer_weight);
  sum = add_edge(sum, row.inverse, row.normal, now.first, load_tile3(rest, 12, 0, i),
                 weight_of_edge(weighs_targets, edges, target_weights, weights, 0, i), load_tile(rest, 12, 9, i), mean);
  sum =
      add_edge(sum, row.inverse, row.normal, now.second, load_tile3(rest, 12, 3, i),
               weight_of_edge(weighs_targets, edges, target_weights, weights, 1, i), load_tile(rest, 12, 10, i), mean);
  sum =
      add_edge(sum, row.inverse, row.normal, now.third, load_tile3(rest, 12, 6, i),
               weight_of_edge(weighs_targets, edges, target_weights, weights, 2, i), load_tile(rest, 12, 11, i), mean);
  store_tile(length_weight(dot3(now.first, now.first), mean), next_weights, 3, 0, i);
  store_tile(length_weight(dot3(now.second, now.second), mean), next_weights, 3, 1, i);
  store_tile(length_weight(dot3(now.third, now.third), mean), next_weights, 3, 2, i);
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
  const Sides now = sides_between(positions, residues, a, b, c);
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
