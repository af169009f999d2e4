// A 3 × 3 matrix by its rows, a register each, in C99 ∩ C++: `Row` has three entries and room for a fourth that nobody
// reads. For kernels that gather whole matrices: a row is one load, where nine columns are nine lines of the cache.
typedef struct {
  Row x, y, z;
} Rows;

static inline Rows rows(Row x, Row y, Row z) {
  Rows r;
  r.x = x;
  r.y = y;
  r.z = z;
  return r;
}

static inline Rows add_rows(Rows a, Rows b) { return rows(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline Rows sub_rows(Rows a, Rows b) { return rows(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline Rows scale_rows(real s, Rows a) { return rows(s * a.x, s * a.y, s * a.z); }
/// aᵀ b
static inline Row row_times(Row a, Rows b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Rows rows_times(Rows a, Rows b) { return rows(row_times(a.x, b), row_times(a.y, b), row_times(a.z, b)); }
/// a bᵀ
static inline Rows outer_rows(Row a, Row b) { return rows(a.x * b, a.y * b, a.z * b); }
