// The kernels' `Row` in C++, to be included in a namespace where `real` is a type: hence no guard.
struct Row {
  real x, y, z, w;

  friend Row operator+(Row a, Row b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
  friend Row operator-(Row a, Row b) { return {a.x - b.x, a.y - b.y, a.z - b.z, a.w - b.w}; }
  friend Row operator*(real s, Row a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
};
