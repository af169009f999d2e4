// A 3 × 3 matrix by its rows, in C99 ∩ C++.
typedef struct {
  Vec3 x, y, z;
} Mat3;

static inline Mat3 mat3(Vec3 x, Vec3 y, Vec3 z) {
  Mat3 m;
  m.x = x;
  m.y = y;
  m.z = z;
  return m;
}

static inline Mat3 scale_mat3(real s, Mat3 a) { return mat3(scale3(s, a.x), scale3(s, a.y), scale3(s, a.z)); }
static inline Mat3 add_mat3(Mat3 a, Mat3 b) { return mat3(add3(a.x, b.x), add3(a.y, b.y), add3(a.z, b.z)); }
static inline Mat3 sub_mat3(Mat3 a, Mat3 b) { return mat3(sub3(a.x, b.x), sub3(a.y, b.y), sub3(a.z, b.z)); }
static inline Mat3 transpose3(Mat3 a) {
  return mat3(vec3(a.x.x, a.y.x, a.z.x), vec3(a.x.y, a.y.y, a.z.y), vec3(a.x.z, a.y.z, a.z.z));
}
static inline Vec3 apply3(Mat3 a, Vec3 b) { return vec3(dot3(a.x, b), dot3(a.y, b), dot3(a.z, b)); }
/// a bᵀ
static inline Mat3 outer3(Vec3 a, Vec3 b) { return mat3(scale3(a.x, b), scale3(a.y, b), scale3(a.z, b)); }
/// aᵀ b
static inline Mat3 transpose_times(Mat3 a, Mat3 b) {
  return add_mat3(add_mat3(outer3(a.x, b.x), outer3(a.y, b.y)), outer3(a.z, b.z));
}
/// tr aᵀ b. One chain of sums: LLVM pairs sums of sums before PoCL comes to vectorise, which then fails.
static inline real inner3(Mat3 a, Mat3 b) {
  return a.x.x * b.x.x + a.x.y * b.x.y + a.x.z * b.x.z + a.y.x * b.y.x + a.y.y * b.y.y + a.y.z * b.y.z + a.z.x * b.z.x +
         a.z.y * b.z.y + a.z.z * b.z.z;
}
static inline Vec3 choose3(mask first, Vec3 a, Vec3 b) {
  return vec3(first ? a.x : b.x, first ? a.y : b.y, first ? a.z : b.z);
}
static inline Mat3 choose_mat3(mask first, Mat3 a, Mat3 b) {
  return mat3(choose3(first, a.x, b.x), choose3(first, a.y, b.y), choose3(first, a.z, b.z));
}
static inline Mat3 cofactors3(Mat3 a) { return mat3(cross3(a.y, a.z), cross3(a.z, a.x), cross3(a.x, a.y)); }
