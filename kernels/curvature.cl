// The curvature step: fold_neighbours, sweep_rows some times, fit_curvatures.
#include "shared/scalar.h"
#include "shared/vec3.h"
#include "shared/mat3.h"
#include "shared/symmetric.h"
#include "shared/memory.h"
#include "shared/quadric.h"

/// From vertex i to j. `places`: a row a vertex, its position and what rounding took from that: differences of near
/// positions stay exact.
static inline Vec3 offset_between(global const real* places, int i, int j) {
  return add3(sub3(row3(places, 2 * j), row3(places, 2 * i)), sub3(row3(places, 2 * j + 1), row3(places, 2 * i + 1)));
}

static inline Terms load_terms(global const real* a, int n, int k, int i) {
  return terms(a[n * k + i], a[n * (k + 1) + i], a[n * (k + 2) + i], a[n * (k + 3) + i], a[n * (k + 4) + i],
               a[n * (k + 5) + i]);
}
static inline void store_terms(Terms t, global real* a, int n, int k, int i) {
  a[n * k + i] = t.xx;
  a[n * (k + 1) + i] = t.xy;
  a[n * (k + 2) + i] = t.yy;
  a[n * (k + 3) + i] = t.x;
  a[n * (k + 4) + i] = t.y;
  a[n * (k + 5) + i] = t.z;
}

/// In 30 columns.
static inline Rows load_rows(global const real* a, int n, int i) {
  Rows r;
  r.a = load_terms(a, n, 0, i);
  r.b = load_terms(a, n, 6, i);
  r.c = load_terms(a, n, 12, i);
  r.d = load_terms(a, n, 18, i);
  r.e = load_terms(a, n, 24, i);
  return r;
}
static inline void store_rows(Rows r, global real* a, int n, int i) {
  store_terms(r.a, a, n, 0, i);
  store_terms(r.b, a, n, 6, i);
  store_terms(r.c, a, n, 12, i);
  store_terms(r.d, a, n, 18, i);
  store_terms(r.e, a, n, 24, i);
}

/// One item a vertex. `units`: 1 / spread along either axis, in two columns. A kernel of its own, for its loops.
kernel void fold_neighbours(const int count, global const int* offsets, global const int* neighbours,
                            global const real* places, global const real* normals, global real* units,
                            global real* rows) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int first = offsets[i], last = offsets[i + 1];
  const Vec3 normal = row3(normals, i);
  const Plane plane = plane_normal_to(normal);
  Spread spread = no_spread();
  for (int k = first; k < last; ++k) {
    spread = spread_to(spread, plane, normal, offset_between(places, i, neighbours[k]));
  }
  // Fewer than five neighbours tell nothing.
  const Units own = units_of(last - first < 5 ? no_spread() : spread, plane);
  Triangle r = no_equations();
  for (int k = first; k < last; ++k) {
    r = fold(r, terms_at(own, normal, offset_between(places, i, neighbours[k])));
  }
  units[i] = own.per_u;
  units[count + i] = own.per_w;
  store_rows(rows_of(r), rows, count, i);
}

/// One item a vertex: one sweep. PoCL vectorises one, but not two in one kernel.
kernel void sweep_rows(const int count, global real* rows) {
  const int i = get_global_id(0);
  if (i >= count) return;
  store_rows(sweep(load_rows(rows, count, i)), rows, count, i);
}

/// One item a vertex.
kernel void fit_curvatures(const int count, global const real* units, global const real* rows,
                           global real* curvatures) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const PrincipalCurvatures k =
      principal_curvatures(coefficients(load_rows(rows, count, i)), units[i], units[count + i]);
  curvatures[i] = k.k1;
  curvatures[count + i] = k.k2;
}
