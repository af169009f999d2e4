// The quadric height z = a x² + b x y + c y² + d x + e y over a vertex's tangent plane that fits its neighbours best,
// and its principal curvatures (Goldfeather and Interrante 2004). In C99 ∩ C++, after vec3.h. Two passes over the
// neighbours, then no branches:
//  1. How far they spread along the plane's principal axes: the units that the fit measures lengths in.
//  2. The triangle R of the fit's least squares, a neighbour after the other, by rotations without square roots
//     (Gentleman 1973). Normal equations would square a condition that single precision has no room for.
//  3. The singular values of R: its rows are turned until they are orthogonal (Hestenes 1958), the right-hand side with
//     them. Values below kSingular of the largest count as 0: the flattest of all quadrics that fit as well.
//  4. The curvatures of that quadric's graph.
// Both passes keep 1 / weight: so a neighbour at the vertex itself changes no bit of what either has, and lists of
// neighbours can be filled up with it.

/// Two directions that span the plane normal to a unit vector.
typedef struct {
  Vec3 u, w;
} Plane;

/// Both 0 where n is.
static inline Plane plane_normal_to(Vec3 n) {
  const mask along_x = fabs(n.x) > fabs(n.y);
  const Vec3 v = vec3(along_x ? -n.z : (real)0, along_x ? (real)0 : n.z, along_x ? n.x : -n.y);
  const real length = sqrt(dot3(v, v));
  Plane plane;
  plane.u = scale3(length > (real)0 ? (real)1 / length : (real)0, v);
  plane.w = cross3(n, plane.u);
  return plane;
}

/// Of places (x, y) in a plane and heights over it: the triangle [√xx, √xx r; 0, √yy] of the places, and the sum of the
/// squared heights.
typedef struct {
  real inverse_xx, r, yy, zz;
} Spread;

static inline Spread no_spread(void) {
  Spread s;
  s.inverse_xx = (real)1e35;  // xx is never 0.
  s.r = s.yy = s.zz = (real)0;
  return s;
}

static inline Spread spread_to(Spread s, Plane plane, Vec3 normal, Vec3 offset) {
  const real x = dot3(offset, plane.u), y = dot3(offset, plane.w), z = dot3(offset, normal);
  const real part = s.inverse_xx * x, kept = (real)1 / ((real)1 + part * x), rest = y - x * s.r;
  Spread to;
  to.inverse_xx = s.inverse_xx * kept;
  to.r = kept * (s.r + part * y);
  to.yy = s.yy + kept * rest * rest;
  to.zz = s.zz + z * z;
  return to;
}

/// The plane's principal axes, each in parts of the spread along it, and 1 / spread. All 0 where the places lie on a
/// line, seen along the normal.
typedef struct {
  Plane axes;
  real per_u, per_w;
} Units;

static inline Units units_of(Spread s, Plane plane) {
  const real xx = (real)1 / s.inverse_xx, xy = xx * s.r, yy = xy * s.r + s.yy;
  // As turn_rows does, with columns.
  const real h = yy - xx, size = fabs(h) + sqrt(h * h + (real)4 * xy * xy) + (real)1e-35;
  const real t = copysign((real)2, h) * xy / size;
  const real c = (real)1 / sqrt((real)1 + t * t), sine = c * t;
  const real a = sqrt(xx), b = a * s.r, e = sqrt(s.yy);
  const real ux = c * a - sine * b, uy = sine * e, wx = sine * a + c * b, wy = c * e;
  const real uu = sqrt(ux * ux + uy * uy), ww = sqrt(wx * wx + wy * wy);
  const real least = (real)1e-4 * sqrt(uu * uu + ww * ww + s.zz);  // kLine of the reference.
  const mask any = uu > least && ww > least;
  Units units;
  units.per_u = any ? (real)1 / uu : (real)0;
  units.per_w = any ? (real)1 / ww : (real)0;
  units.axes.u = scale3(units.per_u, sub3(scale3(c, plane.u), scale3(sine, plane.w)));
  units.axes.w = scale3(units.per_w, add3(scale3(sine, plane.u), scale3(c, plane.w)));
  return units;
}

