// Vectors and symmetric matrices of numbers as wide as the host's, in C99 ∩ C++, after symmetric.h: for sums that
// single precision would spoil.
typedef struct {
  wide x, y, z;
} WideVec3;

static inline WideVec3 wide_vec3(wide x, wide y, wide z) {
  WideVec3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}

static inline WideVec3 wide3(Vec3 a) { return wide_vec3(to_wide(a.x), to_wide(a.y), to_wide(a.z)); }
static inline WideVec3 add_wide3(WideVec3 a, WideVec3 b) { return wide_vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline WideVec3 scale_wide3(wide s, WideVec3 a) { return wide_vec3(s * a.x, s * a.y, s * a.z); }
/// aᵀ b
static inline WideVec3 wide_pull3(Mat3 a, Vec3 b) {
  const WideVec3 w = wide3(b);
  return add_wide3(add_wide3(scale_wide3(w.x, wide3(a.x)), scale_wide3(w.y, wide3(a.y))), scale_wide3(w.z, wide3(a.z)));
}

/// xx, yy, zz and xy, xz, yz.
typedef struct {
  WideVec3 diagonal, mixed;
} WideSymmetric;

static inline WideSymmetric wide_parts(WideVec3 diagonal, WideVec3 mixed) {
  WideSymmetric s;
  s.diagonal = diagonal;
  s.mixed = mixed;
  return s;
}

static inline WideSymmetric wide_symmetric(Symmetric a) {
  return wide_parts(wide3(vec3(a.xx, a.yy, a.zz)), wide3(vec3(a.xy, a.xz, a.yz)));
}
static inline WideSymmetric add_wide_symmetric(WideSymmetric a, WideSymmetric b) {
  return wide_parts(add_wide3(a.diagonal, b.diagonal), add_wide3(a.mixed, b.mixed));
}
static inline WideSymmetric scale_wide_symmetric(wide s, WideSymmetric a) {
  return wide_parts(scale_wide3(s, a.diagonal), scale_wide3(s, a.mixed));
}
/// a aᵀ
static inline WideSymmetric wide_square3(WideVec3 a) {
  return wide_parts(wide_vec3(a.x * a.x, a.y * a.y, a.z * a.z), wide_vec3(a.x * a.y, a.x * a.z, a.y * a.z));
}
/// aᵀ a
static inline WideSymmetric wide_gram3(Mat3 a) {
  return add_wide_symmetric(add_wide_symmetric(wide_square3(wide3(a.x)), wide_square3(wide3(a.y))),
                            wide_square3(wide3(a.z)));
}
