// The transform step. All lies in columns but positions, which are gathered alone.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/transform.h"
#include "shared/triangle.h"
#include "shared/memory.h"

/// One item a triangle.
kernel void invert(const int count, global const real* transforms, global real* inverses, global real* damped) {
  const int t = get_global_id(0);
  if (t >= count) return;
  const Inverse inverse = damped_inverse(column9(transforms, count, t));
  store_column9(inverse.matrix, inverses, count, t);
  damped[t] = inverse.damped;
}

/// One item an edge. `beside`: its first two triangles, or the one twice.
kernel void fit_edges(const int count, const int triangles, const real normal_weight, const real scale,
                      global const int* beside, global const real* transforms, global const real* inverses,
                      global const real* normals, global const real* rests, global const real* weights,
                      global const real* kept, global real* blocks, global real* sides, global real* targets) {
  const int e = get_global_id(0);
  if (e >= count) return;
  const int t = beside[e], s = beside[count + e];
  const real two = t != s ? (real)1 : (real)0;
  const Vec3 rest = column3(rests, count, 0, e);
  EdgeSum sum = add_side(no_sides(), 1, column9(transforms, triangles, t), column9(inverses, triangles, t),
                         column3(normals, triangles, 0, t), rest);
  sum = add_side(sum, two, column9(transforms, triangles, s), column9(inverses, triangles, s),
                 column3(normals, triangles, 0, s), rest);
  const EdgeQuadratic quadratic = edge_quadratic(sum, rest, weights[e], kept[e], normal_weight, scale);
  store_column6(quadratic.block, blocks, count, e);
  store_column3(quadratic.side, sides, count, 0, e);
  targets[e] = quadratic.target;
}

/// The same for the few edges with more triangles: the item's stand at offsets[i] .. offsets[i + 1] of `beside`.
kernel void fit_crowded_edges(const int count, const int all_edges, const int triangles, const real normal_weight,
                              const real scale, global const int* edges, global const int* offsets,
                              global const int* beside, global const real* transforms, global const real* inverses,
                              global const real* normals, global const real* rests, global const real* weights,
                              global const real* kept, global real* blocks, global real* sides, global real* targets) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int e = edges[i];
  const Vec3 rest = column3(rests, all_edges, 0, e);
  EdgeSum sum = no_sides();
  for (int k = offsets[i]; k < offsets[i + 1]; ++k) {
    const int t = beside[k];
    sum = add_side(sum, 1, column9(transforms, triangles, t), column9(inverses, triangles, t),
                   column3(normals, triangles, 0, t), rest);
  }
  const EdgeQuadratic quadratic = edge_quadratic(sum, rest, weights[e], kept[e], normal_weight, scale);
  store_column6(quadratic.block, blocks, all_edges, e);
  store_column3(quadratic.side, sides, all_edges, 0, e);
  targets[e] = quadratic.target;
}

/// From vertex i to j. `residues` are what rounding took from the positions: differences of near positions stay exact.
static inline Vec3 side_between(global const real* positions, global const real* residues, int i, int j) {
  return add3(sub3(row3(positions, j), row3(positions, i)), sub3(row3(residues, j), row3(residues, i)));
}

/// One item an edge.
kernel void measure_edges(const int count, const real mean_edge_length, global const int* ends,
                          global const real* positions, global const real* residues, global const real* rests,
                          global real* vectors, global real* weights, global real* terms) {
  const int e = get_global_id(0);
  if (e >= count) return;
  const Vec3 vector = side_between(positions, residues, ends[e], ends[count + e]);
  const Vec3 change = sub3(vector, column3(rests, count, 0, e));
  store_column3(vector, vectors, count, 0, e);
  weights[e] = length_weight(vector, mean_edge_length);
  terms[e] = dot3(change, change);
}

/// One item a triangle.
kernel void fit_triangles(const int count, const int all_edges, const real regularizer_weight,
                          const real mean_edge_length, global const int* edges, global const real* transforms,
                          global const real* inverses, global const real* normals, global const real* vectors,
                          global const real* rests, global const real* weights, global real* right_hand_sides,
                          global real* terms) {
  const int t = get_global_id(0);
  if (t >= count) return;
  const int a = edges[t], b = edges[count + t], c = edges[2 * count + t];
  const Mat3 transform = column9(transforms, count, t), inverse = column9(inverses, count, t);
  const Vec3 normal = column3(normals, count, 0, t);
  const real mean = mean_edge_length;
  TriangleTerms sum = no_edges(transform, regularizer_weight);
  sum = add_edge(sum, transform, inverse, normal, column3(vectors, all_edges, 0, a), column3(rests, all_edges, 0, a),
                 weights[a], mean);
  sum = add_edge(sum, transform, inverse, normal, column3(vectors, all_edges, 0, b), column3(rests, all_edges, 0, b),
                 weights[b], mean);
  sum = add_edge(sum, transform, inverse, normal, column3(vectors, all_edges, 0, c), column3(rests, all_edges, 0, c),
                 weights[c], mean);
  store_column9(sum.right_hand_side, right_hand_sides, count, t);
  terms[t] = sum.transform;
  terms[count + t] = sum.normal;
  terms[2 * count + t] = sum.transform_normal;
  terms[3 * count + t] = sum.regularizer;
}

/// One item a pair of triangles. `rest`: unit direction of the edge, unit vector between the opposite vertices,
/// similarity weight.
kernel void compare_pairs(const int count, const int triangles, global const int* pairs, global const real* rest,
                          global const real* transforms, global real* terms) {
  const int p = get_global_id(0);
  if (p >= count) return;
  const Mat3 transform = column9(transforms, triangles, pairs[p]),
             other = column9(transforms, triangles, pairs[count + p]);
  terms[p] = disagreement(transform, other, column3(rest, count, 0, p));
  terms[count + p] = rest[6 * count + p] * disagreement(transform, other, column3(rest, count, 3, p));
}

/// One item a triangle with sphericity. `corners`: its vertices. `rest`: axis, cosines, sines, three unit sides,
/// sphericity weight, 1 over the sides' lengths.
kernel void compare_corners(const int count, const int all_triangles, global const int* triangles,
                            global const int* corners, global const real* rest, global const real* positions,
                            global const real* residues, global const real* transforms, global real* terms) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int a = corners[i], b = corners[count + i], c = corners[2 * count + i];
  Corners turns;
  turns.axis = column3(rest, count, 0, i);
  turns.cosines = column3(rest, count, 3, i);
  turns.sines = column3(rest, count, 6, i);
  const Sides directions = sides(column3(rest, count, 9, i), column3(rest, count, 12, i), column3(rest, count, 15, i));
  const Vec3 shrink = column3(rest, count, 19, i);
  const Sides placed = sides(scale3(shrink.x, side_between(positions, residues, a, b)),
                             scale3(shrink.y, side_between(positions, residues, b, c)),
                             scale3(shrink.z, side_between(positions, residues, c, a)));
  const Sides mapped = map_sides(column9(transforms, all_triangles, triangles[i]), directions);
  const real weight = rest[18 * count + i];
  terms[i] = weight * sum_of_squares(corner_misses(turns, placed));
  terms[count + i] = weight * sum_of_squares(corner_misses(turns, mapped));
}

/// One item a sum: `blocks` for each row of `elements` terms, of every blocks-th term from its own on.
kernel void add_up(const int count, const int elements, const int blocks, global const real* terms, global real* sums) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int row = i / blocks;
  real sum = 0;
  for (int k = i % blocks; k < elements; k += blocks) sum += terms[row * elements + k];
  sums[i] = sum;
}