/// An equation of the fit: xx a + xy √2 b' + yy c + x d + y e = z. With the root, b = √2 b', no turn of the axes
/// changes how flat a quadric counts.
typedef struct {
  real xx, xy, yy, x, y, z;
} Terms;

static inline Terms terms(real xx, real xy, real yy, real x, real y, real z) {
  Terms t;
  t.xx = xx;
  t.xy = xy;
  t.yy = yy;
  t.x = x;
  t.y = y;
  t.z = z;
  return t;
}

static inline Terms add_terms(Terms a, Terms b) {
  return terms(a.xx + b.xx, a.xy + b.xy, a.yy + b.yy, a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline Terms scale_terms(real s, Terms a) {
  return terms(s * a.xx, s * a.xy, s * a.yy, s * a.x, s * a.y, s * a.z);
}
static inline real dot_terms(Terms a, Terms b) {
  return a.xx * b.xx + a.xy * b.xy + a.yy * b.yy + a.x * b.x + a.y * b.y;
}

static inline Terms terms_at(Units units, Vec3 normal, Vec3 offset) {
  const real x = dot3(offset, units.axes.u), y = dot3(offset, units.axes.w), z = dot3(offset, normal);
  return terms(x * x, (real)1.4142135623730951 * x * y, y * y, x, y, z);
}

/// A row terms / √inverse_weight, its first term but for zeros 1.
typedef struct {
  real inverse_weight;
  Terms terms;
} Row;

static inline Row row(real inverse_weight, Terms of) {
  Row r;
  r.inverse_weight = inverse_weight;
  r.terms = of;
  return r;
}

/// R and the right-hand side turned with it: rows that begin, with 1, one after the other.
typedef struct {
  Row xx, xy, yy, x, y;
} Triangle;

/// But for weights that no rounding shows, so that none is 0.
static inline Triangle no_equations(void) {
  const real inverse = (real)1e30, o = (real)0, l = (real)1;
  Triangle r;
  r.xx = row(inverse, terms(l, o, o, o, o, o));
  r.xy = row(inverse, terms(o, l, o, o, o, o));
  r.yy = row(inverse, terms(o, o, l, o, o, o));
  r.x = row(inverse, terms(o, o, o, l, o, o));
  r.y = row(inverse, terms(o, o, o, o, l, o));
  return r;
}

/// How a row of the triangle is turned with another row so that the other's term `lead` below the row's 1 becomes 0.
typedef struct {
  real lead, kept, taken, inverse_weight, other_weight;
} Turn;

static inline Turn turn(real inverse_weight, real other_weight, real lead) {
  // The other's weight first: an empty row's inverse times a lead that such a row left behind is beyond single
  // precision.
  const real part = inverse_weight * (other_weight * lead);
  Turn t;
  t.lead = lead;
  t.kept = (real)1 / ((real)1 + part * lead);
  t.taken = part * t.kept;
  t.inverse_weight = inverse_weight * t.kept;
  t.other_weight = other_weight * t.kept;
  return t;
}

/// A term of the row, and of the other.
static inline real to_row(Turn t, real row, real other) { return t.kept * row + t.taken * other; }
static inline real to_other(Turn t, real row, real other) { return other - t.lead * row; }

static inline Triangle fold(Triangle r, Terms equation) {
  const real o = (real)0, l = (real)1;
  const Terms a = r.xx.terms, b = r.xy.terms, c = r.yy.terms, d = r.x.terms, e = r.y.terms;
  Triangle to;
  Terms f = equation;
  Turn t = turn(r.xx.inverse_weight, l, f.xx);
  to.xx = row(t.inverse_weight, terms(l, to_row(t, a.xy, f.xy), to_row(t, a.yy, f.yy), to_row(t, a.x, f.x),
                                      to_row(t, a.y, f.y), to_row(t, a.z, f.z)));
  f = terms(o, to_other(t, a.xy, f.xy), to_other(t, a.yy, f.yy), to_other(t, a.x, f.x), to_other(t, a.y, f.y),
            to_other(t, a.z, f.z));
  t = turn(r.xy.inverse_weight, t.other_weight, f.xy);
  to.xy = row(t.inverse_weight,
              terms(o, l, to_row(t, b.yy, f.yy), to_row(t, b.x, f.x), to_row(t, b.y, f.y), to_row(t, b.z, f.z)));
  f = terms(o, o, to_other(t, b.yy, f.yy), to_other(t, b.x, f.x), to_other(t, b.y, f.y), to_other(t, b.z, f.z));
  t = turn(r.yy.inverse_weight, t.other_weight, f.yy);
  to.yy = row(t.inverse_weight, terms(o, o, l, to_row(t, c.x, f.x), to_row(t, c.y, f.y), to_row(t, c.z, f.z)));
  f = terms(o, o, o, to_other(t, c.x, f.x), to_other(t, c.y, f.y), to_other(t, c.z, f.z));
  t = turn(r.x.inverse_weight, t.other_weight, f.x);
  to.x = row(t.inverse_weight, terms(o, o, o, l, to_row(t, d.y, f.y), to_row(t, d.z, f.z)));
  f = terms(o, o, o, o, to_other(t, d.y, f.y), to_other(t, d.z, f.z));
  t = turn(r.y.inverse_weight, t.other_weight, f.y);
  to.y = row(t.inverse_weight, terms(o, o, o, o, l, to_row(t, e.z, f.z)));
  return to;
}

/// R's rows and what becomes of them.
typedef struct {
  Terms a, b, c, d, e;
} Rows;

static inline Terms weighted(Row r) { return scale_terms((real)1 / sqrt(r.inverse_weight), r.terms); }

static inline Rows rows_of(Triangle r) {
  Rows rows;
  rows.a = weighted(r.xx);
  rows.b = weighted(r.xy);
  rows.c = weighted(r.yy);
  rows.d = weighted(r.x);
  rows.e = weighted(r.y);
  return rows;
}

/// Two rows turned by the smaller angle that makes them orthogonal; hardly where every angle does.
typedef struct {
  Terms p, q;
} Pair;

static inline Pair turn_rows(Terms p, Terms q) {
  const real o = (real)2 * dot_terms(p, q), h = dot_terms(q, q) - dot_terms(p, p);
  const real d = fabs(h) + sqrt(h * h + o * o) + (real)1e-18, inverse = (real)1 / sqrt(d * d + o * o);
  const real c = inverse * d, s = copysign(inverse, h) * o;
  Pair turned;
  turned.p = add_terms(scale_terms(c, p), scale_terms(-s, q));
  turned.q = add_terms(scale_terms(s, p), scale_terms(c, q));
  return turned;
}

/// Every two rows once.
static inline Rows sweep(Rows r) {
  const Pair ab = turn_rows(r.a, r.b), cd = turn_rows(r.c, r.d);
  const Pair ac = turn_rows(ab.p, cd.p), be = turn_rows(ab.q, r.e);
  const Pair ad = turn_rows(ac.p, cd.q), ce = turn_rows(ac.q, be.q);
  const Pair ae = turn_rows(ad.p, ce.q), bd = turn_rows(be.p, ad.q);
  const Pair bc = turn_rows(bd.p, ce.p), de = turn_rows(bd.q, ae.q);
  Rows swept;
  swept.a = ae.p;
  swept.b = bc.p;
  swept.c = bc.q;
  swept.d = de.p;
  swept.e = de.q;
  return swept;
}

/// Orthogonal but for the rounding of scalars of so many bytes.
static inline Rows orthogonal(Rows r, size_t scalar_size) {
  const int sweeps = scalar_size == sizeof(float) ? 5 : 6;
  for (int i = 0; i < sweeps; ++i) r = sweep(r);
  return r;
}

/// The larger one, but for rounding.
static inline real larger_value(real a, real b) { return a + (real)0.5 * (b - a + fabs(b - a)); }

/// What an orthogonal row tells of the coefficients: nothing where its square is below `least`.
static inline Terms told(Terms r, real least) {
  const real square = dot_terms(r, r);
  const mask any = square > least;
  return scale_terms(any ? r.z / (any ? square : (real)1) : (real)0, r);
}
static inline real counts(Terms r, real least) { return dot_terms(r, r) > least ? (real)1 : (real)0; }

/// From orthogonal rows: the coefficients a, b', c, d, e in the places of their terms; all 0 where more than one can't
/// be told.
static inline Terms coefficients(Rows r) {
  const real ab = larger_value(dot_terms(r.a, r.a), dot_terms(r.b, r.b));
  const real cd = larger_value(dot_terms(r.c, r.c), dot_terms(r.d, r.d));
  const real largest = larger_value(larger_value(ab, cd), dot_terms(r.e, r.e));
  const real least = (real)1e-6 * largest;  // kSingular of the reference, squared.
  const real rank =
      counts(r.a, least) + counts(r.b, least) + counts(r.c, least) + counts(r.d, least) + counts(r.e, least);
  const Terms sum =
      add_terms(add_terms(add_terms(told(r.a, least), told(r.b, least)), add_terms(told(r.c, least), told(r.d, least))),
                told(r.e, least));
  return scale_terms(rank > (real)3.5 ? (real)1 : (real)0, sum);
}

/// The graph of a quadric, its normal up: the gradient, C⁻¹ = [1 / p, 0; q, r] of the first fundamental form C Cᵀ, and
/// s C⁻¹ L C⁻ᵀ = [a, o; o, b], L the second.
typedef struct {
  real gx, gy, p, q, r, s, a, o, b;
} Graph;

/// Of the quadric with these coefficients in units of 1 / per_u and 1 / per_w.
static inline Graph graph_of(Terms of, real per_u, real per_w) {
  const real gx = per_u * of.x, gy = per_w * of.y;
  const real xx = (real)2 * per_u * per_u * of.xx, yy = (real)2 * per_w * per_w * of.yy;
  const real xy = (real)1.4142135623730951 * per_u * per_w * of.xy;
  const real pp = (real)1 + gx * gx, ss = pp + gy * gy, p = sqrt(pp), s = sqrt(ss);
  const real q = -gx * gy / (p * s), r = p / s;
  Graph g;
  g.gx = gx;
  g.gy = gy;
  g.p = p;
  g.q = q;
  g.r = r;
  g.s = s;
  g.a = xx / pp;
  g.o = (xx * q + xy * r) / p;
  g.b = q * q * xx + (real)2 * q * r * xy + r * r * yy;
  return g;
}

/// k1 >= k2.
typedef struct {
  real k1, k2;
} PrincipalCurvatures;

static inline PrincipalCurvatures principal_curvatures(Graph g) {
  const real mean = (real)0.5 * (g.a + g.b), h = (real)0.5 * (g.a - g.b), radius = sqrt(h * h + g.o * g.o);
  PrincipalCurvatures k;
  k.k1 = (radius - mean) / g.s;
  k.k2 = (-radius - mean) / g.s;
  return k;
}

/// Of k1: C⁻ᵀ times the eigenvector of the smaller eigenvalue. Any, or 0, where both are the same.
static inline Vec3 first_direction(Graph g, Units units, Vec3 normal) {
  const real h = (real)0.5 * (g.a - g.b), radius = sqrt(h * h + g.o * g.o);
  const mask second_is_smaller = h >= (real)0;
  const real y = second_is_smaller ? -g.o : radius - h, z = second_is_smaller ? h + radius + (real)1e-30 : -g.o;
  const real along_u = y / g.p + g.q * z, along_w = g.r * z;
  const mask any = units.per_u > (real)0;
  const Vec3 u = scale3(any ? (real)1 / (any ? units.per_u : (real)1) : (real)0, units.axes.u);
  const Vec3 w = scale3(any ? (real)1 / (any ? units.per_w : (real)1) : (real)0, units.axes.w);
  const Vec3 v = add3(add3(scale3(along_u, u), scale3(along_w, w)),
                      scale3(any ? along_u * g.gx + along_w * g.gy : (real)0, normal));
  const real length = sqrt(dot3(v, v));
  return scale3(length > (real)0 ? (real)1 / (length > (real)0 ? length : (real)1) : (real)0, v);
}
