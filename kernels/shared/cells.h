// Which cells of a grid a triangle touches, in C99 ∩ C++, after vec3.h. In units of cells: cell (i, j, k) reaches from
// i to i + 1 and so on. A triangle and a cube meet unless one of thirteen axes separates them: the cube's, the
// triangle's normal, and the products of their edges. For the cubes of one row each axis leaves a range of middles x,
// in closed form, and those of a product with the row's direction decide which rows meet at all. So a triangle costs as
// many steps as it touches rows.

/// Along each axis the places of three corners.
typedef struct {
  Vec3 x, y, z;
} Places;

/// No NaN comes here, which fmin() and fmax() would look for.
static inline real less_of(real a, real b) { return a < b ? a : b; }
static inline real more_of(real a, real b) { return a < b ? b : a; }

/// From low to high; none where that is below.
typedef struct {
  real low, high;
} Range;

static inline Range range(real low, real high) {
  Range r;
  r.low = low;
  r.high = high;
  return r;
}
static inline Range common(Range a, Range b) { return range(more_of(a.low, b.low), less_of(a.high, b.high)); }
static inline Range range_of(Vec3 v) { return range(less_of(less_of(v.x, v.y), v.z), more_of(more_of(v.x, v.y), v.z)); }
static inline Range widened(Range r, real by) { return range(r.low - by, r.high + by); }

/// Where slope x lies in the range.
static inline Range quotients(Range r, real slope) {
  const real far = (real)1e30;
  const real low = r.low / slope, high = r.high / slope;
  const int any = r.low <= (real)0 && r.high >= (real)0;
  if (slope == (real)0) return any ? range(-far, far) : range(far, -far);
  return range(less_of(low, high), more_of(low, high));
}

/// A side in the plane of two axes: from (x, y) by (dx, dy), and where the third corner lies across it.
typedef struct {
  real x, y, dx, dy, third;
} Edge;

static inline Edge edge(real x, real y, real to_x, real to_y, real third_x, real third_y) {
  Edge e;
  e.x = x;
  e.y = y;
  e.dx = to_x - x;
  e.dy = to_y - y;
  e.third = e.dx * (third_y - y) - e.dy * (third_x - x);
  return e;
}

/// The x of the middles at y of squares, of half a side `radius`, that the side does not separate from the triangle.
static inline Range not_separated(Edge e, real y, real radius) {
  const real reach = radius * (fabs(e.dx) + fabs(e.dy)), at = e.dx * (y - e.y);
  const Range across = range(less_of(e.third, (real)0) - reach - at, more_of(e.third, (real)0) + reach - at);
  const Range x = quotients(across, -e.dy);
  return range(x.low + e.x, x.high + e.x);
}

/// The same of a triangle's projection with corners (x, y).
static inline Range row_in_plane(Vec3 x, Vec3 y, real at_y, real radius) {
  Range row = widened(range_of(x), radius);
  for (int k = 0; k < 3; ++k) {
    row = common(row, not_separated(edge(x.x, y.x, x.y, y.y, x.z, y.z), at_y, radius));
    x = vec3(x.y, x.z, x.x);
    y = vec3(y.y, y.z, y.x);
  }
  return row;
}

/// The y of the middles of cubes at z, as far as the triangle reaches along z, that may meet it.
static inline Range rows_at(Places p, real z, real radius) { return row_in_plane(p.y, p.z, z, radius); }

/// The x of the middles of cubes at (y, z), among rows_at(z), that meet the triangle.
static inline Range cubes_at(Places p, real y, real z, real radius) {
  const Vec3 first = vec3(p.x.y - p.x.x, p.y.y - p.y.x, p.z.y - p.z.x);
  const Vec3 second = vec3(p.x.z - p.x.x, p.y.z - p.y.x, p.z.z - p.z.x);
  const Vec3 normal = cross3(first, second);
  const real reach = radius * (fabs(normal.x) + fabs(normal.y) + fabs(normal.z));
  const real at = normal.y * (y - p.y.x) + normal.z * (z - p.z.x);
  // Without area a normal is what rounding makes of it, and an axis as any other.
  const Range corners = widened(range_of(vec3((real)0, dot3(normal, first), dot3(normal, second))), reach);
  const Range plane = quotients(range(corners.low - at, corners.high - at), normal.x);
  return common(range(plane.low + p.x.x, plane.high + p.x.x),
                common(row_in_plane(p.x, p.y, y, radius), row_in_plane(p.x, p.z, z, radius)));
}

/// Cells whose middles lie in a range, of `count`: `first` to `last`, none where that is below.
typedef struct {
  int first, last;
} Cells;

static inline Cells cells_in(Range r, int count) {
  Cells c;
  const real top = (real)count;
  // Clamped before it becomes an int.
  c.first = (int)ceil(less_of(more_of(r.low - (real)0.5, (real)0), top));
  c.last = (int)floor(less_of(more_of(r.high - (real)0.5, (real)-1), top - (real)1));
  return c;
}

/// Of eight corners of a cell, x running fastest, along one axis: at a place in the cell, from 0 to 1.
static inline real blend(real at, real low, real high) { return ((real)1 - at) * low + at * high; }
static inline Vec3 blend3(real at, Vec3 low, Vec3 high) { return add3(scale3((real)1 - at, low), scale3(at, high)); }
