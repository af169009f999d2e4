// A lane of the kernels in C++, to be included in a namespace where `real` is a type: hence no guard.
using scalar = real;
using mask = int;
inline int any_lane(mask condition) { return condition; }
// As wide as the numbers of the host.
using wide = double;
inline wide to_wide(real x) { return x; }
