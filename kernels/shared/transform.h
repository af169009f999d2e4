// The transform step's maths (reshape paper, sections 3.3 and 4.2), in C99 ∩ C++, after wide.h. No branches, or
// for all lanes: a lane of a vector unit each.

/// Of a triangle's transform. `damped` is 1 where it is too near singular to invert, else 0.
typedef struct {
  Mat3 matrix;
  real damped;
} Inverse;

static inline real larger_of(real a, real b) { return a > b ? a : b; }

/// Of a matrix of norm 1: where the volume factor is below 1e-9, or below what rounding leaves of it, the inverse
/// would be noise. Only in single precision does rounding ever decide.
static inline mask is_singular(Mat3 a, real determinant) {
  const real rounding = (real)(sizeof(scalar) == sizeof(float) ? 8e-7 : 16e-16);
  const real box = dot3(a.x, a.x) * dot3(a.y, a.y) * dot3(a.z, a.z);
  return determinant * determinant <= larger_of((real)1e-18, rounding * rounding * box);
}

/// (a' a + d I)^-1 a', d = 1e-6, without forming a' a, whose rounding would drown a small d: by cofactors c and
/// determinant it is (det c + d (|a|^2 a - a a' a) + d^2 a)' / (det^2 + d |c|^2 + d^2 |a|^2 + d^3).
static inline Mat3 least_squares_inverse(Mat3 a, Mat3 c, real determinant) {
  const real d = (real)1e-6;
  const Vec3 x = add3(cross3(a.y, c.z), cross3(c.y, a.z));
  const Vec3 y = add3(cross3(a.z, c.x), cross3(c.z, a.x));
  const Vec3 z = add3(cross3(a.x, c.y), cross3(c.x, a.y));
  const Mat3 first = scale_mat3(determinant, c), second = scale_mat3(d, mat3(x, y, z));
  const Mat3 sum = add_mat3(add_mat3(first, second), scale_mat3(d * d, a));
  const real square = determinant * determinant + d * (inner3(c, c) + d * (inner3(a, a) + d));
  return scale_mat3((real)1 / square, transpose3(sum));
}

/// Least squares with a damping of 1e-3 of the stretch where singular: bounded, and close to the inverse where there
/// is one.
static inline Inverse damped_inverse(Mat3 a) {
  const real shrink = (real)1 / sqrt(larger_of(inner3(a, a), (real)1e-36));  // A stretch below 1e-18 counts as none.
  const Mat3 relative = scale_mat3(shrink, a), cofactors = cofactors3(relative);
  const real determinant = dot3(relative.x, cofactors.x);
  const mask singular = is_singular(relative, determinant);
  Inverse inverse;
  inverse.damped = singular ? (real)1 : (real)0;
  inverse.matrix = scale_mat3(shrink / (singular ? (real)1 : determinant), transpose3(cofactors));
  if (any_lane(singular)) {
    const Mat3 damped = scale_mat3(shrink, least_squares_inverse(relative, cofactors, determinant));
    inverse.matrix = choose_mat3(singular, damped, inverse.matrix);
  }
  return inverse;
}

/// Eq. 6 of a squared length.
static inline real length_weight(real squared, real mean_edge_length) {
  return larger_of((real)1, squared / (mean_edge_length * mean_edge_length));
}

/// `mean` is of the lengths by the triangles beside the edge; `kept` replaces it where it is not 0.
static inline real target_length(real mean, real kept, Vec3 rest) {
  // A transform that flattens an edge must not make its terms infinite.
  const real fitted = larger_of(mean, (real)1e-9 * sqrt(dot3(rest, rest)));
  return kept > (real)0 ? kept : fitted;
}

/// What the triangles beside an edge bring to its quadratic, and `turned`, eq. 26 times the edge's squared length.
typedef struct {
  WideSymmetric grams;  // Wide: squared, a flattened triangle's inverse would bury its short ways below its long one.
  Symmetric normals;
  WideVec3 side;
  real length, turned;
} EdgeSum;

static inline EdgeSum no_sides(void) {
  const real none = (real)0;
  EdgeSum sum;
  sum.normals = diagonal3(none);
  sum.grams = wide_symmetric(sum.normals);
  sum.side = wide3(vec3(none, none, none));
  sum.length = sum.turned = none;
  return sum;
}

/// `mapped`: the edge by the triangle's transform.
static inline EdgeSum edge_side(Vec3 mapped, Mat3 inverse, Vec3 normal, Vec3 rest) {
  const real tilt = dot3(normal, mapped);
  EdgeSum side;
  side.grams = wide_gram3(inverse);
  side.normals = square3(normal);
  side.side = wide_pull3(inverse, rest);
  side.length = sqrt(dot3(mapped, mapped));
  side.turned = tilt * tilt;
  return side;
}

