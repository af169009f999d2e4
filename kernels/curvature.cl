// The curvature step.
#include "shared/lanes.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/lane_memory.h"
#include "shared/quadric.h"

/// a[width * at + k] of each lane's `at`.
static inline real gather(global const scalar* a, global const int* at, int width) {
#if LANES == 1
  return a[width * at[0]];
#else
  return (real)(a[width * at[0]], a[width * at[1]], a[width * at[2]], a[width * at[3]], a[width * at[4]],
                a[width * at[5]], a[width * at[6]], a[width * at[7]], a[width * at[8]], a[width * at[9]],
                a[width * at[10]], a[width * at[11]], a[width * at[12]], a[width * at[13]], a[width * at[14]],
                a[width * at[15]]);
#endif
}

static inline Vec3 gather3(global const scalar* a, global const int* at, int width) {
  return vec3(gather(a, at, width), gather(a + 1, at, width), gather(a + 2, at, width));
}

/// Of vertices: positions, and what rounding to single precision took from them, so that differences of near ones stay
/// exact.
typedef struct {
  Vec3 position, rest;
} Place;

static inline Place place(global const scalar* places, global const int* vertices) {
  Place p;
  p.position = gather3(places, vertices, 8);
  p.rest = gather3(places + 4, vertices, 8);
  return p;
}

static inline Vec3 offset(Place from, Place to) {
  return add3(sub3(to.position, from.position), sub3(to.rest, from.rest));
}

/// One item LANES vertices. `neighbours` in slots of LANES, an item's from slots[i] to slots[i + 1]: its vertices, then
/// a neighbour of each; the vertex itself where there are no more.
kernel void fit_curvatures(const int count, const int stride, global const int* slots, global const int* neighbours,
                           global const scalar* places, global const scalar* normals, global scalar* curvatures) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const global int* vertices = neighbours + (long)LANES * slots[i];
  const global int* first = vertices + LANES;
  const global int* last = neighbours + (long)LANES * slots[i + 1];
  const Place own = place(places, vertices);
  const Vec3 normal = load_lanes3(normals, stride, 0, i);
  const Plane plane = plane_normal_to(normal);
  Spread spread = no_spread();
  for (const global int* n = first; n < last; n += LANES) {
    spread = spread_to(spread, plane, normal, offset(own, place(places, n)));
  }
  const Units units = units_of(spread, plane);
  Triangle triangle = no_equations();
  for (const global int* n = first; n < last; n += LANES) {
    triangle = fold(triangle, terms_at(units, normal, offset(own, place(places, n))));
  }
  const PrincipalCurvatures k =
      principal_curvatures(coefficients(orthogonal(rows_of(triangle))), units.per_u, units.per_w);
  store_lanes(k.k1, curvatures, i);
  store_lanes(k.k2, curvatures + stride, i);
}
