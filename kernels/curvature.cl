// The curvature step.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/lane_memory.h"
#include "shared/quadric.h"

/// a[at] of each lane, from places in memory: taking them one by one from a vector would cost more.
INLINE real gather_slot(global const scalar* a, global const int* at) {
#if LANES == 1
  return a[at[0]];
#else
  return (real)(a[at[0]], a[at[1]], a[at[2]], a[at[3]], a[at[4]], a[at[5]], a[at[6]], a[at[7]], a[at[8]], a[at[9]],
                a[at[10]], a[at[11]], a[at[12]], a[at[13]], a[at[14]], a[at[15]]);
#endif
}

/// From vertices to others, along one axis. `places`: a row a vertex, its position and, in single precision, what
/// rounding took from that: differences of near positions stay exact.
INLINE real difference(global const scalar* places, global const int* from, global const int* to) {
  const real rounded = gather_slot(places, to) - gather_slot(places, from);
  if (sizeof(scalar) != sizeof(float)) return rounded;
  return rounded + (gather_slot(places + 3, to) - gather_slot(places + 3, from));
}

/// One item LANES vertices. `slots`: LANES vertices each, by where their rows of `places` begin. An item's, from
/// first_slots[i] to first_slots[i + 1], have its vertices, then a neighbour of each, the vertex itself where it has no
/// more.
kernel void fit_curvatures(const int count, const int stride, global const int* first_slots, global const int* slots,
                           global const scalar* places, global const scalar* normals, global scalar* curvatures,
                           const int with_directions, global scalar* directions) {
  const int i = get_global_id(0);
  if (i >= count) return;
  global const int* own = slots + (long)LANES * first_slots[i];
  global const int* end = slots + (long)LANES * first_slots[i + 1];
  const Vec3 normal = load_lanes3(normals, stride, 0, i);
  const Plane plane = plane_normal_to(normal);
  Spread spread = no_spread();
  for (global const int* to = own + LANES; to < end; to += LANES) {
    const real x = difference(places, own, to), y = difference(places + 1, own, to);
    const real z = difference(places + 2, own, to);
    spread = spread_to(spread, plane, normal, vec3(x, y, z));
  }
  const Units units = units_of(spread, plane);
  Triangle triangle = no_equations();
  for (global const int* to = own + LANES; to < end; to += LANES) {
    const real x = difference(places, own, to), y = difference(places + 1, own, to);
    const real z = difference(places + 2, own, to);
    triangle = fold(triangle, terms_at(units, normal, vec3(x, y, z)));
  }
  const Rows rows = orthogonal(rows_of(triangle), sizeof(scalar));
  const Graph graph = graph_of(coefficients(rows), units.per_u, units.per_w);
  const PrincipalCurvatures k = principal_curvatures(graph);
  store_entries(k.k1, curvatures + 2 * LANES * i, 2);
  store_entries(k.k2, curvatures + 2 * LANES * i + 1, 2);
  if (!with_directions) return;
  const Vec3 first = first_direction(graph, units, normal);
  store_entries(first.x, directions + 3 * LANES * i, 3);
  store_entries(first.y, directions + 3 * LANES * i + 1, 3);
  store_entries(first.z, directions + 3 * LANES * i + 2, 3);
}