static inline EdgeSum add_sides(EdgeSum a, EdgeSum b) {
  EdgeSum sum;
  sum.grams = add_wide_symmetric(a.grams, b.grams);
  sum.normals = add_symmetric(a.normals, b.normals);
  sum.side = add_wide3(a.side, b.side);
  sum.length = a.length + b.length;
  sum.turned = a.turned + b.turned;
  return sum;
}

/// e' block e - 2 side' e
typedef struct {
  WideSymmetric block;
  WideVec3 side;
} EdgeQuadratic;

/// Eqs. 20, 21 and 34. `share` is what part of the sides' sum counts (a half where the only side was summed twice);
/// `scale` and `normal_weight` are divided by the mean edge length.
static inline EdgeQuadratic edge_quadratic(EdgeSum sum, real share, Vec3 rest, real weight, real target,
                                           real normal_weight, real scale) {
  const real squared = dot3(rest, rest), length = sqrt(squared), along = share * weight / squared;
  const real across = share * normal_weight * weight * length / (target * target);
  EdgeQuadratic quadratic;
  const Symmetric others = add_symmetric(diagonal3(scale), scale_symmetric(across, sum.normals));
  quadratic.block = add_wide_symmetric(wide_symmetric(others), scale_wide_symmetric(to_wide(along), sum.grams));
  quadratic.side = add_wide3(wide3(scale3(scale, rest)), scale_wide3(to_wide(along), sum.side));
  return quadratic;
}

/// Eq. 28 without its weight.
static inline real distance_from_identity(Mat3 transform) {
  const Mat3 change = add_mat3(transform, scale_mat3((real)-1, full3(diagonal3((real)1))));
  return inner3(change, change);
}

/// What a transform makes of the tangent plane, with the normal taken to that of the image, as long as the square root
/// of how the area grows.
static inline Mat3 with_mapped_normal(Mat3 transform, Vec3 normal) {
  const Vec3 first = vec3(transform.x.x, transform.y.x, transform.z.x),
             second = vec3(transform.x.y, transform.y.y, transform.z.y),
             third = vec3(transform.x.z, transform.y.z, transform.z.z);
  const Vec3 along = add3(add3(scale3(normal.x, cross3(second, third)), scale3(normal.y, cross3(third, first))),
                          scale3(normal.z, cross3(first, second)));
  const real area = larger_of(sqrt(dot3(along, along)), (real)1e-12);
  const Vec3 change = sub3(scale3((real)1 / sqrt(area), along), apply3(transform, normal));
  return add_mat3(transform, outer3(change, normal));
}

/// How far the normal's own image is from it, squared.
static inline real distance_from_normal(Mat3 transform, Vec3 normal) {
  const Vec3 change = sub3(apply3(transform, normal), normal);
  return dot3(change, change);
}

/// A triangle's right-hand side of the transform step and its terms of the energy, without their weights.
typedef struct {
  Mat3 right_hand_side;
  real transform, normal, scale;
} TriangleTerms;

static inline TriangleTerms no_edges(Vec3 normal, real regularizer_weight, real normal_regularizer_weight) {
  TriangleTerms terms;
  terms.right_hand_side =
      add_mat3(full3(diagonal3(regularizer_weight)), outer3(scale3(normal_regularizer_weight, normal), normal));
  terms.transform = terms.normal = terms.scale = (real)0;
  return terms;
}

/// Eqs. 20, 21 with the current length for the target's, 24, and `part` of 34. An edge of no length tilts nowhere.
static inline TriangleTerms add_edge(TriangleTerms terms, Mat3 inverse, Vec3 normal, Vec3 edge, Vec3 rest, real weight,
                                     real part, real mean_edge_length) {
  const real squared = dot3(rest, rest), tilt = dot3(normal, edge), slope = tilt * tilt;
  const Vec3 miss = sub3(apply3(inverse, edge), rest), change = sub3(edge, rest);
  terms.right_hand_side = add_mat3(terms.right_hand_side, outer3(scale3((real)1 / mean_edge_length, edge), rest));
  terms.transform += weight * dot3(miss, miss) / squared;
  terms.normal += weight * sqrt(squared) / mean_edge_length * (slope / larger_of(dot3(edge, edge), (real)1e-30));
  terms.scale += part * dot3(change, change);
  return terms;
}

/// Eq. 25 along any direction, by the difference of two transforms.
static inline real disagreement(Mat3 difference, Vec3 direction) {
  const Vec3 gap = apply3(difference, direction);
  return dot3(gap, gap);
}
