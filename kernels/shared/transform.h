// The transform step's maths (reshape paper, sections 3.3 and 4.2), in C99 ∩ C++, after symmetric.h.

/// Of a triangle's transform. `damped` is 1 where it is too near singular to invert, else 0.
typedef struct {
  Mat3 matrix;
  real damped;
} Inverse;

/// Of a matrix of norm 1: where the volume factor is below 1e-9, or below what rounding leaves of it, the inverse
/// would be noise. Only in single precision does rounding ever decide.
static inline int is_singular(Mat3 a, real determinant) {
  const real epsilon = sizeof(real) == 4 ? (real)1e-7 : (real)2e-16;
  const real box = sqrt(dot3(a.x, a.x) * dot3(a.y, a.y) * dot3(a.z, a.z));
  return fabs(determinant) <= fmax((real)1e-9, 8 * epsilon * box);
}

/// (a' a + d I)^-1 a' without forming a' a, whose rounding would drown a small d: by cofactors c and determinant it is
/// (det c + d (|a|^2 a - a a' a) + d^2 a)' / (det^2 + d |c|^2 + d^2 |a|^2 + d^3). The inverse where d is 0.
static inline Mat3 least_squares_inverse(Mat3 a, Mat3 c, real determinant, real d) {
  const Vec3 x = add3(cross3(a.y, c.z), cross3(c.y, a.z));
  const Vec3 y = add3(cross3(a.z, c.x), cross3(c.z, a.x));
  const Vec3 z = add3(cross3(a.x, c.y), cross3(c.x, a.y));
  const Mat3 first = scale_mat3(determinant, c), second = scale_mat3(d, mat3(x, y, z));
  const Mat3 sum = add_mat3(add_mat3(first, second), scale_mat3(d * d, a));
  return scale_mat3(1 / (determinant * determinant + d * (inner3(c, c) + d * (inner3(a, a) + d))), transpose3(sum));
}

/// Least squares with a damping of 1e-3 of the stretch where singular: bounded, and close to the inverse where there
/// is one.
static inline Inverse damped_inverse(Mat3 a) {
  const real shrink = 1 / sqrt(fmax(inner3(a, a), (real)1e-36));  // A stretch below 1e-18 counts as none.
  const Mat3 relative = scale_mat3(shrink, a), cofactors = cofactors3(relative);
  const real determinant = dot3(relative.x, cofactors.x);
  Inverse inverse;
  inverse.damped = is_singular(relative, determinant) ? (real)1 : (real)0;
  const real damping = (real)1e-6 * inverse.damped;
  inverse.matrix = scale_mat3(shrink, least_squares_inverse(relative, cofactors, determinant, damping));
  return inverse;
}

/// Eq. 6.
static inline real length_weight(Vec3 edge, real mean_edge_length) {
  return fmax((real)1, dot3(edge, edge) / (mean_edge_length * mean_edge_length));
}

/// What the triangles beside an edge bring to its quadratic.
typedef struct {
  Symmetric grams, normals;
  Vec3 side;
  real length, count;
} EdgeSum;

static inline EdgeSum no_sides(void) {
  EdgeSum sum;
  sum.grams = sum.normals = diagonal3(0);
  sum.side = vec3(0, 0, 0);
  sum.length = sum.count = 0;
  return sum;
}

/// `present` is 1, or 0 for nothing.
static inline EdgeSum add_side(EdgeSum sum, real present, Mat3 transform, Mat3 inverse, Vec3 normal, Vec3 rest) {
  const Vec3 mapped = apply3(transform, rest);
  sum.grams = add_symmetric(sum.grams, scale_symmetric(present, gram3(inverse)));
  sum.normals = add_symmetric(sum.normals, scale_symmetric(present, square3(normal)));
  sum.side = add3(sum.side, scale3(present, apply3(transpose3(inverse), rest)));
  sum.length += present * sqrt(dot3(mapped, mapped));
  sum.count += present;
  return sum;
}

/// e' block e - 2 side' e
typedef struct {
  Symmetric block;
  Vec3 side;
  real target;
} EdgeQuadratic;

/// Eqs. 20, 21 and 34, of at least one side. `kept` is the target length, or 0 for the transforms'; `scale` and
/// `normal_weight` are divided by the mean edge length.
static inline EdgeQuadratic edge_quadratic(EdgeSum sum, Vec3 rest, real weight, real kept, real normal_weight,
                                           real scale) {
  const real squared = dot3(rest, rest), length = sqrt(squared), along = weight / squared;
  // A transform that flattens an edge must not make its terms infinite. As a root: PoCL does not vectorise over fmax.
  const real mean = sum.length / sum.count, least = (real)1e-9 * length, fitted = sqrt(mean * mean + least * least);
  const real target = kept > 0 ? kept : fitted;
  const real across = normal_weight * weight * length / (target * target);
  EdgeQuadratic quadratic;
  quadratic.block = add_symmetric(add_symmetric(diagonal3(scale), scale_symmetric(along, sum.grams)),
                                  scale_symmetric(across, sum.normals));
  quadratic.side = add3(scale3(scale, rest), scale3(along, sum.side));
  quadratic.target = target;
  return quadratic;
}

/// A triangle's right-hand side of the transform step and its terms of the energy, without their weights.
typedef struct {
  Mat3 right_hand_side;
  real transform, normal, transform_normal, regularizer;
} TriangleTerms;

static inline TriangleTerms no_edges(Mat3 transform, real regularizer_weight) {
  const Mat3 one = full3(diagonal3(1)), change = add_mat3(transform, scale_mat3(-1, one));
  TriangleTerms terms;
  terms.right_hand_side = scale_mat3(regularizer_weight, one);
  terms.transform = terms.normal = terms.transform_normal = 0;
  terms.regularizer = inner3(change, change);
  return terms;
}

/// Eqs. 20, 21 with the current length for the target's, 24 and 26. An edge of no length tilts nowhere.
static inline TriangleTerms add_edge(TriangleTerms terms, Mat3 transform, Mat3 inverse, Vec3 normal, Vec3 edge,
                                     Vec3 rest, real weight, real mean_edge_length) {
  const real squared = dot3(rest, rest), tilt = dot3(normal, edge), turned = dot3(normal, apply3(transform, rest));
  const Vec3 miss = sub3(apply3(inverse, edge), rest);
  terms.right_hand_side = add_mat3(terms.right_hand_side, outer3(scale3(1 / mean_edge_length, edge), rest));
  terms.transform += weight * dot3(miss, miss) / squared;
  terms.normal += weight * sqrt(squared) / mean_edge_length * (tilt * tilt / fmax(dot3(edge, edge), (real)1e-30));
  terms.transform_normal += turned * turned / squared;
  return terms;
}

/// Eq. 25 along any direction.
static inline real disagreement(Mat3 transform, Mat3 other, Vec3 direction) {
  const Vec3 gap = apply3(add_mat3(transform, scale_mat3(-1, other)), direction);
  return dot3(gap, gap);
}
