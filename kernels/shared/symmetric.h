// A symmetric 3 × 3 matrix, in C99 ∩ C++, after vec3.h and mat3.h.
typedef struct {
  real xx, xy, xz, yy, yz, zz;
} Symmetric;

static inline Symmetric symmetric(real xx, real xy, real xz, real yy, real yz, real zz) {
  Symmetric s;
  s.xx = xx;
  s.xy = xy;
  s.xz = xz;
  s.yy = yy;
  s.yz = yz;
  s.zz = zz;
  return s;
}

static inline Symmetric add_symmetric(Symmetric a, Symmetric b) {
  return symmetric(a.xx + b.xx, a.xy + b.xy, a.xz + b.xz, a.yy + b.yy, a.yz + b.yz, a.zz + b.zz);
}
static inline Symmetric scale_symmetric(real s, Symmetric a) {
  return symmetric(s * a.xx, s * a.xy, s * a.xz, s * a.yy, s * a.yz, s * a.zz);
}
static inline Symmetric diagonal3(real s) { return symmetric(s, 0, 0, s, 0, s); }
/// a aᵀ
static inline Symmetric square3(Vec3 a) {
  return symmetric(a.x * a.x, a.x * a.y, a.x * a.z, a.y * a.y, a.y * a.z, a.z * a.z);
}
static inline Mat3 full3(Symmetric a) {
  return mat3(vec3(a.xx, a.xy, a.xz), vec3(a.xy, a.yy, a.yz), vec3(a.xz, a.yz, a.zz));
}
static inline Vec3 apply_symmetric(Symmetric a, Vec3 b) { return apply3(full3(a), b); }
/// a s
static inline Mat3 times_symmetric(Mat3 a, Symmetric s) {
  return mat3(apply_symmetric(s, a.x), apply_symmetric(s, a.y), apply_symmetric(s, a.z));
}
